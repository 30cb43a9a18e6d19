// Measures one case: ours, the textbook version and LWPR learn the same samples, then their calls
// are timed in turns, on the clock of the thread.
#ifndef REACH_BENCH_MEASURE_H
#define REACH_BENCH_MEASURE_H

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/bench/cases.h"
#include "tools/measure/durations.h"

// One call of one case. A rival that does not take part has no summary.
struct Row {
    std::string name; // "update", "predict" with the experts' kind unless linear; "tick"
    int d, D;
    int experts; // ours, when the timing began
    std::optional<durations_summary> ours, textbook, lwpr;
    int textbook_experts, lwpr_fields;
    size_t bytes;     // of our learner, were this number of experts its capacity
    double stream_us; // to read so many bytes once, median
    double solutions; // mean number of a prediction, ours; NaN: not known
    double concerned; // mean number of experts with a responsibility above 1e-6, textbook
};

// `calls` of each kind; `progress` is told what is being done.
// A case of kind "tick" gives one row, without rivals.
std::vector<Row> measure(const Case &c, int calls,
                         const std::function<void(const std::string &)> &progress);

#endif
