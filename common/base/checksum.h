/* The checksum of messages, texts and logs. */
#ifndef REACH_COMMON_BASE_CHECKSUM_H
#define REACH_COMMON_BASE_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/* CRC-32 of the bytes, as zlib and Python's zlib.crc32 compute it. */
uint32_t checksum_crc32(const void *data, size_t size);

#endif
