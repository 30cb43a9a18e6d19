/* Text from outside, such as a channel's name, for a terminal: an escape sequence in it could alter
 * what stands there, or the terminal itself. */
#ifndef REACH_COMMON_PROGRAM_PRINTABLE_H
#define REACH_COMMON_PROGRAM_PRINTABLE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* `text` up to its zero, at most `most` bytes of it, with \xNN in place of each byte that is no
 * printable ASCII. In `out`, which it returns; what does not fit is cut off. */
const char *printable(const char *text, size_t most, char *out, size_t out_size);

#ifdef __cplusplus
}
#endif
#endif
