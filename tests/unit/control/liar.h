/* Eyes, or a tracker, that lie: what they tell is changed on its way to the control step. */
#ifndef TESTS_UNIT_CONTROL_LIAR_H
#define TESTS_UNIT_CONTROL_LIAR_H

#include "common/base/random.h"
#include "daemon/config/config.h"
#include "daemon/control/senses/observation.h"

#include <stdbool.h>

enum lie {
    LIE_NONE,
    LIE_JUMPS,      /* each frame by up to 30 px, or 5 cm */
    LIE_OUTLIERS,   /* one frame of five is anywhere */
    LIE_ROWS,       /* every other frame 30 px lower, or 3 cm */
    LIE_REPEATS,    /* the last answer again, under new stamps */
    LIE_NUMB,       /* the same with fresh noise */
    LIE_LATE,       /* what was 0.3 s ago, under new stamps */
    LIE_VERY_LATE,  /* 0.6 s */
    LIE_WANDERS,    /* 40 px or 8 cm to and fro, whatever the arm does */
    LIE_EYE_FROZEN, /* the left eye alone */
    LIE_EYE_LATE,   /* the left eye is 0.3 s late */
    LIE_PAST,       /* stamps are 10 s too old */
    LIE_FUTURE,     /* or too new */
    LIES,

    TRUTH_KNOCKED = LIES, /* a camera or tracker that was knocked: 25 px or 3 cm, and stays so */
    TRUTH_TOOL,           /* a new tool, which the caller hands over */
    TRUTHS,
};

extern const char *const lie_names[TRUTHS];

enum { LIAR_REMEMBERS = 64 };

struct liar {
    const struct config *config;
    enum lie lie;
    struct random_state random;
    int ticks; /* since this lie began */
    int newest;
    struct observation told[LIAR_REMEMBERS]; /* the truth of the last frames */
    struct observation first;                /* when the lie began */
};

void liar_init(struct liar *liar, const struct config *config, int64_t seed);

/* It lies so from the next frame on. */
void liar_begin(struct liar *liar, enum lie lie);

/* Whether who measures a place with a tracker can be lied to so; who sees can be in all ways. */
bool liar_can(bool tracker, enum lie lie);

/* Makes a lie of one frame's truth. */
void liar_tell(struct liar *liar, struct observation *observation);

#endif
