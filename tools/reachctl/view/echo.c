#include "tools/reachctl/view/echo.h"

#include "common/bus/message_types.h"
#include "common/bus/open.h"
#include "common/program/printable.h"

#include <lcm/lcm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { QUEUE = 10000, TEXT = 4 * 8192 + 1 };

/* As a string of JSON: printable ASCII alone, and no quotes or backslashes of its own. */
static void put_text(const char *text, size_t most, FILE *out)
{
    static char safe[TEXT];

    fputc('"', out);
    for (const char *c = printable(text, most, safe, sizeof safe); *c; c++) {
        if (*c == '"' || *c == '\\')
            fputc('\\', out);
        fputc(*c, out);
    }
    fputc('"', out);
}

static void put_real(double value, int digits, FILE *out)
{
    if (isfinite(value))
        fprintf(out, "%.*g", digits, value);
    else
        fputs(isnan(value) ? "\"nan\"" : value > 0 ? "\"inf\"" : "\"-inf\"", out);
}

/* The element of an array, or the value itself. */
static void put_element(const lcm_field_t *field, const void *data, int i, FILE *out)
{
    switch (field->type) {
    case LCM_FIELD_INT8_T:
        fprintf(out, "%d", ((const int8_t *)data)[i]);
        break;
    case LCM_FIELD_INT16_T:
        fprintf(out, "%d", ((const int16_t *)data)[i]);
        break;
    case LCM_FIELD_INT32_T:
        fprintf(out, "%d", ((const int32_t *)data)[i]);
        break;
    case LCM_FIELD_INT64_T:
        fprintf(out, "%lld", (long long)((const int64_t *)data)[i]);
        break;
    case LCM_FIELD_FLOAT:
        put_real((double)((const float *)data)[i], 9, out);
        break;
    case LCM_FIELD_DOUBLE:
        put_real(((const double *)data)[i], 17, out);
        break;
    case LCM_FIELD_STRING:
        put_text(((char *const *)data)[i], SIZE_MAX, out);
        break;
    default:
        fputs("null", out);
    }
}

/* All dimensions from `dim` on; `at` counts the elements that were written. */
static void put_array(const lcm_field_t *field, const void *data, int dim, int *at, FILE *out)
{
    if (dim == field->num_dim) {
        put_element(field, data, (*at)++, out);
        return;
    }
    fputc('[', out);
    for (int i = 0; i < field->dim_size[dim]; i++) {
        fputs(i ? ", " : "", out);
        put_array(field, data, dim + 1, at, out);
    }
    fputc(']', out);
}

static void put_field(const lcm_field_t *field, FILE *out)
{
    bool variable = field->num_dim > 0 && field->dim_is_variable[0];
    const void *data = variable ? *(void *const *)field->data : field->data;
    int at = 0;

    fprintf(out, ", \"%s\": ", field->name);
    if (field->type == LCM_FIELD_INT8_T && field->num_dim == 1) /* in ours always text */
        put_text(data, (size_t)field->dim_size[0], out);
    else
        put_array(field, data, 0, &at, out);
}

/* Images and samples for a search are left out: nobody reads them as text, and memory for them
 * would be as large as the message says. */
static bool is_readable(const struct message_type *type)
{
    return type && strcmp(type->channel, "STEREO_IMAGES") != 0 &&
           strcmp(type->channel, "REACH_BODY_REQUEST") != 0;
}

static bool put_fields(const struct message_type *type, const void *data, size_t size, FILE *out)
{
    const lcm_type_info_t *info = type->info();
    void *message = calloc(1, (size_t)info->struct_size());
    bool decoded = message && info->decode(data, 0, (int)size, message) == (int)size;
    lcm_field_t field = {0};

    for (int i = 0; decoded && i < info->num_fields(); i++)
        if (info->get_field(message, i, &field) == 0)
            put_field(&field, out);
    if (decoded)
        info->decode_cleanup(message);
    free(message);
    return decoded;
}

void echo_message(const char *channel, const void *data, size_t size, FILE *out)
{
    const struct message_type *type = message_type_of(data, size);

    fputs("{\"channel\": ", out);
    put_text(channel, SIZE_MAX, out);
    fprintf(out, ", \"type\": \"%s\"", type ? type->name : "not ours");
    if (!is_readable(type) || !put_fields(type, data, size, out))
        fprintf(out, ", \"bytes\": %zu", size);
    fputs("}\n", out);
    fflush(out);
}

struct heard {
    int64_t messages;
    bool once;
};

static void on_message(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct heard *heard = user;

    if (heard->once && heard->messages > 0)
        return;
    heard->messages++;
    echo_message(channel, message->data, message->data_size, stdout);
}

static int listen(lcm_t *lcm, struct heard *heard, double timeout)
{
    int64_t end = bus_monotonic_us() + (int64_t)(timeout * 1e6);

    while (!ferror(stdout)) {
        int64_t left = end - bus_monotonic_us();
        if (heard->once && (heard->messages > 0 || left <= 0))
            break;
        if (lcm_handle_timeout(lcm, heard->once ? (int)(left / 1000) + 1 : 1000) < 0)
            return -1;
    }
    return 0;
}

int echo_run(const char *url, const char *pattern, bool once, double timeout, char *error,
             size_t error_size)
{
    struct heard heard = {.once = once};
    lcm_t *lcm = bus_open(url, error, error_size);
    char whole[512];
    lcm_subscription_t *subscription;
    int result = -1;

    if (!lcm)
        return -1;
    snprintf(whole, sizeof whole, "(%s)", pattern); /* LCM anchors only the ends of "A|B" */
    subscription = lcm_subscribe(lcm, whole, on_message, &heard);
    if (!subscription)
        snprintf(error, error_size, "'%s' is no pattern of channels", pattern);
    else {
        lcm_subscription_set_queue_capacity(subscription, QUEUE);
        result = listen(lcm, &heard, timeout);
        if (once && heard.messages == 0) {
            snprintf(error, error_size, "nothing came on '%s' in %g s", pattern, timeout);
            result = -1;
        }
    }
    lcm_destroy(lcm);
    return result;
}
