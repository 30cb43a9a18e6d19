#include "tools/bench/rival.h"

#include <stdexcept>
#include <string>

#include "daemon/arena.h"
#include "tests/oracle/recursive_imle.h"

namespace
{

class LearnerRival : public Rival
{
public:
    explicit LearnerRival(const learner_config &config)
        : bytes_(learner_memory(&config)), arena_(arena_create(bytes_))
    {
        char reason[256] = "no memory";
        learner_ = arena_ ? learner_create(&config, arena_, reason, sizeof reason) : nullptr;
        if (!learner_) {
            arena_destroy(arena_);
            throw std::runtime_error(std::string("learner: ") + reason);
        }
    }
    LearnerRival(const LearnerRival &) = delete;
    LearnerRival &operator=(const LearnerRival &) = delete;
    ~LearnerRival() override
    {
        arena_destroy(arena_);
    }
    void update(const double *z, const double *x) override
    {
        learner_update(learner_, z, x);
    }
    int predict(const double *z) override
    {
        return learner_predict(learner_, z, &prediction_);
    }
    int experts() const override
    {
        return learner_get_statistics(learner_).experts;
    }
    size_t bytes() const override
    {
        return bytes_;
    }

private:
    size_t bytes_;
    arena *arena_;
    learner *learner_;
    learner_prediction prediction_{};
};

oracle::Parameters parameters_of(const learner_config &c)
{
    oracle::Parameters p;
    p.d = c.n_inputs;
    p.D = c.n_outputs;
    p.psi0 = Eigen::Map<const Eigen::VectorXd>(c.psi0, c.n_outputs);
    p.sigma0 = Eigen::Map<const Eigen::VectorXd>(c.sigma0, c.n_inputs);
    p.alpha = c.alpha;
    p.w_sigma = c.hyper_sigma;
    p.w_psi = c.hyper_psi;
    p.w_Sigma = c.prior_sigma;
    p.w_nu = c.prior_nu;
    p.w_Psi = c.prior_psi;
    p.w_Lambda = c.ridge;
    p.n_outliers = c.n_outliers;
    p.p0 = c.p0;
    p.significance = c.significance;
    p.n_solutions_max = c.n_solutions_max;
    p.em_pred_iterations = c.em_pred_iterations;
    return p;
}

class TextbookRival : public Rival
{
public:
    explicit TextbookRival(const learner_config &config) : imle_(parameters_of(config)) {}
    void update(const double *z, const double *x) override
    {
        imle_.update(z, x);
    }
    int predict(const double *z) override
    {
        return static_cast<int>(imle_.predict(z).size());
    }
    int experts() const override
    {
        return imle_.experts();
    }
    int concerned() const override
    {
        return imle_.concerned();
    }

private:
    oracle::RecursiveImle imle_;
};

} // namespace

std::unique_ptr<Rival> make_learner(const learner_config &config)
{
    return std::make_unique<LearnerRival>(config);
}

std::unique_ptr<Rival> make_textbook(const learner_config &config)
{
    if (config.features != LEARNER_LINEAR || config.prior_nu > 0)
        throw std::runtime_error("textbook: only linear experts without a prior on the centre");
    return std::make_unique<TextbookRival>(config);
}
