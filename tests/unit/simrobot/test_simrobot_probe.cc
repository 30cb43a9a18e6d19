/* The numbers that others check the simulator by. */
#include <cmath>
#include <cstring>
#include <functional>

#include "fixture.h"
#include "simrobot/world/probe.h"
#include "simrobot/world/strength.h"
#include "tests/unit/suite.h"

namespace
{

std::string said(const std::function<void(FILE *)> &probe)
{
    char *text = nullptr;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);

    probe(out);
    fclose(out);
    std::string result(text, size);
    free(text);
    return result;
}

/* The numbers in the list of this name, from the first one at or after `from` on. */
std::vector<double> list(const std::string &text, const char *name, size_t from)
{
    size_t at = text.find('[', text.find(std::string("\"") + name + "\"", from));
    std::vector<double> numbers;
    const char *next = text.c_str() + at + 1;

    while (*next != ']') {
        char *end;
        numbers.push_back(strtod(next, &end));
        ck_assert_ptr_ne(end, next);
        next = *end == ',' ? end + 1 : end;
    }
    return numbers;
}

double number(const std::string &text, const char *name)
{
    return strtod(text.c_str() + text.find(':', text.find(name)) + 1, nullptr);
}

} // namespace

START_TEST(test_a_line_for_each_posture)
{
    sim::Config config = fixture::config({}, "simrobot-sixaxis.yaml");
    sim::Rig rig = fixture::rig(config);
    std::string text = said([&](FILE *out) { sim::probe_postures(config, rig, 5, 20, out); });
    size_t line = 0;

    for (int i = 0; i < 20; i++) {
        std::vector<double> angles = list(text, "position", line);
        std::vector<double> place = list(text, "place", line);
        std::vector<double> gravity = list(text, "gravity", line);
        ck_assert_uint_eq(angles.size(), 6);
        for (size_t k = 0; k < 6; k++) {
            const sim::Segment &joint =
                rig.description.segments[static_cast<size_t>(rig.joints[k])];
            ck_assert(angles[k] >= joint.lower && angles[k] <= joint.upper);
        }
        Eigen::Vector3d there = rig_link(rig.hand, rig_forward(rig, angles)).translation();
        for (size_t k = 0; k < 3; k++)
            ck_assert_double_eq(place[k], there[static_cast<int>(k)]);
        std::vector<double> torques = sim::gravity_torques(rig, config.ball_mass, angles);
        for (size_t k = 0; k < 6; k++)
            ck_assert_double_eq(gravity[k], torques[k]);
        line = text.find('\n', line) + 1;
    }
    ck_assert_uint_eq(line, text.size());
}
END_TEST

/* What drifts is the integrator's, of first order: with a fifth of the step some fifth is left. */
START_TEST(test_a_free_swing_keeps_its_energy)
{
    sim::Config coarse = fixture::config({}, "simrobot-sixaxis.yaml");
    sim::Config fine = fixture::config({"physics.step=1"}, "simrobot-sixaxis.yaml");
    sim::Rig rig = fixture::rig(fine);

    ck_assert_int_eq(coarse.physics_step, 5);
    for (uint64_t seed = 1; seed <= 3; seed++) {
        std::string rough = said([&](FILE *out) { probe_swing(coarse, rig, seed, 2, out); });
        std::string exact = said([&](FILE *out) { probe_swing(fine, rig, seed, 2, out); });
        ck_assert_double_gt(number(exact, "kinetic"), 1);
        ck_assert_msg(number(exact, "drift") < 0.1 * number(exact, "kinetic"), "%s", exact.c_str());
        ck_assert_msg(number(exact, "drift") < 0.4 * number(rough, "drift"), "%s%s", exact.c_str(),
                      rough.c_str());
    }
}
END_TEST

START_TEST(test_random_commands_throw_no_joint)
{
    for (const char *name : {"simrobot-sixaxis.yaml", "simrobot-icub.yaml"}) {
        sim::Config config = fixture::config({"robot.collisions=false"}, name);
        sim::Rig rig = fixture::rig(config);
        std::string text = said([&](FILE *out) { probe_speeds(config, rig, 1, 60, out); });
        ck_assert_msg(number(text, "fastest") > 0.9 && number(text, "fastest") < 1.2, "%s",
                      text.c_str());
        ck_assert_ptr_nonnull(strstr(text.c_str(), "\"joint\": \""));
    }
}
END_TEST

int main()
{
    const TTest *tests[] = {test_a_line_for_each_posture, test_a_free_swing_keeps_its_energy,
                            test_random_commands_throw_no_joint};
    return SUITE_RUN("simrobot probe", tests);
}
