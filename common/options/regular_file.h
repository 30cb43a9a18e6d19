/* Opening a file that must not make its reader wait: a pipe, a device or a socket in its place is
 * refused. */
#ifndef REACH_COMMON_OPTIONS_REGULAR_FILE_H
#define REACH_COMMON_OPTIONS_REGULAR_FILE_H

#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* For reading. Returns the file, which the caller closes, or NULL with "PATH: why not" in `error`.
 */
FILE *regular_file_open(const char *path, char *error, size_t error_size);

#ifdef __cplusplus
}
#endif

#endif
