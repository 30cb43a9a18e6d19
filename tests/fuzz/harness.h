/* What every harness has: the entry that libFuzzer calls, and a way to say that something must
 * hold. Without libFuzzer, damaged_corpus.c calls the same entry. */
#ifndef REACH_TESTS_FUZZ_HARNESS_H
#define REACH_TESTS_FUZZ_HARNESS_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef __cplusplus
extern "C" {
#endif

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The bytes as a file, for what reads files: its path, until the next call. */
const char *harness_file(const uint8_t *data, size_t size);

#ifdef __cplusplus
}
#endif

#define HARNESS_REQUIRE(condition)                                                                 \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #condition);         \
            abort();                                                                               \
        }                                                                                          \
    } while (0)

#endif
