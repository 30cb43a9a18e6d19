/* The simulator on the bus, with this test as its daemon and its experimenter. */
#include <bot_core_images_t.h>
#include <bot_core_joint_state_t.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "partner.h"
#include "tests/unit/suite.h"

namespace
{

const char other_url[] = "udpm://239.255.76.68:7668?ttl=0";

} // namespace

START_TEST(test_fingerprints_are_those_of_others_tools)
{
    ck_assert_uint_eq(static_cast<uint64_t>(__bot_core_image_t_get_hash()), 0x14739ffe13d5f5f0u);
    ck_assert_uint_eq(static_cast<uint64_t>(__bot_core_images_t_get_hash()), 0x20ba4f05e8f5e33au);
    ck_assert_uint_eq(static_cast<uint64_t>(__bot_core_joint_state_t_get_hash()),
                      0x3e377b4cebc593a4u);
}
END_TEST

START_TEST(test_bad_commands_are_refused_and_counted)
{
    auto bus = open_simulator();
    Partner partner;
    sim::Command command;
    reach_robot_command_t message = {};
    int64_t expected = 0;

    auto refused_after = [&](const void *data, size_t size) {
        partner.publish("ROBOT_COMMAND", data, size);
        for (int i = 0; i < 100 && bus->refused() == expected; i++)
            ck_assert(bus->handle(10));
        expected++;
        return bus->refused() == expected && !bus->take_command(&command);
    };
    auto bytes_of = [&] {
        std::vector<uint8_t> bytes(
            static_cast<size_t>(reach_robot_command_t_encoded_size(&message)));
        reach_robot_command_t_encode(bytes.data(), 0, static_cast<int>(bytes.size()), &message);
        return bytes;
    };

    message.n_joints = 6;
    std::vector<uint8_t> good = bytes_of();
    ck_assert(refused_after("", 0));
    ck_assert(refused_after(good.data(), good.size() - 1));
    ck_assert(refused_after("garbage, and some more of it", 28));
    for (int n : {-1, 0, 5, 7, 16, INT32_MAX}) {
        message.n_joints = n;
        std::vector<uint8_t> bytes = bytes_of();
        ck_assert(refused_after(bytes.data(), bytes.size()));
    }
    message.n_joints = 6;
    for (double v : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        message.velocity[5] = v;
        std::vector<uint8_t> bytes = bytes_of();
        ck_assert(refused_after(bytes.data(), bytes.size()));
    }
    partner.publish("ROBOT_COMMAND", good.data(), good.size());
    for (int i = 0; i < 100 && !bus->take_command(&command); i++)
        ck_assert(bus->handle(10));
    ck_assert_uint_eq(command.velocity.size(), 6);
    ck_assert_int_eq(bus->refused(), expected);
}
END_TEST

START_TEST(test_second_simulator_is_refused)
{
    std::atomic<bool> done{false};
    auto first = open_simulator();
    std::thread answers([&] {
        while (!done)
            first->handle(10);
    });
    std::string error;
    auto second = sim::SimBus::open(nullptr, nullptr, {"a"}, &error);
    ck_assert(!second);
    ck_assert_ptr_nonnull(strstr(error.c_str(), "another simrobot"));
    done = true;
    answers.join();
}
END_TEST

START_TEST(test_states_follow_the_answers)
{
    Partner partner;
    Running simulator({false, false, true, nullptr, 1, patient});

    ck_assert(partner.drive(50, 0.3));
    ck_assert_int_eq(partner.states[0].utime, 1000000);
    for (size_t i = 0; i < partner.states.size(); i++) {
        ck_assert_int_eq(partner.states[i].seq, static_cast<int64_t>(i) + 1);
        ck_assert_int_eq(partner.states[i].utime, 1000000 + static_cast<int64_t>(i) * 20000);
        ck_assert_int_eq(partner.states[i].lockstep, 1);
        ck_assert_int_eq(partner.states[i].n_joints, 6);
    }
    /* Half a second at 0.3 rad/s and more. */
    ck_assert_double_eq_tol(partner.states[49].position[3] - partner.states[0].position[3],
                            0.3 * 0.98, 0.01);
}
END_TEST

/* Where it is measured comes before the state that it is due with, whenever that is sent. */
START_TEST(test_the_effector_comes_before_its_state)
{
    Partner partner;
    Running simulator(
        {false, false, true, nullptr, 1, "lockstep.resend=0.1", "effector.published=true"});

    ck_assert(partner.drive(5, 0.3));
    size_t before = partner.states.size();
    ck_assert(partner.wait([&] { return partner.states.size() > before; }));
    ck_assert_uint_eq(partner.states.size(), partner.effectors.size());
    for (size_t i = 0; i < partner.states.size(); i++) {
        const reach_end_effector_t &effector = partner.effectors[i];
        ck_assert_str_eq(partner.order[2 * i].c_str(), "effector");
        ck_assert_int_eq(effector.utime, partner.states[i].utime);
        ck_assert_int_eq(effector.seq, partner.states[i].seq);
        ck_assert_int_eq(partner.states[i].effector_due, effector.utime);
    }
    for (size_t i = 0; i < partner.truths.size() && i < 5; i++)
        for (int axis = 0; axis < 3; axis++)
            ck_assert_double_eq_tol(partner.effectors[i].position[axis],
                                    partner.truths[i].marker[axis], 1e-12);
}
END_TEST

