#include "simrobot/eyes/exposures.h"

namespace sim
{

bool Exposures::at_step(int64_t step)
{
    /* The n-th exposure is at floor(100 n / 3) ms. */
    int64_t n = (3 * step + 2) / 100;
    return n > 0 && n * 100 / 3 == step;
}

int64_t Exposures::add(int64_t utime)
{
    utimes_.push_back(utime);
    if (utimes_.size() > kept)
        utimes_.pop_front();
    return ++count_;
}

int64_t Exposures::due(int64_t now) const
{
    for (auto utime = utimes_.rbegin(); utime != utimes_.rend(); ++utime)
        if (*utime + latency_ <= now)
            return *utime;
    return 0;
}

} // namespace sim
