/* What reach-vision learns instead of publishing markers: how the eyes stand, the ball's colour. */
#ifndef VISION_LEARNING_H
#define VISION_LEARNING_H

#include <csignal>

#include "vision/arguments.h"
#include "vision/config.h"

/* Whether one of the two is asked for. */
bool learning_asked(const arguments &given);

/* Learns until there is enough, the pairs end, or `stop` becomes true. Returns the exit code. */
int learning_run(const arguments &given, const vision_config &config,
                 const volatile sig_atomic_t *stop);

#endif
