/* The newest answers, so that a pair that is sent again gets the very same marker. */
#ifndef VISION_ANSWERS_ANSWERS_H
#define VISION_ANSWERS_ANSWERS_H

#include <reach_marker_t.h>

#include <cstdint>

#include "vision/pictures/image_message.h"

enum { ANSWERS_KEPT = 16 };

struct answers {
    struct {
        uint64_t content;
        reach_marker_t marker; /* utime 0: this place is free */
    } kept[ANSWERS_KEPT] = {};
    int next = 0;
};

/* A number that differs, but for bad luck, when the pictures do. Looks at every 61st byte. A stamp
 * alone is not enough: a simulator that starts anew uses its stamps again. */
uint64_t answers_content(const image_message &pair);

/* The same of one eye's picture. */
uint64_t answers_content_of(const encoded_image &image);

/* The answer once given to this pair, or nullptr. */
const reach_marker_t *answers_find(const answers &known, int64_t utime, uint64_t content);

/* Keeps an answer in place of the oldest. */
void answers_keep(answers *known, uint64_t content, const reach_marker_t &marker);

#endif
