/* What a joint's motors and encoder make of small moves to and fro: sign, scale, delay, backlash.
 */
#ifndef REACHCTL_MOTORS_JUDGE_H
#define REACHCTL_MOTORS_JUDGE_H

#include <stdbool.h>
#include <stddef.h>

/* One joint at one command. Times increase; both clocks count from the same instant. */
struct motor_row {
    double commanded_at; /* s */
    double commanded;    /* velocity from then on, rad/s */
    double measured_at;  /* s */
    double measured;     /* rad */
};

enum motor_verdict {
    MOTOR_WELL,
    MOTOR_UNSEEN,   /* no move was commanded */
    MOTOR_STILL,    /* it does not move: motor, brake, cable, encoder */
    MOTOR_REVERSED, /* the sign of motor or encoder */
    MOTOR_SCALE,    /* it moves more or less than told, by over 5 % */
};

struct motor_report {
    enum motor_verdict verdict;
    double scale;    /* measured / commanded motion; NAN = not known */
    double delay;    /* of the measured motion behind the commanded one, s; NAN = not known */
    double backlash; /* motion lost when the direction changes, rad; NAN = not known */
};

/* `rows` of moves with rests between them; a move that goes on in the direction of the one before
 * shows scale and delay, one that turns back shows backlash. */
struct motor_report motor_judge(const struct motor_row *rows, size_t n);

const char *motor_verdict_word(enum motor_verdict verdict);

#endif
