/* Where the configurations are that came with a program. */
#ifndef REACH_TOOLS_MEASURE_ETC_DIRECTORY_H
#define REACH_TOOLS_MEASURE_ETC_DIRECTORY_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes the path of the file `name` of etc/ into `path`: that of the installation that the running
 * program belongs to, wherever it was moved, or of the source tree for one that runs where it was
 * built. Returns `path`. */
const char *etc_file(const char *name, char *path, size_t size);

#ifdef __cplusplus
}
#endif
#endif
