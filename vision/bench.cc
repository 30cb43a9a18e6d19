#include "vision/bench.h"

#include <cstdio>

#include "common/program/log.h"
#include "vision/answers/show.h"
#include "vision/answers/statistics.h"
#include "vision/pictures/image_file.h"

static const int rounds = 500;
static const int64_t period = 33000; /* us between the stamps */

static image_view half(const cv::Mat &both, bool left)
{
    const int width = both.cols / 2;

    return {both.data + (left ? 0 : static_cast<size_t>(width) * 3), width, both.rows, both.step,
            PIXEL_BGR};
}

static bool load(const char *path, const eyes_config &config, cv::Mat *both)
{
    const camera &eye = config.rig.left;

    *both = image_file_read(path);
    if (both->cols == 2 * eye.width && both->rows == eye.height)
        return true;
    log_error("%s is no picture of two eyes side by side, %d x %d pixels each", path, eye.width,
              eye.height);
    return false;
}

/* Times of looking with or without windows, one line. */
static void measure(const char *name, eyes_config config, int recheck, const cv::Mat &both)
{
    eyes who;
    time_histogram times;

    config.recheck = recheck;
    eyes_init(&who, config);
    for (int i = 0; i <= rounds; i++) {
        const double start = statistics_thread_us();
        eyes_look(&who, (i + 1) * period, half(both, true), half(both, false));
        if (i > 0) /* the first has no window yet */
            time_histogram_add(&times, statistics_thread_us() - start);
    }
    printf("%-7s us a pair: p50 %.0f, p99 %.0f, max %.0f\n", name,
           time_histogram_quantile(times, 0.5), time_histogram_quantile(times, 0.99),
           times.largest);
}

static void print_refused(const char *eye, const eye_findings &seen)
{
    for (int i = 0; i < seen.n_refused; i++) {
        const refused_blob &one = seen.refused[i];
        printf("%s eye, column %.0f row %.0f, radius %.0f px: %s\n", eye, one.pixel.column,
               one.pixel.row, one.radius, blob_fault_text(one.fault));
    }
}

int bench_run(const char *path, const eyes_config &config, const char *drawing)
{
    cv::Mat both;
    eyes who;

    if (!load(path, config, &both))
        return -1;
    eyes_init(&who, config);
    const stereo_marker marker = eyes_look(&who, period, half(both, true), half(both, false));
    const bool seen = marker.reason == STEREO_SEEN;
    printf("seen %d reason %d u_right %.3f v_right %.3f disparity %.3f radius %.3f\n", seen,
           marker.reason, marker.u_right, marker.v_right, marker.disparity, marker.radius);
    if (seen)
        for (const blob *found : {&who.left_blob, &who.right_blob})
            printf("%-5s coverage %.2f fill %.2f rms %.2f px score %.2f\n",
                   found == &who.left_blob ? "left" : "right", found->coverage, found->fill,
                   found->cone.rms, found->score);
    print_refused("left", who.in_left);
    print_refused("right", who.in_right);
    measure("whole", config, 0, both);
    if (seen)
        measure("window", config, rounds + 1, both);
    if (!drawing ||
        image_file_write(drawing, show_draw(half(both, true), half(both, false), who, marker.reason,
                                            stereo_reason_text(marker.reason))))
        return 0;
    log_error("%s cannot be written", drawing);
    return -1;
}
