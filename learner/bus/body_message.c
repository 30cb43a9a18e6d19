#include "learner/bus/body_message.h"

#include "common/base/checksum.h"

#include <math.h>
#include <string.h>

_Static_assert(sizeof((reach_body_t *)0)->numbers == BODY_NUMBERS * sizeof(double),
               "body_t has every number of a body");

static int32_t checksum_of(const reach_body_t *message)
{
    return (int32_t)checksum_crc32(message->numbers, sizeof message->numbers);
}

void body_message_put(const struct body *body, reach_body_t *message)
{
    if (body)
        body_to_numbers(body, message->numbers);
    else
        memset(message->numbers, 0, sizeof message->numbers);
    message->checksum = checksum_of(message);
}

bool body_message_take(const reach_body_t *message, struct body *body)
{
    char ignored[160];

    if (message->checksum != checksum_of(message))
        return false;
    for (int i = 0; i < BODY_NUMBERS; i++)
        if (!isfinite(message->numbers[i]))
            return false;
    body_from_numbers(message->numbers, body);
    return body_check(body, ignored, sizeof ignored) == 0;
}
