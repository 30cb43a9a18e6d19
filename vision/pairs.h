/* Where a run's pairs of pictures come from, as the command line says. */
#ifndef VISION_PAIRS_H
#define VISION_PAIRS_H

#include <memory>

#include "vision/arguments.h"
#include "vision/config.h"
#include "vision/pictures/source.h"

/* Whether they come over the bus. */
bool pairs_on_bus(const arguments &given);

/* Opens their source; `lcm` is only used where they come over the bus. Returns nullptr after one
 * line in the log. */
std::unique_ptr<source> pairs_open(const arguments &given, const vision_config &config, lcm_t *lcm,
                                   pair_receiver *receiver);

#endif
