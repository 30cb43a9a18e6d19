/* Samples of arms that are made up, and the finder on them: what its tests share. */
#ifndef REACH_TEST_BODY_FINDER_BED_H
#define REACH_TEST_BODY_FINDER_BED_H

#include "learner/finder/finder.h"

#include <memory>
#include <vector>

/* The tip on a made-up arm's last frame, m. */
extern const double finder_bed_tip[3];

struct Samples {
    int n_joints;
    std::vector<double> z, x;

    void add(const double *q, const double *place);
    /* n samples from number `first` on. */
    learner_samples view(int first, int n) const;
    learner_samples view() const;
    int n() const;
};

/* Postures anywhere in the joints' range, of `tip`. */
void add_random(Samples &samples, const body &truth, int n, const double *tip = finder_bed_tip);

struct Answer {
    finder_outcome outcome = FINDER_NOT_YET;
    finder_report report{};
    std::unique_ptr<body> found;

    /* What the next search begins with; NULL: nothing. */
    const body *begin() const
    {
        return report.any_body ? found.get() : nullptr;
    }
};

/* What the finder makes of them, from 40 starts at most; `start` may be NULL. With `told` it knows
 * the joints' ranges. */
Answer search(const body &truth, const std::vector<learner_samples> &contexts,
              const body *start = nullptr, bool told = false);
Answer search(const body &truth, const Samples &samples);

/* How far a learner that stands on what was found, and has learned the samples, is from the truth
 * over the whole range: rms, in the outputs' units, or of an arm that eyes see in units of the
 * noise. */
double error_of(const body &found, const Samples &samples, const body &truth);

#endif
