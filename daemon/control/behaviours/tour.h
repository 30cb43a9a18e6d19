/* Motions that show a body: each joint turned alone, which draws its circle, then postures in the
 * joints' range of whose place the model is least sure. docs/body.md says why. Plain data; used by
 * the loop thread alone. */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_TOUR_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_TOUR_H

#include "common/base/random.h"
#include "daemon/control/behaviours/behaviour.h"

/* Postures of late that counted; what is near one of them says nothing new. */
enum { TOUR_COUNTED = 16 };

struct tour {
    double low[MAX_JOINTS], high[MAX_JOINTS]; /* where it may go, rad */
    bool begun;
    int joint;               /* turned alone now; the number of arm joints when all were */
    bool back;               /* on its way back */
    double home[MAX_JOINTS]; /* rad */
    double goal[MAX_JOINTS]; /* rad */
    int64_t deadline;        /* us */
    int n_counted, next_counted;
    double counted[TOUR_COUNTED][MAX_JOINTS]; /* rad */
};

/* Whether these motions are of use: experts stand on a body, and nothing has to be fixated. Eyes
 * that fixate lose the marker on a tour; they find a body from few fixations anywhere. */
bool tour_shows_body(const struct config *config);

/* Within these bounds of the arm joints, rad. Where there is a body already, no joint is turned. */
void tour_init(struct tour *tour, const struct senses *senses, const double *low,
               const double *high);

/* About how many ticks it takes to turn each joint alone. */
int tour_ticks(const struct config *config);

/* One tick of turning each joint alone, there and back. Returns false when all were turned. */
bool tour_turn_joints(struct tour *tour, const struct senses *senses, struct wants *wants);

/* One tick on the way to such postures, one after the other. */
void tour_visit_postures(struct tour *tour, struct random_state *random,
                         const struct senses *senses, struct wants *wants);

/* Whether the arm joints q (rad) differ by two degrees in some joint from those that counted of
 * late; if so, they count from now on. */
bool tour_counts(struct tour *tour, const struct config *config, const double *q);

#endif
