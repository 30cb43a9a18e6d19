/* Which joints of a URDF move, and how: driven, following another (<mimic>), or fixed. */
#ifndef SIMROBOT_SETUP_DRIVES_H
#define SIMROBOT_SETUP_DRIVES_H

#include "simrobot/setup/description.h"
#include "simrobot/setup/urdf_source.h"

namespace sim
{

/* How a joint comes by its angle: multiplier * that of `leader` + offset. */
struct Drive {
    std::string leader; /* a driven joint, maybe the joint itself; "" = fixed at `offset` */
    double multiplier = 1, offset = 0;
};

class Drives
{
public:
    /* What is wrong with a joint that moves is said to `source`. All three outlive this. */
    Drives(const urdf::ModelInterface &model, const std::set<std::string> &driven,
           UrdfSource *source)
        : model_(model), driven_(driven), source_(source)
    {
    }

    Drive of(const urdf::Joint &joint) const;

    /* Joint frame moved by a joint that stands at `angle`. */
    static Eigen::Isometry3d moved(const urdf::Joint &joint, double angle);

    /* A segment on this joint, without links yet. `origin` as in Segment. */
    Segment segment(const urdf::Joint &joint, const Drive &drive, int parent,
                    const Eigen::Isometry3d &origin) const;

private:
    void set_limits(const urdf::Joint &joint, Segment *segment) const;
    void set_motor(const urdf::Joint &joint, Segment *segment) const;

    const urdf::ModelInterface &model_;
    const std::set<std::string> &driven_;
    UrdfSource *source_;
};

} // namespace sim
#endif
