/* When the cameras expose: 30 Hz on the physics grid, 33, 33 and 34 ms apart, the first 33 ms after
 * the start. And which image's marker is due at a given time. */
#ifndef SIMROBOT_EYES_EXPOSURES_H
#define SIMROBOT_EYES_EXPOSURES_H

#include <cstddef>
#include <cstdint>
#include <deque>

namespace sim
{

class Exposures
{
public:
    /* `latency`: from exposure to the moment when the image is there; us. */
    explicit Exposures(int64_t latency) : latency_(latency) {}

    /* Whether the cameras expose after this many physics steps. */
    static bool at_step(int64_t step);

    /* Notes an exposure at `utime`.
     *   returns its number, counting from 1. */
    int64_t add(int64_t utime);

    /* utime of the newest exposure whose latency has passed at `now`; 0 = none. */
    int64_t due(int64_t now) const;

private:
    /* At 30 Hz this reaches back two seconds, longer than any latency. */
    static constexpr size_t kept = 64;

    int64_t latency_;
    int64_t count_ = 0;
    std::deque<int64_t> utimes_;
};

} // namespace sim
#endif
