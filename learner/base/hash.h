/* FNV-1a: tells damage, and ties a saved state to its parameters. No guard against malice. */
#ifndef REACH_LEARNER_BASE_HASH_H
#define REACH_LEARNER_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LEARNER_HASH_START 14695981039346656037ULL

/* The hash of n bytes more; begin with LEARNER_HASH_START. */
uint64_t learner_hash(uint64_t hash, const void *bytes, size_t n);

#ifdef __cplusplus
}
#endif
#endif
