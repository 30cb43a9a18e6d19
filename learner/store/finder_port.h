/* Whoever finds bodies for the store's learner, as a table of calls, so that the store knows no
 * bus. All are made by the housekeeping thread; none waits. */
#ifndef REACH_LEARNER_STORE_FINDER_PORT_H
#define REACH_LEARNER_STORE_FINDER_PORT_H

#include "learner/body/search/search.h"

#include <stdbool.h>
#include <stdint.h>

/* A search that is due. What it points to holds during the call alone. */
struct body_search {
    int64_t seq; /* counts from 1 */
    struct finder_settings settings;
    int n_contexts;
    struct learner_samples contexts[LEARNER_MAX_SOLUTIONS];
};

enum body_answer_kind { BODY_ANSWER_COMES, BODY_ANSWER_REFUSED, BODY_ANSWER_REPORT };

/* An answer to the search `seq`: that it has come, that it was refused, or what was found. */
struct body_answer {
    int64_t seq;
    enum body_answer_kind kind;
    struct finder_report report; /* of a REPORT; of a REFUSED, why */
    double seconds;              /* of the search */
    uint32_t checksum;           /* of the body, for the trace */
    struct body body;            /* of a REPORT with any_body; checked */
};

struct finder_port {
    void (*ask)(void *user, const struct body_search *search);
    void (*ask_again)(void *user); /* the same: it may have been lost */
    /* The oldest answer that came. Returns false when there is none. */
    bool (*take)(void *user, struct body_answer *answer);
    /* Somebody wants to know the body in use. */
    void (*tell)(void *user, const struct body *body);
    void *user;
};

#endif
