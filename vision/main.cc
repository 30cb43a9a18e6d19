#include <lcm/lcm.h>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <reach_hello_t.h>
#include <reach_marker_t.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>

#include "common/bus/open.h"
#include "common/logs/event_log.h"
#include "common/program/log.h"
#include "common/program/notify.h"
#include "vision/answers/observer.h"
#include "vision/answers/show.h"
#include "vision/arguments.h"
#include "vision/bench.h"
#include "vision/config.h"
#include "vision/learning.h"
#include "vision/pairs.h"
#include "vision/pictures/image_file.h"
#include "vision/pictures/receive_buffer.h"
#include "vision/rig/from_opencv.h"
#include "vision/rig/rig_file.h"

static const int claim_wait_ms = 300;
static const int poll_ms = 100;
static const int tag_side = 1200;              /* px, of a tag to print */
static const int64_t report_period = 60000000; /* us, in the log */
static const int64_t tell_period = 1000000;    /* us, to the service manager */

static volatile sig_atomic_t stop_asked;

namespace
{
/* Puts markers on the bus, and pictures on the screen where somebody wants them. */
class bus_publisher : public marker_receiver
{
public:
    bus_publisher(lcm_t *lcm, bool show) : lcm_(lcm), show_(show) {}

    void publish(const reach_marker_t &marker) override
    {
        if (reach_marker_t_publish(lcm_, "MARKER", &marker) < 0)
            log_warning("LCM could not send a marker");
    }

    void show(const image_view &left, const image_view &right, const eyes &who,
              const reach_marker_t &marker) override
    {
        char caption[160];

        if (!show_)
            return;
        snprintf(caption, sizeof caption, "%s  u %.1f  v %.1f  disparity %.1f  radius %.1f px",
                 stereo_reason_text(static_cast<stereo_reason>(marker.reason)), marker.u_right,
                 marker.v_right, marker.disparity, marker.radius);
        if (show_window(
                show_draw(left, right, who, static_cast<stereo_reason>(marker.reason), caption)))
            return;
        log_warning("the display refuses the window; going on without it");
        show_ = false;
    }

private:
    lcm_t *lcm_;
    bool show_;
};
} // namespace

static void ask_stop(int)
{
    stop_asked = 1;
}

