#include "vision/receive_buffer.h"

#include <sys/socket.h>
#include <unistd.h>

#include "common/log.h"

static const int wanted = 8 << 20; /* bytes */

/* What a socket really gets; the kernel doubles what it grants, for its own use. */
static int granted()
{
    const int probe = socket(AF_INET, SOCK_DGRAM, 0);
    int size = 0;
    socklen_t length = sizeof size;

    if (probe < 0)
        return 0;
    setsockopt(probe, SOL_SOCKET, SO_RCVBUF, &wanted, sizeof wanted);
    getsockopt(probe, SOL_SOCKET, SO_RCVBUF, &size, &length);
    close(probe);
    return size / 2;
}

void receive_buffer_check(size_t bytes)
{
    const int size = granted();

    if (size > 0 && static_cast<size_t>(size) < bytes)
        log_warning("a raw pair has %zu bytes but the socket holds %d: raw pairs may be lost; send "
                    "JPEG, or allow more: sysctl -w net.core.rmem_max=%d",
                    bytes, size, wanted);
}
