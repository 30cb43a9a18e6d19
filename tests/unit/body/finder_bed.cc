#include "finder_bed.h"

#include <cmath>
#include <cstdio>
#include <cstring>
/* After the C++ headers: Check takes the word `fail`. */
#include "made_up_arm.h"
#include "tests/unit/learner/bed.h"

#include <check.h>

const double finder_bed_tip[3] = {0.05, 0.1, 0.0};

void Samples::add(const double *q, const double *place)
{
    z.insert(z.end(), q, q + n_joints);
    x.insert(x.end(), place, place + 3);
}

learner_samples Samples::view(int first, int n) const
{
    return {true, n, z.data() + ptrdiff_t(first) * n_joints, x.data() + ptrdiff_t(3) * first};
}

learner_samples Samples::view() const
{
    return view(0, n());
}

int Samples::n() const
{
    return int(x.size() / 3);
}

void add_random(Samples &samples, const body &truth, int n, const double *tip)
{
    for (int k = 0; k < n; k++) {
        double q[CHAIN_MAX_JOINTS];
        double place[3];
        do
            random_joints(&truth, q);
        while (!arm_sample(&truth, tip, q, place));
        samples.add(q, place);
    }
}

Answer search(const body &truth, const std::vector<learner_samples> &contexts, const body *start,
              bool told)
{
    Answer answer;
    finder_settings settings = {};
    int n = 0;

    settings.n_joints = truth.chain.n;
    settings.sees = truth.sees;
    settings.angle_unit = 1;
    for (int i = 0; i < BODY_OUTPUTS; i++)
        settings.noise[i] = truth.noise[i];
    for (int i = 0; told && i < truth.chain.n; i++) {
        settings.low[i] = truth.chain.middle[i] - truth.range[i];
        settings.high[i] = truth.chain.middle[i] + truth.range[i];
    }
    settings.gravity[2] = -1;
    settings.seed = 1;
    settings.starts = 40;
    settings.start = start;
    for (const learner_samples &one : contexts)
        n += one.n;
    answer.found = std::make_unique<body>();
    answer.outcome = finder_search(&settings, contexts.data(), int(contexts.size()),
                                   answer.found.get(), &answer.report);
    std::printf("%d samples: outcome %d, error %.2f, doubt %.4f, %d starts: %s\n", n,
                answer.outcome, answer.report.error, answer.report.doubt, answer.report.starts,
                answer.report.why);
    std::fflush(stdout);
    ck_assert_int_eq(answer.outcome, answer.report.outcome);
    ck_assert_int_le(answer.report.samples, n);
    return answer;
}

Answer search(const body &truth, const Samples &samples)
{
    Answer answer = search(truth, {samples.view()});

    ck_assert_int_eq(answer.report.samples, samples.n());
    return answer;
}

double error_of(const body &found, const Samples &samples, const body &truth)
{
    learner_config config = body_config(truth.chain.n, truth.sees, 16);
    learner *learner = bed_create(&config);
    char err[160];
    double sum = 0;
    const int queries = 200;

    ck_assert_msg(learner_give_body(learner, &found, err, sizeof err) == 0, "%s", err);
    learner_samples view = samples.view();
    for (int k = 0; k < view.n; k++)
        learner_update(learner, view.z + ptrdiff_t(k) * truth.chain.n, view.x + ptrdiff_t(3) * k);
    for (int k = 0; k < queries; k++) {
        double q[CHAIN_MAX_JOINTS];
        double place[3];
        learner_solution one{};
        do
            random_joints(&truth, q);
        while (!arm_output(&truth, finder_bed_tip, q, place));
        ck_assert_int_eq(learner_predict_single(learner, q, &one), 1);
        for (int i = 0; i < 3; i++)
            sum += std::pow((one.value[i] - place[i]) / (truth.sees ? truth.noise[i] : 1), 2);
    }
    bed_clean();
    return std::sqrt(sum / queries);
}
