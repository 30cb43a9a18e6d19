#include "tools/reachctl/motors/judge.h"

#include <math.h>

static const double least_share = 0.3; /* of the commanded motion, for a joint that moves */
static const double most_off = 0.05;   /* of a scale that is well */

/* From its first row up to the one with which the next begins. */
struct move {
    size_t from, to;
    double commanded, measured; /* rad */
};

static bool moves(const struct motor_row *row)
{
    return row->commanded != 0;
}

/* The commanded motion between two rows, rad. */
static double commanded_between(const struct motor_row *rows, size_t from, size_t to)
{
    double sum = 0;

    for (size_t i = from; i < to; i++)
        sum += rows[i].commanded * (rows[i + 1].commanded_at - rows[i].commanded_at);
    return sum;
}

/* The next move from row `at` on. Returns false when there is none with a rest behind it. */
static bool next_move(const struct motor_row *rows, size_t n, size_t at, struct move *move)
{
    while (at < n && !moves(&rows[at]))
        at++;
    move->from = at;
    while (at < n && moves(&rows[at]))
        at++;
    if (at >= n)
        return false;
    while (at + 1 < n && !moves(&rows[at]))
        at++;
    move->to = at;
    move->commanded = commanded_between(rows, move->from, move->to);
    move->measured = rows[move->to].measured - rows[move->from].measured;
    return true;
}

/* The area between the two curves of a move, over its height. */
static double delay_of(const struct motor_row *rows, const struct move *move, double scale)
{
    double area = 0;
    double commanded = 0;

    for (size_t i = move->from; i < move->to; i++) {
        const struct motor_row *row = &rows[i];
        double step = row[1].commanded_at - row->commanded_at;
        double moved = row->commanded * step;
        area += scale * (commanded + 0.5 * moved) * step;
        commanded += moved;
        area -= (0.5 * (row->measured + row[1].measured) - rows[move->from].measured) *
                (row[1].measured_at - row->measured_at);
    }
    /* At its end, at rest, the commanded curve was followed for longer: a measurement is of an
     * instant before the command. */
    return area / (scale * move->commanded) -
           (rows[move->to].commanded_at - rows[move->to].measured_at);
}

struct sums {
    int moves, onward, back;
    double commanded, along; /* of all moves: path, and measured motion along it */
    double scale, delay, lost;
};

static struct motor_report report_of(const struct sums *sums)
{
    struct motor_report report = {MOTOR_WELL, NAN, NAN, NAN};
    double share = sums->along / sums->commanded;

    if (sums->moves == 0)
        report.verdict = MOTOR_UNSEEN;
    else if (fabs(share) < least_share)
        report.verdict = MOTOR_STILL;
    else if (share < 0)
        report.verdict = MOTOR_REVERSED;
    if (sums->onward == 0 || report.verdict == MOTOR_UNSEEN || report.verdict == MOTOR_STILL)
        return report;
    report.scale = sums->scale / sums->onward;
    report.delay = sums->delay / sums->onward;
    if (sums->back > 0)
        report.backlash = fmax(0, sums->lost / sums->back);
    if (report.verdict == MOTOR_WELL && fabs(report.scale - 1) > most_off)
        report.verdict = MOTOR_SCALE;
    return report;
}

/* Moves that turn back are held against the scale that the others have shown. */
static void take_back(const struct move *move, double scale, struct sums *sums)
{
    sums->back++;
    sums->lost += fabs(scale * move->commanded) - fabs(move->measured);
}

static void take_onward(const struct motor_row *rows, const struct move *move, struct sums *sums)
{
    double scale = move->measured / move->commanded;

    sums->onward++;
    sums->scale += scale;
    sums->delay += delay_of(rows, move, scale);
}

struct motor_report motor_judge(const struct motor_row *rows, size_t n)
{
    struct sums sums = {0};
    double before = 0;
    struct move move;

    for (size_t at = 0; next_move(rows, n, at, &move); at = move.to) {
        sums.moves++;
        sums.commanded += fabs(move.commanded);
        sums.along += copysign(move.measured, move.measured * move.commanded);
        if (before * move.commanded > 0)
            take_onward(rows, &move, &sums);
        before = move.commanded;
    }
    before = 0;
    for (size_t at = 0; sums.onward > 0 && next_move(rows, n, at, &move); at = move.to) {
        if (before * move.commanded < 0)
            take_back(&move, sums.scale / sums.onward, &sums);
        before = move.commanded;
    }
    return report_of(&sums);
}

const char *motor_verdict_word(enum motor_verdict verdict)
{
    static const char *const words[] = {"well", "not moved", "DOES NOT MOVE", "REVERSED",
                                        "WRONG SCALE"};

    return words[verdict];
}
