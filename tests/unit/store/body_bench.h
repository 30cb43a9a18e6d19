/* A store whose learner finds a body: a chain of two joints, a finder that knows it, and what a
 * learner is that was given it at some sample without any store. */
#ifndef TESTS_UNIT_STORE_BODY_BENCH_H
#define TESTS_UNIT_STORE_BODY_BENCH_H

#include "learner/store/store.h"
#include "store_bench.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

/* The finder: what it is asked, and what it says. */
struct body_bench_finder {
    bool absent; /* says nothing at all */
    bool slow;   /* says that it searches, and no more */
    enum finder_outcome outcome;
    int asked, again; /* calls so far */
    int64_t seq;      /* of the newest search */
    int samples;      /* that it brought */
    bool started;     /* it brought a body to begin with */
    bool came, answered;
    int told; /* of a body in use */
};

/* There is one of them at a time. */
extern struct body_bench_finder body_bench_finder;

/* The first sample since which all is seen 2 cm aside; UINT64_MAX: none. */
extern uint64_t body_bench_moves_at;
extern const struct finder_port body_bench_port;

/* Settings as those of store_bench.h. */
struct model_store_settings body_bench_settings(const char *directory);

/* Sample `number`, from 1, the same in every bench: z[2], x[BODY_OUTPUTS]. */
void body_bench_sample(uint64_t number, double *z, double *x);

/* The next sample into the loop's learner, as a tick does it. Returns false when the store has no
 * room. */
bool body_bench_learn_one(struct store_bench *bench);

/* A tick: a poll, and a sample where there is room. Returns the samples at which a body took its
 * place, 0 = none did. */
uint64_t body_bench_tick(struct store_bench *bench);

/* The one that the finder finds. */
struct body body_bench_body(void);

/* The hash of a learner of so many samples, given the body after each of `n` numbers of samples. */
uint64_t body_bench_hash_at(const struct model_store_settings *settings, uint64_t samples,
                            const uint64_t *given, int n);

/* The same, whose body was taken away after sample `taken`. */
uint64_t body_bench_hash_forgetting(const struct model_store_settings *settings, uint64_t samples,
                                    const uint64_t *given, int n, uint64_t taken);

#endif
