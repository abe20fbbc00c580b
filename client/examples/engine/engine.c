/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* cc engine.c $(pkg-config --cflags --libs percuss-slowscale percuss) -lm
 * cc -DIN_PROCESS engine.c $(pkg-config --cflags --libs percuss-slowscale percuss-local) -lm */
#include <math.h>
#include <percuss/local.h>     /* pkg-config percuss-local, or percuss::local in CMake */
#include <percuss/slow_link.h> /* pkg-config percuss or percuss-local, or percuss::percuss */
#include <percuss/slowscale.h> /* pkg-config percuss-slowscale, or percuss::slowscale */

#include "my_engine.h" /* my_...: parts that an engine has */

int main(void)
{
    const double step = 1e-3, end = 0.05; /* s */
    struct my_world world = my_world_create(), before;
    struct percuss_slow_contact contacts[MY_CONTACTS];
    unsigned asked = 0;

    /* the service */
    struct percuss_client *client;
#ifdef IN_PROCESS
    enum percuss_result result = percuss_local_open(NULL, &client); /* the installed catalogue */
#else
    enum percuss_result result = percuss_client_create(NULL, &client); /* PERCUSS_DOMAIN, or 0 */
#endif
    if (result != PERCUSS_RESULT_OK) {
        fprintf(stderr, "%s\n", percuss_error_text());
        return 1;
    }
    percuss_client_watch(client, my_wait, &asked); /* optional: says that it takes long */
    struct percuss_slow_link link = percuss_slow_link_default(client);

    /* the engine's bodies */
    static const struct percuss_slow_body bodies[MY_BODIES] = {
        [MY_SPHERE] = {.id = "steel-sphere"}, /* names in the catalogue */
        [MY_BEAM] = {.id = "al-beam"},
    };
    struct percuss_slow_config config = percuss_slow_config_default();
    config.body_count = MY_BODIES;
    config.bodies = bodies;
    config.engine = (struct percuss_slow_engine){
        .context = &world, .probe = my_probe, .apply = my_apply, .now = my_now};
    config.move = my_move; /* optional, and worth it */
    config.service = percuss_slow_link_service(&link);
    config.fall_back = false; /* the default: no answer is an error */
    config.report = my_log;   /* optional */
    struct percuss_slow *slow;
    result = percuss_slow_create(&config, &slow);

    while (result == PERCUSS_RESULT_OK && world.time < end) {
        double h = fmin(step, percuss_slow_next(slow) - world.time);
        before = world;
        my_integrate(&world, h);
        size_t n = my_contacts(&world, contacts);
        if (percuss_slow_due(slow, n, contacts)) /* optional: back to just after the touch */
            n = my_bisect(&world, &before, slow, h, contacts);
        result = percuss_slow_advance(slow, n, contacts);
    }
    if (result != PERCUSS_RESULT_OK)
        fprintf(stderr, "%s\n", percuss_slow_error_text());
    else
        printf("sphere %.5f m/s, beam %.5f m/s\n", world.bodies[MY_SPHERE].velocity[2],
               world.bodies[MY_BEAM].velocity[2]);
    percuss_slow_free(slow);
    percuss_client_free(client);
    return result != PERCUSS_RESULT_OK;
}