static void catch_signals()
{
    struct sigaction action = {};

    action.sa_handler = ask_stop;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

static void report(const statistics &counts)
{
    char line[512];

    statistics_line(counts, line, sizeof line);
    log_info("%s", line);
    statistics_unseen(counts, line, sizeof line);
    if (line[0])
        log_info("not seen: %s", line);
}

/* Tells log and service manager from time to time how it goes. */
class reporter
{
public:
    explicit reporter(const statistics &counts) : counts_(counts) {}

    void keep(int64_t now)
    {
        notify_watchdog_feed(&watchdog_, now);
        if (now - told_ >= tell_period) {
            told_ = now;
            notify_send("STATUS=%lld pairs, %lld seen", static_cast<long long>(counts_.pairs),
                        static_cast<long long>(counts_.reasons[0]));
        }
        if (now - reported_ >= report_period) {
            reported_ = now;
            report(counts_);
        }
    }

private:
    const statistics &counts_;
    notify_watchdog watchdog_ = notify_watchdog_open();
    int64_t reported_ = bus_monotonic_us(), told_ = 0;
};

/* Until a signal or the end of the pairs. Returns the exit code. */
static int serve(source *pairs, lcm_t *lcm, bool own_pace, const statistics &counts)
{
    reporter progress(counts);
    source_state state = SOURCE_OPEN;

    while (!stop_asked && state == SOURCE_OPEN) {
        state = pairs->poll(poll_ms);
        /* Pairs that do not come over the bus leave the questions of others unanswered there. */
        if (own_pace && lcm_handle_timeout(lcm, 0) < 0)
            state = SOURCE_FAILED;
        progress.keep(bus_monotonic_us());
    }
    notify_send("STOPPING=1");
    if (state == SOURCE_FAILED && !stop_asked) {
        log_error("the source of pictures failed: no more pairs can be read");
        return 1;
    }
    return 0;
}

static int write_stats(const char *path, const statistics &counts)
{
    FILE *out;

    if (event_log_begins(path)) {
        log_error("%s: is a log, and is not overwritten", path);
        return 1;
    }
    out = fopen(path, "w");
    if (out) {
        statistics_json(counts, out);
        if (fclose(out) == 0)
            return 0;
    }
    log_error("%s: %s", path, strerror(errno));
    return 1;
}

/* Whether recorded pairs were of no use, which is then said. */
static bool in_vain(const arguments &given, const statistics &counts)
{
    if (given.log && counts.pairs + counts.malformed == 0)
        log_error("%s: no pairs of pictures (channel STEREO_IMAGES) are in it", given.log);
    else if ((given.videos[0] || given.log) && statistics_nothing_usable(counts))
        log_error("not one pair could be used: see the warnings above");
    else
        return false;
    return true;
}

static int see(const arguments &given, const vision_config &config, lcm_t *lcm)
{
    bus_publisher publisher(lcm, given.show);
    observer seer(config_eyes(config), static_cast<int64_t>(config.drop_after * 1e6), &publisher);
    const std::unique_ptr<source> pairs = pairs_open(given, config, lcm, &seer);

    if (!pairs)
        return 1;
    log_info("ready");
    notify_send("READY=1");
    int code = serve(pairs.get(), lcm, !pairs_on_bus(given), seer.counts());
    report(seer.counts());
    if (in_vain(given, seer.counts()))
        code = 1;
    if (given.stats && write_stats(given.stats, seer.counts()))
        code = 1;
    return code;
}

static int print_from_opencv(const arguments &given, const vision_config &config)
{
    stereo_rig rig = config_eyes(config).rig;
    char error[512];

    if (rig_from_opencv(given.opencv, given.n_opencv, &rig, error, sizeof error)) {
        log_error("%s", error);
        return 1;
    }
    rig_write(rig, "from OpenCV's stereo calibration", stdout);
    return 0;
}

static int print_tag(const arguments &given, const vision_config &config)
{
    if (config.tag_dictionary == 0) {
        log_error("--print-tag: no tag is configured; set marker.dictionary and marker.id");
        return 1;
    }
    if (image_file_write(given.print_tag,
                         tag_picture({config.tag_dictionary, config.tag_id}, tag_side)))
        return 0;
    log_error("%s cannot be written", given.print_tag);
    return 1;
}

static int run_on_bus(const arguments &given, const vision_config &config)
{
    struct bus_claim *claim = nullptr;
    char error[512];
    int code = 1;
    lcm_t *lcm = bus_open(given.url, error, sizeof error);

    if (!lcm) {
        log_error("%s", error);
        return 1;
    }
    const int taken = bus_claim_role(lcm, REACH_HELLO_T_VISION, claim_wait_ms, &claim);
    if (taken > 0)
        log_error("another vision is on this bus; end it, or name another bus with --url");
    else if (taken < 0)
        log_error("LCM failed while asking for other vision processes");
    else
        code = see(given, config, lcm);
    lcm_destroy(lcm);
    bus_claim_free(claim);
    return code;
}

int main(int argc, char **argv)
{
    arguments given;
    vision_config config;
    char error[512];
    const int code = arguments_parse(argc, argv, &given);

    if (code >= 0)
        return code;
    log_open("reach-vision", LOG_LEVEL_INFO);
    if (config_load(&config, given.config, given.overrides, given.n_overrides, error,
                    sizeof error)) {
        log_error("%s", error);
        return 1;
    }
    /* What OpenCV's back ends have to say of a missing file is said by one line of ours. */
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    cv::setNumThreads(1); /* one core is the budget, and one order of arithmetic */
    if (given.n_opencv > 0)
        return print_from_opencv(given, config);
    if (given.print_tag)
        return print_tag(given, config);
    if (given.bench)
        return bench_run(given.bench, config_eyes(config), given.draw) ? 1 : 0;
    if (given.show && !show_possible()) {
        log_error("--show: no display (DISPLAY and WAYLAND_DISPLAY are not set)");
        return 1;
    }
    catch_signals();
    if (learning_asked(given))
        return learning_run(given, config, &stop_asked);
    if (config_eyes(config).rig.ball_radius <= 0)
        log_warning(
            config.tag_dictionary > 0
                ? "marker.size is not set: a tag of the same number but of another size can "
                  "be taken for it; set the side of its black square in metres"
                : "ball.radius is not set: a thing of the ball's colour but of another size "
                  "can be taken for it; set the true radius in metres");
    receive_buffer_check(static_cast<size_t>(config.width) * static_cast<size_t>(config.height) *
                         6);
    return run_on_bus(given, config);
}
