/* Births by evidence (docs/learner.md): what an expert may be wrong by, and experts to be. */
#ifndef REACH_LEARNER_IMLE_EVIDENCE_H
#define REACH_LEARNER_IMLE_EVIDENCE_H

#include "learner/imle/imle.h"

/* imle/errors.c: variances are in units of Psi_bar ------------------------------------------- */

/* The mean square of what an expert is wrong by where it knows. */
double imle_error(const struct imle_strengths *s);

/* What an expert may be wrong by where it knows: its Psi. */
double imle_tolerance(const struct imle_strengths *s);

/* What expert or candidate j may be wrong by at the query because it has not seen enough: some
 * Psi_bar near its samples, the range of the outputs far from them. */
double imle_doubt(struct imle *m, int j);

/* Takes note of where outputs are. */
void imle_note_output(struct imle *m, const double *x);

/* Takes note of what expert or candidate j is wrong by, before it learns the sample. */
void imle_note_error(struct imle *m, int j);

/* The variances of a new sample about the answer of expert j, whose uncertainty there is gamma; in
 * units of the outputs, squared. */
void imle_stated_variances(const struct imle *m, int j, double gamma, double *variance);

/* imle/evidence.c -------------------------------------------------------------------------- */

/* imle_learn() where births are by evidence. */
enum learner_update_result imle_learn_by_evidence(struct imle *m, const double *z, const double *x);

/* Whether expert or candidate j may be right about the sample, for all that it knows. */
bool imle_explains(struct imle *m, int j);

/* -2 log of the density of the sample's output, as expert or candidate j sees it. */
double imle_cost(struct imle *m, int j);

/* imle/candidates.c ------------------------------------------------------------------------ */

/* What the candidates make of a sample that no expert explains: LEARNER_OUTLIER; LEARNER_BORN when
 * one of them has become an expert by it, LEARNER_FULL when there was no place for it. */
enum learner_update_result imle_nurse(struct imle *m, const double *z, const double *x);

/* What candidates have becomes older, but for the one that had the newest sample. */
void imle_candidates_wait(struct imle *m);

/* Takes away one expert that a short burst made and that nothing has needed since, if there is any.
 */
void imle_remove_needless(struct imle *m);

/* imle/needs.c ----------------------------------------------------------------------------- */

/* Expert or candidate j has learned this sample, and may remember it. */
void imle_remember(struct imle *m, int j, const double *z, const double *x);

/* Asks again about one remembered sample in a while, and takes the expert away that nothing needs
 * any more. What m->query knew of the newest sample is gone. */
void imle_remove_unneeded(struct imle *m);

#endif
