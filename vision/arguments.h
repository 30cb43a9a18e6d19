/* The command line of vision. */
#ifndef VISION_ARGUMENTS_H
#define VISION_ARGUMENTS_H

#include <vector>

/* Texts point into argv; nullptr where nothing was given. */
struct arguments {
    const char *config = nullptr;
    const char *url = nullptr;
    const char *stats = nullptr;
    const char *bench = nullptr;
    const char *draw = nullptr;
    const char *left = nullptr; /* with `cameras` or `videos` */
    const char *right = nullptr;
    bool cameras = false;
    bool videos = false;
    bool show = false;
    std::vector<const char *> overrides;
};

/* Reads the command line. Help and version are printed here, as are complaints.
 *   returns -1 to go on, or the exit code to end with. */
int arguments_parse(int argc, char **argv, arguments *given);

#endif
