/* Learns a relation with two values, x = sin z and x = sin z + 1, and asks for both:
 *   cc two_valued.c $(pkg-config --cflags --libs reach-learner) -o two_valued */
#include <reach/learner.h>

#include <math.h>
#include <stdio.h>

int main(void)
{
    struct learner_config config = learner_config_default(1, 1);
    struct learner_prediction prediction;
    struct learner *learner;
    struct arena *arena;
    char error[256];

    config.psi0[0] = 0.05 * 0.05; /* variance of the output */
    config.sigma0[0] = 0.3 * 0.3; /* variance of the inputs of one expert */
    arena = arena_create(learner_memory(&config));
    learner = arena ? learner_create(&config, arena, error, sizeof error) : NULL;
    if (!learner)
        return 1;
    for (int pass = 0; pass < 2; pass++) /* first without the tool, then with it */
        for (int i = 0; i < 3000; i++) {
            double z = fmod(i * 0.618034, 1.0) * 6;
            double x = sin(z) + pass;
            learner_update(learner, &z, &x);
        }
    for (double z = 0.5; z < 6; z += 1) {
        int n = learner_predict(learner, &z, &prediction);
        printf("%.1f:", z);
        for (int k = 0; k < n; k++)
            printf(" %.2f", prediction.solution[k].value[0]);
        printf("\n");
    }
    arena_destroy(arena);
    return 0;
}
