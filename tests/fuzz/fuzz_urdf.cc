/* A robot's description. What is taken is a tree of segments. */
#include <cmath>

#include "harness.h"
#include "simrobot/setup/description.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sim::Description description;
    sim::Findings findings;
    const sim::Wanted wanted{{"shoulder_pitch", "shoulder_yaw", "shoulder_roll", "elbow"}, false};

    if (!sim::description_load(harness_file(data, size), wanted, &description, &findings)) {
        HARNESS_REQUIRE(!findings.faults.empty());
        return 0;
    }
    if (!findings.faults.empty())
        return 0;
    HARNESS_REQUIRE(!description.segments.empty() && description.segments[0].parent == -1);
    for (size_t i = 1; i < description.segments.size(); i++) {
        const sim::Segment &segment = description.segments[i];
        HARNESS_REQUIRE(segment.parent >= 0 && segment.parent < static_cast<int>(i));
        HARNESS_REQUIRE(std::isfinite(segment.mass) && segment.axis.allFinite());
    }
    return 0;
}
