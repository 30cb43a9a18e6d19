#include "common/base/checksum.h"

#include <zlib.h>

uint32_t checksum_crc32(const void *data, size_t size)
{
    return (uint32_t)crc32(0, (const Bytef *)data, (uInt)size);
}
