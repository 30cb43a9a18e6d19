#include "vision/pictures/receive_buffer.h"

#include "common/bus/open.h"
#include "common/program/log.h"

void receive_buffer_check(size_t bytes)
{
    const int size = bus_receive_buffer_most();

    if (size > 0 && static_cast<size_t>(size) < bytes)
        log_warning("a raw pair has %zu bytes but the socket holds %d: raw pairs may be lost; send "
                    "JPEG, or allow more: sysctl -w net.core.rmem_max=8388608",
                    bytes, size);
}
