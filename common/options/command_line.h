/* Where a program's options come from: files, and single ones on its command line. */
#ifndef REACH_COMMON_OPTIONS_COMMAND_LINE_H
#define REACH_COMMON_OPTIONS_COMMAND_LINE_H

enum { OPTION_SOURCES_PATHS = 8, OPTION_SOURCES_OVERRIDES = 64 };

/* As options_load takes them; the strings are the command line's. */
struct option_sources {
    const char *paths[OPTION_SOURCES_PATHS];
    int n_paths;
    const char *overrides[OPTION_SOURCES_OVERRIDES]; /* NAME=VALUE */
    int n_overrides;
};

/* --config PATH. Returns NULL, or what is wrong. */
const char *option_sources_add_path(struct option_sources *sources, const char *path);

/* --set NAME=VALUE. Returns NULL, or what is wrong. */
const char *option_sources_add_override(struct option_sources *sources, const char *text);

#endif
