/* Keeps the robot's links and its tool from passing through each other: the URDF's <collision>
 * shapes as ODE geometries, and a contact joint wherever two of them overlap.
 *
 * What a joint joins overlaps there always. So a segment never collides with the one that carries
 * it, nor the tool with the segment that holds it, nor two shapes that overlap in the pose in which
 * the robot starts. All pairs are looked at in one fixed order: the same run gives the same bits.
 */
#ifndef SIMROBOT_WORLD_CONTACTS_H
#define SIMROBOT_WORLD_CONTACTS_H

#include "simrobot/world/robot.h"
#include "simrobot/world/tool.h"

namespace sim
{

class Contacts
{
public:
    /* Of the robot as it stands now. World, rig and robot must outlive this. */
    Contacts(World &world, const Rig &rig, const Robot &robot);
    ~Contacts();
    Contacts(const Contacts &) = delete;
    Contacts &operator=(const Contacts &) = delete;

    /* In the hand from now on; the tool before it may be gone already. */
    void take_tool(const Tool &tool);

    /* Before each physics step: finds what touches, and lets the step keep it apart. */
    void find();

    /* Pairs of shapes that touched at the newest step, and how deep the deepest was, m. */
    int touching() const
    {
        return touching_;
    }
    double depth() const
    {
        return depth_;
    }

private:
    struct Body {
        dGeomID geom;
        int segment;
    };

    void add(const BodyShape &shape, int segment, std::vector<Body> *bodies);
    void press(dGeomID one, dGeomID other);
    bool related(int one, int other) const;

    World &world_;
    const Rig &rig_;
    dJointGroupID joints_;
    std::vector<Body> links_, tool_;
    std::vector<std::pair<dGeomID, dGeomID>> of_links_, with_tool_;
    int touching_ = 0;
    double depth_ = 0;
};

} // namespace sim
#endif
