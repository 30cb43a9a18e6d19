#include "simrobot/eyes/onlooker.h"

#include <cstring>

#include "common/program/log.h"

namespace sim
{
namespace
{

/* The matrix of a camera whose frame is x ahead, y left, z up. */
std::vector<uint8_t> camera_bytes(const Eigen::Isometry3d &eye, double focal_length)
{
    Eigen::Matrix3d lens;
    std::vector<uint8_t> bytes;

    lens << 0, -focal_length, 0, 0, 0, -focal_length, 1, 0, 0;
    Eigen::Matrix<double, 3, 4, Eigen::RowMajor> camera =
        lens * eye.inverse().matrix().topRows<3>();
    for (Eigen::Index i = 0; i < camera.size(); i++) {
        uint64_t bits;
        std::memcpy(&bits, camera.data() + i, sizeof bits);
        for (int shift = 56; shift >= 0; shift -= 8)
            bytes.push_back(static_cast<uint8_t>(bits >> shift));
    }
    return bytes;
}

} // namespace

Onlooker::Onlooker(const Config &config, bool robot_sees, lcm_t *lcm, bool may_drop)
    : config_(config), robot_sees_(robot_sees), may_drop_(may_drop), lcm_(lcm),
      bystander_(config.height / (2 * config.focal_length))
{
}

std::unique_ptr<Onlooker> Onlooker::create(const Config &config, bool robot_sees, lcm_t *lcm,
                                           bool may_drop, std::string *error)
{
    std::unique_ptr<Onlooker> onlooker(new Onlooker(config, robot_sees, lcm, may_drop));

    onlooker->thread_ = std::thread(&Onlooker::serve, onlooker.get());
    std::unique_lock<std::mutex> lock(onlooker->mutex_);
    onlooker->changed_.wait(lock, [&] { return onlooker->ready_; });
    *error = onlooker->start_error_;
    lock.unlock();
    return error->empty() ? std::move(onlooker) : nullptr;
}

Onlooker::~Onlooker()
{
    {
        std::lock_guard<std::mutex> lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void Onlooker::look(Snapshot snapshot, int64_t utime)
{
    std::unique_lock<std::mutex> lock(mutex_);

    if (may_drop_ && job_)
        return;
    changed_.wait(lock, [this] { return !job_; });
    job_ = Job{std::move(snapshot), utime};
    changed_.notify_all();
}

bool Onlooker::start(std::string *error)
{
    renderer_ = Renderer::create(config_, error);
    if (renderer_)
        encoder_ = ImageMessage::create(config_, error);
    return encoder_ != nullptr;
}

void Onlooker::serve()
{
    std::string error;
    bool good = start(&error);

    std::unique_lock<std::mutex> lock(mutex_);
    ready_ = true;
    start_error_ = error;
    changed_.notify_all();
    while (good) {
        changed_.wait(lock, [this] { return ending_ || job_; });
        if (ending_)
            break;
        Job job = std::move(*job_); /* job_ stays, empty, so that look() waits */
        lock.unlock();
        draw(std::move(job));
        lock.lock();
        job_.reset();
        changed_.notify_all();
    }
    renderer_.reset();
}

void Onlooker::draw(Job job)
{
    const double f = config_.focal_length;
    std::vector<ImageNote> notes;
    std::string error;

    if (robot_sees_)
        notes = {{0, "left_eye", camera_bytes(job.snapshot.left_eye, f)},
                 {0, "right_eye", camera_bytes(job.snapshot.right_eye, f)}};
    bystander_.look_on(&job.snapshot);
    notes.push_back({0, "camera", camera_bytes(job.snapshot.left_eye, f)});
    notes.push_back({1, "camera", camera_bytes(job.snapshot.right_eye, f)});
    renderer_->draw(job.snapshot, &pixels_);
    std::vector<uint8_t> bytes = encoder_->encode(job.utime, pixels_, &error, notes);
    if (!error.empty())
        log_error("view: %s", error.c_str());
    else if (lcm_publish(lcm_, "SIM_VIEW", bytes.data(), static_cast<unsigned>(bytes.size())) < 0)
        log_warning("view: LCM did not take a picture of %zu bytes", bytes.size());
}

} // namespace sim
