// What is measured: a learner of so many experts, and the stream that it learned to have them.
#ifndef REACH_BENCH_CASES_H
#define REACH_BENCH_CASES_H

#include <string>
#include <vector>

#include "learner/learner.h"

struct Case {
    std::string kind; // "linear", "cubic", "quartic", "body": what an expert is; "tick": the daemon
    int d;
    int experts;          // learn until there are as many
    int most_samples;     // or until so many were learned
    int samples_per_tool; // then another is taken
    int tools;            // 1, 2, 1, 3, 1, 2 ...; 0: every tool is new
    double speed;         // of the walk, see arm.h
    learner_config config;
};

std::vector<Case> all_cases();

#endif