START_TEST(test_unanswered_state_comes_again)
{
    Partner partner;
    Running simulator({false, false, true, nullptr, 1, "lockstep.resend=0.1"});

    ck_assert(partner.wait([&] { return partner.states.size() >= 3; }));
    for (const reach_robot_state_t &state : partner.states) {
        ck_assert_int_eq(state.seq, 1);
        ck_assert_double_eq(state.position[0], partner.states[0].position[0]);
    }
    /* A command that answers another state moves nothing. */
    partner.states.back().seq = 99;
    partner.answer(0.3);
    size_t before = partner.states.size();
    ck_assert(partner.wait([&] { return partner.states.size() > before + 1; }));
    ck_assert_int_eq(partner.states.back().seq, 1);
}
END_TEST

/* Held, it stands; told how far, it goes exactly there; requests are acknowledged at once. */
START_TEST(test_experimenter_holds_the_clock)
{
    Partner partner;
    Running simulator({true, false, true, nullptr, 1, patient});

    ck_assert(!partner.wait([&] { return !partner.states.empty(); }, 300));
    partner.request(REACH_SIM_REQUEST_T_RUN_UNTIL, 1, 0, 0, 1100000);
    ck_assert(partner.drive(6, 0));
    partner.answer(0);
    ck_assert(!partner.wait([&] { return partner.states.back().seq > 6; }, 300));
    ck_assert_int_eq(partner.states.back().utime, 1100000);
    partner.request(REACH_SIM_REQUEST_T_TOOL, 2, 1);
    ck_assert(partner.acknowledged(2));
    ck_assert_int_eq(partner.truths.back().tool, 1);
    ck_assert_int_eq(partner.states.back().seq, 6);
    partner.request(REACH_SIM_REQUEST_T_RUN_UNTIL, 3, 0, 0, 1200000);
    ck_assert(partner.drive(11, 0));
    ck_assert_int_eq(partner.states.back().utime, 1200000);
}
END_TEST

START_TEST(test_bad_requests_are_not_acknowledged)
{
    Partner partner;
    Running simulator({true, false, true, nullptr, 1, patient});
    int64_t seq = 10;

    auto refused = [&](int kind, int tool, double value) {
        partner.request(kind, ++seq, tool, value);
        return !partner.acknowledged(seq, 100);
    };

    ck_assert(refused(REACH_SIM_REQUEST_T_VIEW, 0, 1)); /* nobody looks on */
    ck_assert(refused(-1, 0, 0) && refused(99, 0, 0));
    ck_assert(refused(REACH_SIM_REQUEST_T_TOOL, 3, 0));
    ck_assert(refused(REACH_SIM_REQUEST_T_TOOL, -1, 0));
    ck_assert(refused(REACH_SIM_REQUEST_T_LIGHT, 0, std::nan("")));
    ck_assert(refused(REACH_SIM_REQUEST_T_LIGHT, 0, -1));
    ck_assert(refused(REACH_SIM_REQUEST_T_SPEED, 0, 1));
    partner.publish("SIM_REQUEST", "not a request", 13);
    partner.request(REACH_SIM_REQUEST_T_LIGHT, ++seq, 0, 0.5);
    ck_assert(partner.acknowledged(seq));
}
END_TEST

START_TEST(test_quit_ends_the_run)
{
    Partner partner;
    Running simulator({true, false, true, nullptr, 1, patient});

    ck_assert(!partner.wait([&] { return false; }, 100));
    partner.request(REACH_SIM_REQUEST_T_QUIT, 1);
    ck_assert(partner.wait([&] { return simulator.ended.load(); }));
}
END_TEST

START_TEST(test_pause_and_resume)
{
    Partner partner;
    Running simulator({false, false, true, nullptr, 1, patient});

    ck_assert(partner.drive(5, 0));
    partner.request(REACH_SIM_REQUEST_T_PAUSE, 1);
    usleep(50000);
    partner.answer(0);
    ck_assert(partner.acknowledged(1));
    ck_assert(!partner.wait([&] { return partner.states.back().seq > 5; }, 300));
    partner.request(REACH_SIM_REQUEST_T_RESUME, 2);
    ck_assert(partner.drive(8, 0));
}
END_TEST

START_TEST(test_without_truth_nothing_is_told)
{
    Partner partner;
    Running simulator({false, false, false, nullptr, 1, patient});

    ck_assert(partner.drive(20, 0));
    ck_assert_uint_eq(partner.truths.size(), 0);
}
END_TEST

