/* Stands for a real robot: ideal motors, and the arm of an iCub-like robot, roughly. */
#include "robot.h"

#include <math.h>
#include <string.h>
#include <time.h>

#define RAD(degrees) ((degrees)*3.14159265358979323846 / 180)

/* Shoulder pitch, yaw, roll, elbow, waist yaw, roll, pitch, as in etc/icub.yaml. */
const double robot_lowest[] = {RAD(-80), RAD(0), RAD(0), RAD(20), RAD(-30), RAD(-30), RAD(-10)};
const double robot_highest[] = {RAD(0), RAD(80), RAD(80), RAD(80), RAD(30), RAD(30), RAD(30)};
const double robot_fastest[] = {1, 1, 1, 1, 1, 1, 1};

static const double shoulder[] = {0.0, 0.11, 0.15}; /* above the waist, m */
static const double upper_arm = 0.15, forearm = 0.14;

static struct {
    double position[ROBOT_JOINTS], velocity[ROBOT_JOINTS];
    double read; /* when the encoders were read last, s */
} motors;

static double seconds(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

int robot_open(void)
{
    for (int i = 0; i < ROBOT_JOINTS; i++)
        motors.position[i] = (robot_lowest[i] + robot_highest[i]) / 2;
    motors.read = seconds();
    return 0;
}

void robot_close(void)
{
    memset(motors.velocity, 0, sizeof motors.velocity);
}

int robot_read(double *position, double *velocity)
{
    double now = seconds();

    for (int i = 0; i < ROBOT_JOINTS; i++)
        motors.position[i] += motors.velocity[i] * (now - motors.read);
    motors.read = now;
    memcpy(position, motors.position, sizeof motors.position);
    memcpy(velocity, motors.velocity, sizeof motors.velocity);
    return 0;
}

int robot_move(const double *velocity)
{
    memcpy(motors.velocity, velocity, sizeof motors.velocity);
    return 0;
}

/* Turns p about one of the axes x, y, z (0, 1, 2). */
static void turn(int axis, double angle, double p[3])
{
    int a = (axis + 1) % 3, b = (axis + 2) % 3;
    double c = cos(angle), s = sin(angle), pa = p[a];

    p[a] = c * pa - s * p[b];
    p[b] = s * pa + c * p[b];
}

/* From the hand back to the ground. */
int robot_end_effector(double position[3])
{
    const double *q = motors.position;
    double p[3] = {0, 0, -forearm};

    turn(1, -q[3], p); /* elbow */
    p[2] -= upper_arm;
    turn(2, q[2], p);
    turn(0, q[1], p);
    turn(1, q[0], p);
    for (int i = 0; i < 3; i++)
        p[i] += shoulder[i];
    turn(1, q[6], p); /* waist */
    turn(0, q[5], p);
    turn(2, q[4], p);
    memcpy(position, p, sizeof p);
    return 0;
}
