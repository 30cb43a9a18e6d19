/* A file that appears whole or not at all: written beside its place, then moved there. */
#ifndef REACH_TOOLS_MEASURE_OUTPUT_FILE_H
#define REACH_TOOLS_MEASURE_OUTPUT_FILE_H

#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { OUTPUT_LONGEST_PATH = 1024 };

struct output_file {
    FILE *stream;
    char path[OUTPUT_LONGEST_PATH];
    char part[OUTPUT_LONGEST_PATH + 8];
};

/* All return 0, or -1 with "path: reason" in `error`. */

/* Says early whether output_begin could succeed: the folder is there and writable, and the path
 * does not name a folder or a device. */
int output_check(const char *path, char *error, size_t error_size);

int output_begin(struct output_file *file, const char *path, char *error, size_t error_size);

/* Puts what was written in place. On failure nothing is left behind. */
int output_commit(struct output_file *file, char *error, size_t error_size);

#ifdef __cplusplus
}
#endif
#endif
