#include "vision/arguments.h"

#include <cstddef>
#include <cstdio>

#include "common/bus/open.h"
#include "vision/config.h"

static int take_at(void *settings, const char *text, char *error, size_t error_size)
{
    arguments *given = static_cast<arguments *>(settings);
    int end = 0;

    given->has_at =
        sscanf(text, "%lf,%lf%n", &given->at.column, &given->at.row, &end) == 2 && !text[end];
    if (given->has_at)
        return 0;
    snprintf(error, error_size, "\"%s\" is no COLUMN,ROW, such as 320,240", text);
    return -1;
}

static const argument_row rows[] = {
    ARGUMENT_TEXT("config", 'c', "FILE", arguments, config,
                  "YAML configuration, such as etc/vision-kobian.yaml"),
    ARGUMENT_SET(arguments, overrides, n_overrides),
    ARGUMENT_URL(arguments, url),
    ARGUMENT_ON("show", 0, arguments, show, "a window with both pictures and what was found"),
    ARGUMENT_PAIR("cameras", "LEFT RIGHT", arguments, cameras, "two V4L2 devices"),
    ARGUMENT_PAIR("videos", "LEFT RIGHT", arguments, videos, "two video files; ends with them"),
    ARGUMENT_TEXT("log", 0, "FILE", arguments, log,
                  "the pairs in a log of lcm-logger's, as fast as they are seen; ends with it"),
    ARGUMENT_TEXT("stats", 0, "FILE", arguments, stats, "counts and times at the end, JSON"),
    ARGUMENT_TEXT(
        "bench", 0, "PAIR", arguments, bench,
        "no bus: find the ball in one stored pair (pictures side by side) and measure the "
        "time it takes"),
    ARGUMENT_TEXT("draw", 0, "FILE", arguments, draw,
                  "with --bench: write the pair with what was found; with --calibrate: write the "
                  "sightings that were used; with --learn-colour: write what has the colour"),
    ARGUMENT_TEXT("calibrate", 0, "FILE", arguments, calibrate,
                  "learn how the eyes stand: move the ball about for 30 s; writes the YAML file"),
    ARGUMENT_TEXT(
        "learn-colour", 0, "SOURCE", arguments, learn_colour,
        "print the YAML of the ball's colour, learned in 5 s; SOURCE: a picture, a video, "
        "a camera such as /dev/video0, a log, or \"bus\"; finds the round thing that "
        "moves, unless --at or a click (--show) says where the ball is"),
    ARGUMENT_CALL("at", "COLUMN,ROW", take_at,
                  "with --learn-colour: a pixel of the ball in the first picture"),
    ARGUMENT_TEXT("print-tag", 0, "FILE", arguments, print_tag,
                  "no bus: write the configured tag as a picture to print (marker.dictionary, "
                  "marker.id)"),
    ARGUMENT_LIST("from-opencv", 0, "FILE", arguments, opencv, n_opencv, 2,
                  "no bus: print the YAML of a rig that OpenCV's stereo calibration measured "
                  "(M1, D1, M2, D2, R, T; may be given twice, as they often are in two files)"),
    ARGUMENT_END,
};

static const command_line line = {
    "reach-vision",
    "reach-vision [--config FILE] [--set NAME=VALUE]... [--url URL] [--stats FILE] [--show]\n"
    "                    [--cameras LEFT RIGHT | --videos LEFT RIGHT | --log FILE | --bench PAIR]\n"
    "                    [--calibrate FILE | --learn-colour SOURCE [--at COLUMN,ROW] | "
    "--from-opencv FILE |\n"
    "                     --print-tag FILE] [--draw FILE]",
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
    if ((given->cameras[0] != nullptr) + (given->videos[0] != nullptr) + (given->log != nullptr) +
            (given->bench != nullptr) + (given->learn_colour != nullptr) >
        1)
        return command_line_wrong(
            &line, "--cameras, --videos, --log, --bench and --learn-colour exclude each other");
    if (given->draw && !given->bench && !given->calibrate && !given->learn_colour)
        return command_line_wrong(&line, "--draw goes with --bench, --calibrate or --learn-colour");
    if (given->calibrate && (given->bench || given->learn_colour || given->n_opencv > 0))
        return command_line_wrong(
            &line, "--calibrate wants pairs: from the bus, --cameras, --videos or --log");
    if (given->has_at && !given->learn_colour)
        return command_line_wrong(&line, "--at goes with --learn-colour");
    return -1;
}
