#include "vision/arguments.h"

#include <cstddef>

#include "common/bus/open.h"
#include "vision/config.h"

static const argument_row rows[] = {
    ARGUMENT_TEXT("config", 'c', "FILE", arguments, config,
                  "YAML configuration, such as etc/vision-kobian.yaml"),
    ARGUMENT_SET(arguments, overrides, n_overrides),
    ARGUMENT_URL(arguments, url),
    ARGUMENT_ON("show", 0, arguments, show, "a window with both pictures and what was found"),
    ARGUMENT_PAIR("cameras", "LEFT RIGHT", arguments, cameras, "two V4L2 devices"),
    ARGUMENT_PAIR("videos", "LEFT RIGHT", arguments, videos, "two video files; ends with them"),
    ARGUMENT_TEXT("stats", 0, "FILE", arguments, stats, "counts and times at the end, JSON"),
    ARGUMENT_TEXT(
        "bench", 0, "PAIR", arguments, bench,
        "no bus: find the ball in one stored pair (pictures side by side) and measure the "
        "time it takes"),
    ARGUMENT_TEXT("draw", 0, "FILE", arguments, draw,
                  "with --bench: write the pair with what was found; with --calibrate: write the "
                  "sightings that were used"),
    ARGUMENT_TEXT("calibrate", 0, "FILE", arguments, calibrate,
                  "learn how the eyes stand: move the ball about for 30 s; writes the YAML file"),
    ARGUMENT_LIST("from-opencv", 0, "FILE", arguments, opencv, n_opencv, 2,
                  "no bus: print the YAML of a rig that OpenCV's stereo calibration measured "
                  "(M1, D1, M2, D2, R, T; may be given twice, as they often are in two files)"),
    ARGUMENT_END,
};

static const command_line line = {
    "reach-vision",
    "reach-vision [--config FILE] [--set NAME=VALUE]... [--url URL] [--stats FILE] [--show]\n"
    "                    [--cameras LEFT RIGHT | --videos LEFT RIGHT | --bench PAIR | "
    "--from-opencv FILE]\n"
    "                    [--calibrate FILE] [--draw FILE]",
    "Finds the ball in pairs of pictures and says where it is on channel MARKER.\n"
    "Pairs come from channel STEREO_IMAGES unless cameras or videos are named.",
    rows,
    "0 ended as asked, 1 failure",
    config_print,
    nullptr,
    nullptr};

int arguments_parse(int argc, char **argv, arguments *given)
{
    const int status = command_line_parse(&line, argc, argv, given);

    if (status >= 0)
        return status;
    if ((given->cameras[0] != nullptr) + (given->videos[0] != nullptr) + (given->bench != nullptr) >
        1)
        return command_line_wrong(&line, "--cameras, --videos and --bench exclude each other");
    if (given->draw && !given->bench && !given->calibrate)
        return command_line_wrong(&line, "--draw goes with --bench or --calibrate");
    if (given->calibrate && (given->bench || given->n_opencv > 0))
        return command_line_wrong(&line,
                                  "--calibrate wants pairs: from the bus, --cameras, --videos");
    return -1;
}
