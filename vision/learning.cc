#include "vision/learning.h"

#include <lcm/lcm.h>

#include <cstdio>
#include <cstring>
#include <memory>

#include "common/bus/open.h"
#include "common/program/log.h"
#include "vision/answers/show.h"
#include "vision/colour/learner.h"
#include "vision/pairs.h"
#include "vision/rig/calibrate.h"

static const int poll_ms = 100;

bool learning_asked(const arguments &given)
{
    return given.calibrate || given.learn_colour;
}

static int calibrate(const arguments &given, const vision_config &config, lcm_t *lcm,
                     const volatile sig_atomic_t *stop)
{
    rig_calibrator learner(config_eyes(config));
    const std::unique_ptr<source> pairs = pairs_open(given, config, lcm, &learner);
    source_state state = SOURCE_OPEN;

    if (!pairs)
        return 1;
    log_info("move the ball slowly through both eyes' pictures, near and far, for 30 s");
    while (!*stop && state == SOURCE_OPEN && !learner.done())
        state = pairs->poll(poll_ms);
    return learner.finish(given.calibrate, given.draw) ? 1 : 0;
}

static void on_click(int column, int row, void *user)
{
    static_cast<colour_learner *>(user)->point(
        {static_cast<double>(column), static_cast<double>(row)});
    log_info("column %d, row %d: now move the ball a little for 5 s", column, row);
}

/* Until a click, and enough pictures after it; without a window until there are enough. */
static bool wants_more(const arguments &given, const colour_learner &learner)
{
    return (given.show && !learner.pointed()) || !learner.done();
}

static int learn_colour(const arguments &given, const vision_config &config, lcm_t *lcm,
                        const volatile sig_atomic_t *stop)
{
    colour_learner learner;
    const std::unique_ptr<source> pairs = pairs_open(given, config, lcm, &learner);
    source_state state = SOURCE_OPEN;

    if (!pairs)
        return 1;
    if (given.has_at)
        learner.point(given.at);
    if (given.show)
        show_on_click(on_click, &learner);
    log_info("%s", given.show     ? "click the ball in the window"
                   : given.has_at ? "move the ball a little for 5 s"
                                  : "move the ball for 5 s, and nothing else");
    while (!*stop && state == SOURCE_OPEN && wants_more(given, learner)) {
        state = pairs->poll(poll_ms);
        if (given.show && !learner.newest().empty())
            show_window(learner.newest());
    }
    while (given.show && !*stop && !learner.pointed() && show_window(learner.newest()))
        ; /* the pictures have ended; the click has still to come */
    if (strncmp(given.learn_colour, "/dev/", 5) != 0) /* a camera has been asked itself */
        log_info("cameras that set white balance and exposure themselves change the ball's colour; "
                 "lock them: v4l2-ctl -d /dev/videoN -c white_balance_automatic=0 -c "
                 "auto_exposure=1");
    return learner.finish(stdout, given.draw) ? 1 : 0;
}

int learning_run(const arguments &given, const vision_config &config,
                 const volatile sig_atomic_t *stop)
{
    char error[512];
    lcm_t *lcm = nullptr;

    if (given.calibrate && config.tag_dictionary > 0) {
        log_error(
            "--calibrate learns from a ball; leave marker.dictionary out while you calibrate, "
            "or use --from-opencv");
        return 1;
    }
    if (pairs_on_bus(given) && !(lcm = bus_open(given.url, error, sizeof error))) {
        log_error("%s", error);
        return 1;
    }
    const int code = given.calibrate ? calibrate(given, config, lcm, stop)
                                     : learn_colour(given, config, lcm, stop);
    if (lcm)
        lcm_destroy(lcm);
    return code;
}
