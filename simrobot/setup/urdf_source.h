/* The text of a URDF file, and what urdfdom does not tell of it: lines, and attributes that it
 * takes otherwise than they are meant.
 *
 * urdfdom gives up a link at the first thing in it that it cannot read, says so on stderr, and
 * still returns the robot without the rest of that link. Here every such line is a fault. */
#ifndef SIMROBOT_SETUP_URDF_SOURCE_H
#define SIMROBOT_SETUP_URDF_SOURCE_H

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <map>
#include <set>
#include <string>

#include "simrobot/setup/findings.h"

namespace sim
{

class UrdfSource
{
public:
    UrdfSource(std::string path, Findings *findings);

    /* Reads the file and what it means. Joints that are not in `moving` and follow no other are
     * made fixed before urdfdom sees them: what is wrong with their motors does not matter.
     *   returns nullptr when nothing of it can be used; the faults say why */
    urdf::ModelInterfaceSharedPtr load(const std::set<std::string> &moving);

    /* Says something of a link or joint, with file and line. */
    void fault(const char *kind, const std::string &name, const std::string &what);
    void note(const char *kind, const std::string &name, const std::string &what);

    /* Whether a joint's <limit> has this attribute. */
    bool has_limit(const std::string &joint, const char *attribute) const;

private:
    std::string place(const char *kind, const std::string &name) const;
    bool read(std::string *text);
    urdf::ModelInterfaceSharedPtr parse(const std::string &text);

    std::string path_;
    Findings *findings_;
    std::map<std::string, int> lines_; /* of "link NAME" and "joint NAME" */
    std::set<std::string> limits_;     /* "JOINT ATTRIBUTE" */

    friend class UrdfNormaliser;
};

} // namespace sim
#endif
