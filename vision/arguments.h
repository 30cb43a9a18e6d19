/* The command line of vision. */
#ifndef VISION_ARGUMENTS_H
#define VISION_ARGUMENTS_H

#include "common/options/command_line.h"
#include "vision/ball/camera.h"

/* Texts point into argv; nullptr where nothing was given. */
struct arguments {
    const char *config = nullptr;
    const char *url = nullptr;
    const char *stats = nullptr;
    const char *bench = nullptr;
    const char *draw = nullptr;
    const char *calibrate = nullptr;
    const char *learn_colour = nullptr;
    const char *print_tag = nullptr;
    pixel_point at = {0, 0};
    bool has_at = false;
    const char *opencv[2] = {nullptr, nullptr};
    int n_opencv = 0;
    const char *cameras[2] = {nullptr, nullptr}; /* left and right */
    const char *videos[2] = {nullptr, nullptr};
    const char *log = nullptr;
    bool show = false;
    const char *overrides[OPTION_SOURCES_OVERRIDES] = {};
    int n_overrides = 0;
};

/* Reads the command line. Help and version are printed here, as are complaints.
 *   returns -1 to go on, or the status to exit with. */
int arguments_parse(int argc, char **argv, arguments *given);

#endif
