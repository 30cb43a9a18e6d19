/* Between image and task space: the one place that knows which way the image moves.
 *
 * Image displacement: [u_R to the right, v_R down, u_L - u_R], px.
 * Task displacement: [head yaw to the left, head pitch down, u_L - u_R], rad, rad, px.
 * A marker to the right of the centre (u > 0) is fixated by turning right (yaw falls); one below
 * it (v > 0) by looking down (pitch rises). The paper's "positive gains" K_0, K_1 of equation 11
 * hide these signs; `pixels_per_radian` is the linear relation that it assumes (section 5.2.1). */
#ifndef REACH_VISUAL_H
#define REACH_VISUAL_H

#define VISUAL_DIMENSIONS 3

/* The head turn (and disparity) that an image displacement amounts to. */
static inline void visual_to_task(double pixels_per_radian, const double image[VISUAL_DIMENSIONS],
                                  double task[VISUAL_DIMENSIONS])
{
    task[0] = -image[0] / pixels_per_radian;
    task[1] = image[1] / pixels_per_radian;
    task[2] = image[2];
}

/* How far the marker's image moves when the marker moves so in task space and the head rests. */
static inline void task_to_visual(double pixels_per_radian, const double task[VISUAL_DIMENSIONS],
                                  double image[VISUAL_DIMENSIONS])
{
    image[0] = -task[0] * pixels_per_radian;
    image[1] = task[1] * pixels_per_radian;
    image[2] = task[2];
}

#endif
