// What is measured, behind one interface: the daemon's learner, and the textbook version.
#ifndef REACH_BENCH_RIVAL_H
#define REACH_BENCH_RIVAL_H

#include <cstddef>
#include <memory>

#include "learner/learner.h"

class Rival
{
public:
    virtual ~Rival() = default;
    virtual void update(const double *z, const double *x) = 0;
    // All solutions with their exact Jacobians; returns how many.
    virtual int predict(const double *z) = 0;
    virtual int experts() const = 0;
    // Experts that took more than a millionth of the last sample; 0 where that is not known.
    virtual int concerned() const
    {
        return 0;
    }
    // Memory of the learner, 0 where that is not known.
    virtual size_t bytes() const
    {
        return 0;
    }
};

// Both throw std::runtime_error for a configuration that cannot be.
std::unique_ptr<Rival> make_learner(const learner_config &config);
// The published algorithm with the same parameters; the configuration must be of linear experts.
std::unique_ptr<Rival> make_textbook(const learner_config &config);

#endif