/* What touches is said while it does, and once more when it does no longer. */
START_TEST(test_contacts_are_told_with_the_truth)
{
    for (bool truth : {true, false}) {
        sim::Config config = fixture::config({}, "simrobot-icub.yaml");
        sim::Rig rig = fixture::rig(config);
        sim::Simulation simulation(config, rig, 1);
        Partner partner;
        auto bus = open_simulator(nullptr, 7);
        sim::Session session(config, simulation, *bus, nullptr, {}, truth);

        session.publish_state();
        fixture::go_to(simulation, {0, 0, 80, 80, 0, 0, 10}, 100);
        session.publish_state();
        session.publish_state();
        fixture::go_to(simulation, {-40, 40, 40, 50, 0, 0, 10}, 100);
        for (int i = 0; i < 3; i++)
            session.publish_state();
        ck_assert(partner.wait([&] { return partner.states.size() == 6; }));
        ck_assert_uint_eq(partner.contacts.size(), truth ? 3 : 0);
        for (size_t i = 0; i < partner.contacts.size(); i++) {
            ck_assert_int_eq(partner.contacts[i].seq, static_cast<int64_t>(i) + 2);
            ck_assert_int_eq(partner.contacts[i].touching > 0, i < 2);
        }
    }
}
END_TEST

START_TEST(test_truth_may_go_elsewhere)
{
    Partner here, there(other_url);
    Running simulator({true, false, true, other_url, 1, patient});

    usleep(100000);
    there.request(REACH_SIM_REQUEST_T_TOOL, 1, 2);
    ck_assert(there.acknowledged(1));
    ck_assert_int_eq(there.truths.back().tool, 2);
    ck_assert(!here.wait([&] { return !here.truths.empty(); }, 100));
}
END_TEST

/* Two runs of one seed: every state, truth and image the same, whatever the machine was doing. */
START_TEST(test_runs_with_eyes_repeat_to_the_byte)
{
    std::vector<reach_robot_state_t> states[2];
    std::vector<std::vector<uint8_t>> images[2];
    std::vector<double> truths[2];

    for (int run = 0; run < 2; run++) {
        Partner partner;
        Running simulator({false, true, true, nullptr, 5, patient});
        ck_assert(partner.drive(21, 0.2));
        /* The last two of twelve wait for answers that this partner does not give. */
        ck_assert(partner.wait([&] { return partner.images.size() >= 10; }));
        states[run] = partner.states;
        images[run] = partner.images;
        images[run].resize(10);
        for (const reach_sim_truth_t &truth : partner.truths)
            truths[run].insert(truths[run].end(),
                               {truth.u_right, truth.v_right, truth.disparity, truth.visible,
                                truth.x_fixation[0], truth.marker_speed});
    }
    ck_assert_uint_eq(states[0].size(), states[1].size());
    for (size_t i = 0; i < states[0].size(); i++)
        ck_assert_mem_eq(&states[0][i], &states[1][i], sizeof states[0][i]);
    ck_assert(images[0] == images[1]);
    ck_assert(truths[0] == truths[1]);
}
END_TEST

/* A state says which image its tick waits for; sent again, it brings that image again. */
START_TEST(test_image_that_is_due_comes_again)
{
    Partner partner;
    Running simulator({false, true, true, nullptr, 1, "lockstep.resend=1"});

    ck_assert(partner.drive(5, 0));
    /* t = 80 ms: the exposure at 33 ms is due with 33 ms of latency, that at 66 ms is not. */
    ck_assert_int_eq(partner.states[4].vision_due, 1033000);
    ck_assert_int_eq(partner.states[0].vision_due, 0);
    ck_assert(partner.wait([&] { return partner.images.size() >= 3; }));
    bot_core_images_t first = {};
    const std::vector<uint8_t> &bytes = partner.images[0];
    ck_assert_int_ge(
        bot_core_images_t_decode(bytes.data(), 0, static_cast<int>(bytes.size()), &first), 0);
    ck_assert_int_eq(first.utime, 1033000);
    ck_assert_int_eq(first.n_images, 2);
    ck_assert_int_eq(first.images[0].width, 640);
    ck_assert_int_eq(first.images[1].pixelformat, BOT_CORE_IMAGE_T_PIXEL_FORMAT_MJPEG);
    bot_core_images_t_decode_cleanup(&first);
    ck_assert(partner.images[2] == partner.images[0]);
}
END_TEST

int main()
{
    const TTest *tests[] = {test_fingerprints_are_those_of_others_tools,
                            test_bad_commands_are_refused_and_counted,
                            test_second_simulator_is_refused,
                            test_states_follow_the_answers,
                            test_the_effector_comes_before_its_state,
                            test_unanswered_state_comes_again,
                            test_experimenter_holds_the_clock,
                            test_bad_requests_are_not_acknowledged,
                            test_quit_ends_the_run,
                            test_pause_and_resume,
                            test_without_truth_nothing_is_told,
                            test_contacts_are_told_with_the_truth,
                            test_truth_may_go_elsewhere,
                            test_runs_with_eyes_repeat_to_the_byte,
                            test_image_that_is_due_comes_again};
    return SUITE_RUN("simrobot bus", tests);
}
