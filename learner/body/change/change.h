/* What has changed of a body while it is in use: the zero of a joint, the place or the direction
 * from which all is seen, or one tool's tip.
 *
 * Each context remembers its tip as it was when it was last well known. What the samples of later
 * differ from that by is linear in what has changed:
 *
 *   white (place - what was remembered) = K c + noise,   c ~ N(0, 1)
 *
 * K has a column for the zero of each joint (white J_i), three for the view, and three for the
 * tip (white R), in units of what each may change by. The sums K'K and K'y are enough to weigh
 * every explanation against every other: one joint, the view, the tips alone. A joint's zero is one
 * number for all tools, a tip three for each; so a last joint, which for one tool is a changed tip,
 * is told apart from it by the second. */
#ifndef REACH_LEARNER_BODY_CHANGE_CHANGE_H
#define REACH_LEARNER_BODY_CHANGE_CHANGE_H

#include "learner/body/tool/design.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CHANGE_VIEW = 3, CHANGE_TIP = 3 };
#define CHANGE_MAX (CHAIN_MAX_JOINTS + CHANGE_VIEW + CHANGE_TIP)

/* Of samples against one remembered tip. */
struct change_sums {
    double weight;  /* samples, old ones faded */
    double squares; /* sum of |y|^2 */
    double *C;      /* K'K, packed lower triangle */
    double *b;      /* K'y */
};

/* Columns for a body of so many joints, and the doubles that sums take. */
int change_columns(int n_joints);
size_t change_sums_numbers(int n_joints);

/* Lays sums over that many numbers; empties them. */
void change_place(struct change_sums *sums, int n_joints, double *numbers);
void change_clear(struct change_sums *sums, int n_joints);

/* What each column changes by when its c is 1: rad (m of a joint that slides); the view's in m, or
 * of eyes tilt, tilt, px; the tip's in the body's unit of length. */
double change_unit(const struct body *body, int column);

/* K (3 x columns, row by row) at this pose for a tip at `place`, seen at x. `white` is
 * body_place()'s. false where the eyes see nothing. */
bool change_rows(const struct body *body, const struct chain_pose *pose, const double *place,
                 const double *x, const double *white, double *rows);

/* Adds a sample of this variance (in units of the noise); `keep` in (0, 1] is what the past still
 * counts. */
void change_add(struct change_sums *sums, int n_joints, const double *rows, const double *y,
                double variance, double keep);

/* All of it counts that much of what it did. */
void change_fade(struct change_sums *sums, int n_joints, double keep);

/* Sums that an explanation is weighed on, and how far the tip behind them may have moved: 0 not
 * at all, or its standard deviation over change_unit(). */
struct change_case {
    const struct change_sums *sums;
    double moved;
};

/* What explains several cases together: joint 0 .. n - 1, the view (n), or nothing but what the
 * tips have moved by (-1). */
struct change_story {
    int cause;
    double gain;           /* log of how much better than that nothing has changed */
    double c[CHANGE_VIEW]; /* of a joint the first alone */
};
void change_explain(const struct change_case *cases, int n_cases, int n_joints, int cause,
                    struct change_story *story);

/* How much of a story a moved tip could not explain as well, and what the story leaves: rms a
 * coordinate, in units of the noise. */
double change_effect(const struct change_case *one, int n_joints, const struct change_story *story);
double change_left(const struct change_case *one, int n_joints, const struct change_story *story);

/* How far a tip has moved, best guess without another cause, over change_unit(); returns the rms
 * effect of it as above. */
double change_of_tip(const struct change_sums *sums, int n_joints, double *moved);

/* The body with that changed, and a sample of before as it would be seen now. */
void change_apply(const struct change_story *story, struct body *body);
void change_sample(const struct change_story *story, const struct body *before, double *z,
                   double *x);

#ifdef __cplusplus
}
#endif
#endif
