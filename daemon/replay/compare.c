#include "daemon/replay/compare.h"

#include <stdio.h>
#include <string.h>

static void take_measured_status(const reach_status_t *recorded, reach_status_t *replayed)
{
    replayed->samples_stored = recorded->samples_stored;
    replayed->storing = recorded->storing;
    replayed->store_waits = recorded->store_waits;
    replayed->refused_state = recorded->refused_state; /* of some no tick was told */
    replayed->refused_joint = recorded->refused_joint;
    replayed->refused_value = recorded->refused_value;
    replayed->refused_min = recorded->refused_min;
    replayed->refused_max = recorded->refused_max;
    replayed->body = recorded->body;
    replayed->body_searches = recorded->body_searches;
    memcpy(replayed->body_not_rigid, recorded->body_not_rigid, sizeof replayed->body_not_rigid);
    replayed->compute_us = recorded->compute_us;
    replayed->compute_mean_us = recorded->compute_mean_us;
    replayed->compute_p999_us = recorded->compute_p999_us;
    replayed->compute_max_us = recorded->compute_max_us;
    replayed->wakeup_us = recorded->wakeup_us;
    replayed->wakeup_mean_us = recorded->wakeup_mean_us;
    replayed->wakeup_p999_us = recorded->wakeup_p999_us;
    replayed->wakeup_max_us = recorded->wakeup_max_us;
    replayed->overruns = recorded->overruns;
    replayed->slips = recorded->slips;
    replayed->page_faults = recorded->page_faults;
}

void replay_take_measured(const struct outgoing *recorded, struct outgoing *replayed)
{
    if (recorded->kind == OUTGOING_STATUS)
        take_measured_status(&recorded->status, &replayed->status);
    if (recorded->kind == OUTGOING_TRACE) {
        replayed->trace.command_checksum = recorded->trace.command_checksum;
        replayed->trace.sample_checksum = recorded->trace.sample_checksum;
        replayed->trace.status_checksum = recorded->trace.status_checksum;
        replayed->trace.checksum = recorded->trace.checksum;
    }
}

static size_t element_size(lcm_field_type_t type)
{
    switch (type) {
    case LCM_FIELD_DOUBLE:
        return sizeof(double);
    case LCM_FIELD_INT64_T:
        return sizeof(int64_t);
    case LCM_FIELD_INT32_T:
        return sizeof(int32_t);
    default:
        return sizeof(int8_t); /* ours have no others */
    }
}

static void value_text(lcm_field_type_t type, const void *at, char *text, size_t text_size)
{
    int32_t word;
    int64_t number;
    double real;

    switch (type) {
    case LCM_FIELD_DOUBLE:
        memcpy(&real, at, sizeof real);
        snprintf(text, text_size, "%.17g", real);
        break;
    case LCM_FIELD_INT64_T:
        memcpy(&number, at, sizeof number);
        snprintf(text, text_size, "%lld", (long long)number);
        break;
    case LCM_FIELD_INT32_T:
        memcpy(&word, at, sizeof word);
        snprintf(text, text_size, "%d", word);
        break;
    default:
        snprintf(text, text_size, "%d", *(const int8_t *)at);
        break;
    }
}

static void describe(const lcm_field_t *recorded, const lcm_field_t *replayed, int element,
                     char *text, size_t text_size)
{
    size_t offset = (size_t)element * element_size(recorded->type);
    char index[32] = "", before[32], now[32];

    if (recorded->num_dim == 1)
        snprintf(index, sizeof index, "[%d]", element);
    else if (recorded->num_dim == 2)
        snprintf(index, sizeof index, "[%d][%d]", element / recorded->dim_size[1],
                 element % recorded->dim_size[1]);
    value_text(recorded->type, (const char *)recorded->data + offset, before, sizeof before);
    value_text(recorded->type, (const char *)replayed->data + offset, now, sizeof now);
    snprintf(text, text_size, "%s%s: recorded %s, replayed %s", recorded->name, index, before, now);
}

/* The first element that differs, -1 = none. */
static int first_difference(const lcm_field_t *recorded, const lcm_field_t *replayed)
{
    size_t size = element_size(recorded->type);
    int elements = 1;

    for (int i = 0; i < recorded->num_dim; i++)
        elements *= recorded->dim_size[i];
    for (int i = 0; i < elements; i++)
        if (memcmp((const char *)recorded->data + (size_t)i * size,
                   (const char *)replayed->data + (size_t)i * size, size) != 0)
            return i;
    return -1;
}

bool replay_same(const struct outgoing *recorded, const struct outgoing *replayed, char *text,
                 size_t text_size)
{
    const lcm_type_info_t *type = outgoing_type(recorded->kind);
    lcm_field_t before, now;

    for (int i = 0; i < type->num_fields(); i++) {
        int element;
        type->get_field(&recorded->command, i, &before);
        type->get_field(&replayed->command, i, &now);
        element = first_difference(&before, &now);
        if (element >= 0) {
            describe(&before, &now, element, text, text_size);
            return false;
        }
    }
    return true;
}
