/* What the driver wants of a robot: five calls. Write them for yours in a file of its own, in the
 * place of pretend_robot.c; robot_driver.c need not change. */
#ifndef ROBOT_H
#define ROBOT_H

enum { ROBOT_JOINTS = 7 }; /* arm, then head, in the order of reachd's configuration */

/* rad and rad/s; what the motors are never asked for. */
extern const double robot_lowest[ROBOT_JOINTS];
extern const double robot_highest[ROBOT_JOINTS];
extern const double robot_fastest[ROBOT_JOINTS];

/* Switches the motors on, at rest. Returns 0, or -1 having said why on stderr. */
int robot_open(void);

/* Stops and switches off. */
void robot_close(void);

/* Reads the encoders, rad and rad/s. Returns 0 or -1. */
int robot_read(double *position, double *velocity);

/* Sets the motors' velocities, rad/s; they keep them until the next call. Returns 0 or -1. */
int robot_move(const double *velocity);

/* Where the end-effector is in the ground frame, m, as a tracking system measures it. For a robot
 * with eyes: return -1, and let vision see the marker.
 *   returns 0, or -1 when there is no new measurement */
int robot_end_effector(double position[3]);

#endif
