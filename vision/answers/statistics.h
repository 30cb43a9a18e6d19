/* Counts and times of a run, for the log and for reports. */
#ifndef VISION_ANSWERS_STATISTICS_H
#define VISION_ANSWERS_STATISTICS_H

#include <cstdint>
#include <cstdio>
#include <vector>

#include "vision/ball/segment.h"
#include "vision/ball/stereo.h"

/* How often each whole microsecond was met; what is longer than the table goes into its end. */
struct time_histogram {
    std::vector<uint32_t> count;
    double largest = 0; /* us */
    time_histogram();
};

void time_histogram_add(time_histogram *times, double us);

/* The time that this share (0 .. 1) of all did not exceed; us, 0 when there are none. */
double time_histogram_quantile(const time_histogram &times, double share);

struct statistics {
    int64_t pairs = 0;                     /* looked at */
    int64_t reasons[STEREO_REASONS] = {0}; /* what was said of them, marker_t.reason */
    int64_t no_colour = 0;                 /* not seen in an eye: nothing had the ball's colour */
    int64_t faults[BLOB_FAULTS] = {0}; /* not seen in an eye: why the largest thing was refused */
    int64_t windows = 0;               /* settled without the whole pictures */
    int64_t repeated = 0;              /* asked again, answered from memory */
    int64_t dropped = 0;               /* too old when their turn came */
    int64_t malformed = 0;             /* messages that could not be read */
    time_histogram look;               /* processor time of finding the ball */
    time_histogram decode;             /* processor time of decoding */
};

/* One line for the log. */
void statistics_line(const statistics &counts, char *line, size_t size);

/* Why the ball was not seen, in words and counts. Empty when it always was. */
void statistics_unseen(const statistics &counts, char *line, size_t size);

/* Whether pairs came and not one of them could be looked at. */
bool statistics_nothing_usable(const statistics &counts);

/* One JSON object. */
void statistics_json(const statistics &counts, FILE *out);

/* Processor time of the calling thread; us. */
double statistics_thread_us();

#endif
