#include "common/options/command_line.h"

#include <stddef.h>

const char *option_sources_add_path(struct option_sources *sources, const char *path)
{
    if (sources->n_paths == OPTION_SOURCES_PATHS)
        return "too many --config";
    sources->paths[sources->n_paths++] = path;
    return NULL;
}

const char *option_sources_add_override(struct option_sources *sources, const char *text)
{
    if (sources->n_overrides == OPTION_SOURCES_OVERRIDES)
        return "too many --set";
    sources->overrides[sources->n_overrides++] = text;
    return NULL;
}
