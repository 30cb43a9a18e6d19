#include "learner/bus/body_answer.h"

#include "learner/bus/body_message.h"

#include <math.h>
#include <string.h>

_Static_assert(sizeof((reach_body_t *)0)->why == sizeof((struct finder_report *)0)->why &&
                   REACH_BODY_T_FOUND == FINDER_FOUND && REACH_BODY_T_NOT_YET == FINDER_NOT_YET &&
                   REACH_BODY_T_NO_CHAIN == FINDER_NO_CHAIN &&
                   REACH_BODY_T_REFUTED == FINDER_REFUTED,
               "body_t has what a finder says");

static bool take_body(const reach_body_t *message, struct body_answer *answer)
{
    answer->checksum = (uint32_t)message->checksum;
    return isfinite(message->error) && isfinite(message->doubt) &&
           body_message_take(message, &answer->body);
}

static bool take_answer(const reach_body_t *message, struct received_body *received)
{
    struct body_answer *answer = &received->answer;

    *received = (struct received_body){.request_utime = message->request_utime};
    answer->seq = message->seq;
    answer->seconds = message->seconds;
    answer->report.samples = message->samples;
    answer->report.starts = message->starts;
    answer->report.error = message->error;
    answer->report.doubt = message->doubt;
    memcpy(answer->report.why, message->why, sizeof answer->report.why);
    answer->report.why[sizeof answer->report.why - 1] = '\0';
    answer->kind = message->outcome == REACH_BODY_T_SEARCHING ? BODY_ANSWER_COMES
                   : message->outcome == REACH_BODY_T_REFUSED ? BODY_ANSWER_REFUSED
                                                              : BODY_ANSWER_REPORT;
    answer->report.outcome = (enum finder_outcome)message->outcome;
    answer->report.any_body =
        message->outcome == REACH_BODY_T_FOUND ||
        ((message->outcome == REACH_BODY_T_NOT_YET || message->outcome == REACH_BODY_T_REFUTED) &&
         message->numbers[0] != 0);
    if (answer->report.any_body)
        return take_body(message, answer);
    return message->outcome > REACH_BODY_T_FOUND && message->outcome <= REACH_BODY_T_REFUTED;
}

bool body_answer_read(const void *data, size_t size, struct received_body *received)
{
    reach_body_t message;

    return reach_body_t_decode(data, 0, (int)size, &message) == (int)size &&
           take_answer(&message, received);
}
