#include "simrobot/eyes/eye_thread.h"

#include "common/base/thread.h"
#include "common/program/log.h"

namespace sim
{
namespace
{

/* Images that may wait to be drawn, and pairs that are kept for sending again. */
const size_t most_waiting = 4, most_kept = 6;

} // namespace

EyeThread::EyeThread(const Config &config, uint64_t seed, lcm_t *lcm, bool may_drop)
    : config_(config), may_drop_(may_drop), lcm_(lcm), sensor_(config.sensor_noise, seed)
{
}

std::unique_ptr<EyeThread> EyeThread::create(const Config &config, uint64_t seed, lcm_t *lcm,
                                             bool may_drop, std::string *error)
{
    std::unique_ptr<EyeThread> eyes(new EyeThread(config, seed, lcm, may_drop));

    eyes->thread_ = std::thread(&EyeThread::serve_jobs, eyes.get());
    std::unique_lock<std::mutex> lock(eyes->mutex_);
    eyes->changed_.wait(lock, [&] { return eyes->started_ || eyes->failed_; });
    if (!eyes->failed_)
        return eyes;
    *error = eyes->start_error_;
    return nullptr;
}

EyeThread::~EyeThread()
{
    {
        std::lock_guard<std::mutex> lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

bool EyeThread::start(std::string *error)
{
    renderer_ = Renderer::create(config_, error);
    if (renderer_)
        encoder_ = ImageMessage::create(config_, error);
    if (!encoder_)
        return false;
    log_info("eyes: %d x %d px, two eyes, drawn by %s", config_.width, config_.height,
             renderer_->name().c_str());
    return true;
}

void EyeThread::serve_jobs()
{
    std::string error;
    bool good = start(&error);
    EyeJob job;

    {
        std::lock_guard<std::mutex> lock(mutex_);
        started_ = good;
        failed_ = !good;
        start_error_ = error;
    }
    changed_.notify_all();
    while (good && next(&job))
        expose(job);
    renderer_.reset();
}

bool EyeThread::next(EyeJob *job)
{
    std::unique_lock<std::mutex> lock(mutex_);

    changed_.wait(lock, [this] { return ending_ || !jobs_.empty(); });
    if (jobs_.empty())
        return false;
    *job = std::move(jobs_.front());
    jobs_.pop_front();
    changed_.notify_all();
    return true;
}

void EyeThread::submit(EyeJob job)
{
    std::unique_lock<std::mutex> lock(mutex_);

    if (may_drop_ && jobs_.size() >= most_waiting) {
        jobs_.pop_front();
        dropped_++;
    }
    changed_.wait(lock, [this] { return jobs_.size() < most_waiting; });
    jobs_.push_back(std::move(job));
    changed_.notify_all();
}

void EyeThread::expose(const EyeJob &job)
{
    std::string error;

    renderer_->draw(job.snapshot, &pixels_);
    sensor_.expose(job.snapshot.number, &pixels_);
    std::vector<uint8_t> bytes = encoder_->encode(job.utime, pixels_, &error);
    if (!error.empty()) {
        log_error("%s", error.c_str());
        return;
    }
    if (job.release)
        sleep_until(job.release * 1000);
    await_turn(job.utime);
    publish(bytes);
    std::lock_guard<std::mutex> lock(mutex_);
    sent_.push_back({job.utime, std::move(bytes)});
    if (sent_.size() > most_kept)
        sent_.pop_front();
}

void EyeThread::due(int64_t utime)
{
    std::lock_guard<std::mutex> lock(mutex_);
    due_ = utime;
    changed_.notify_all();
}

void EyeThread::answered(int64_t utime)
{
    std::lock_guard<std::mutex> lock(mutex_);
    answered_ = utime;
    changed_.notify_all();
}

/* Neither a full queue, for whose sake the simulator stands, nor a clock that was set back may wait
 * for an answer that cannot come. */
void EyeThread::await_turn(int64_t utime)
{
    std::unique_lock<std::mutex> lock(mutex_);

    changed_.wait(lock, [&] {
        return may_drop_ || ending_ || sent_.empty() || answered_ >= sent_.back().utime ||
               utime <= due_ || utime <= sent_.back().utime || jobs_.size() >= most_waiting;
    });
}

void EyeThread::publish(const std::vector<uint8_t> &bytes)
{
    if (lcm_publish(lcm_, "STEREO_IMAGES", bytes.data(), static_cast<unsigned>(bytes.size())) < 0)
        log_warning("eyes: LCM did not take an image pair of %zu bytes", bytes.size());
}

void EyeThread::publish_again(int64_t utime)
{
    std::lock_guard<std::mutex> lock(mutex_);
    for (const Sent &sent : sent_)
        if (sent.utime == utime)
            publish(sent.bytes);
}

} // namespace sim
