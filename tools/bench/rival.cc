#include "tools/bench/rival.h"

#include <stdexcept>
#include <string>

#include "common/base/arena.h"
#include "tools/bench/arm.h"
#include "tools/bench/reference/parameters_of.h"
#include "tools/bench/reference/recursive_imle.h"

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
        const body known = arm_body();
        if (learner_ && config.features == LEARNER_BODY &&
            learner_give_body(learner_, &known, reason, sizeof reason) != 0)
            learner_ = nullptr;
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

/* As published: no expert is passed over, however small its share. */
oracle::Parameters published(const learner_config &config)
{
    oracle::Parameters p = oracle::parameters_of(config);
    p.skip = 0;
    return p;
}

class TextbookRival : public Rival
{
public:
    explicit TextbookRival(const learner_config &config) : imle_(published(config)) {}
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
