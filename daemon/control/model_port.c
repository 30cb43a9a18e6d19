#include "daemon/control/model_port.h"

#include <stddef.h>

static bool take_note_of_nothing(void *context, const double *z, const double *x)
{
    (void)context, (void)z, (void)x;
    return true;
}

static void take_notice_of_nothing(void *context, const struct learner *learner)
{
    (void)context, (void)learner;
}

static bool is_never(const void *context)
{
    (void)context;
    return false;
}

static bool cannot_begin(void *context, int number)
{
    (void)context, (void)number;
    return false;
}

static enum model_result has_no_news(void *context, struct learner **learner)
{
    (void)context, (void)learner;
    return MODEL_NOTHING;
}

static void do_nothing(void *context)
{
    (void)context;
}

static struct model_moment empty_moment(const void *context)
{
    (void)context;
    return (struct model_moment){0};
}

static struct model_report empty_report(const void *context)
{
    (void)context;
    return (struct model_report){0};
}

static const struct model_port_ops none = {
    .note = take_note_of_nothing,
    .learned = take_notice_of_nothing,
    .full = is_never,
    .works = is_never,
    .begin_save = cannot_begin,
    .begin_load = cannot_begin,
    .begin_forgetting = do_nothing,
    .tell_body = do_nothing,
    .poll = has_no_news,
    .moment = empty_moment,
    .report = empty_report,
};

struct model_port model_port_none(void)
{
    return (struct model_port){&none, NULL};
}
