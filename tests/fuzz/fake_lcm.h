/* LCM without a network: takes the place of the library's calls in a harness, keeps who subscribed
 * to what, and hands messages over when the harness says so. What is published is handed over at
 * once. */
#ifndef REACH_FAKE_LCM_H
#define REACH_FAKE_LCM_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A message for whoever subscribed to the channel; nothing when nobody did. */
void fake_lcm_deliver(const char *channel, const uint8_t *data, size_t size);

/* What a harness's input is made of: messages, one after the other. Each starts with a byte: the
 * low bits choose the channel, bit 7 says what follows: a length byte and so many raw bytes; or
 * else a whole message of the channel's type, `encoded_size` bytes, to which the fingerprint is
 * added. What the input lacks is zero. */
struct fake_lcm_channel {
    const char *name;
    int64_t fingerprint;
    size_t encoded_size; /* without the fingerprint; at most FAKE_LCM_MOST */
};
enum { FAKE_LCM_MOST = 2048 };

/* Delivers the first message of the input. Returns how many bytes it was. */
size_t fake_lcm_deliver_next(const struct fake_lcm_channel *channels, size_t n_channels,
                             const uint8_t *data, size_t size);

#ifdef __cplusplus
}
#endif
#endif
