/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A sphere that hits a free beam again and again, slow scale and libpercuss together: one line an
 * impact, then it waits for a line on stdin. Without an answer it says so, and tries again after
 * another line; or goes on with the declared restitution. A number in a line is how many seconds it
 * looks for a server from then on; at first 60. Checks what must hold of every impact by
 * itself: momentum, energy, one question each, and e as the bodies' velocities show it. */
#include <math.h>
#include <percuss/slow_link.h>
#include <percuss/slowscale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REQUIRE(good, ...)                                                                         \
    do {                                                                                           \
        if (!(good)) {                                                                             \
            fprintf(stderr, "slow_client: " __VA_ARGS__);                                          \
            exit(EXIT_FAILURE);                                                                    \
        }                                                                                          \
    } while (0)

enum { SPHERE, BEAM, BODIES };
static const double sphere_radius = 0.015, beam_radius = 0.010, site = -0.18;

struct engine {
    double time;
    struct percuss_body_motion bodies[BODIES];
    struct percuss_slow_inertia inertias[BODIES];
    struct percuss_slow *slow;
    struct percuss_slow_link link;
    double vibration; /* J, in the beam, as the last reply said */
    double spent;     /* and what it may at most give back */
    bool answered;
    double restitution, restitution_reply;
    char message[512];
};

static struct percuss_slow_contact contact_now(const struct engine *engine)
{
    const double *sphere = engine->bodies[SPHERE].position;
    return (struct percuss_slow_contact){
        .a = SPHERE,
        .b = BEAM,
        .point = {sphere[0], 0.0, engine->bodies[BEAM].position[2] + beam_radius},
        .normal = {0.0, 0.0, 1.0},
        .gap = sphere[2] - engine->bodies[BEAM].position[2] - sphere_radius - beam_radius};
}

static bool probe(void *context, struct percuss_slow_view *view)
{
    struct engine *engine = context;
    percuss_slow_gap_rates(engine->bodies, view->count, view->contacts, view->gap_rate);
    if (view->delassus)
        percuss_slow_free_delassus(engine->bodies, engine->inertias, view->count, view->contacts,
                                   view->delassus);
    for (int i = 0; view->bodies && i < BODIES; i++) {
        char id[PERCUSS_ID_SIZE];
        memcpy(id, view->bodies[i].id, sizeof id);
        view->bodies[i] = engine->bodies[i];
        memcpy(view->bodies[i].id, id, sizeof id);
    }
    return true;
}

static bool apply(void *context, const struct percuss_slow_contact *contact, double impulse)
{
    struct engine *engine = context;
    percuss_slow_free_apply(engine->bodies, engine->inertias, contact, impulse);
    return true;
}

static double now(void *context)
{
    return ((struct engine *)context)->time;
}

static void report(void *context, const struct percuss_slow_report *report)
{
    struct engine *engine = context;
    engine->answered = report->reply != NULL;
    engine->restitution = report->restitution[0];
    engine->restitution_reply = NAN;
    engine->spent = engine->vibration;
    engine->vibration = 0.0;
    if (report->reply) {
        engine->restitution_reply = report->reply->contacts[0].restitution;
        for (size_t i = 0; i < report->reply->energy.vibration_count; i++)
            engine->vibration += report->reply->energy.vibration[i].energy;
    }
    snprintf(engine->message, sizeof engine->message, "%s", report->message);
}

static double energy(const struct engine *engine)
{
    double sum = 0.0;
    for (int b = 0; b < BODIES; b++)
        for (int k = 0; k < 3; k++) {
            double v = engine->bodies[b].velocity[k], o = engine->bodies[b].angular_velocity[k];
            sum += 0.5 * engine->inertias[b].mass * v * v;
            sum += 0.5 * engine->inertias[b].moments[k] * o * o;
        }
    return sum;
}

/* Along z, and about y through the origin (the beam does not turn between: it is put back). */
static void momentum(const struct engine *engine, double sums[2])
{
    sums[0] = sums[1] = 0.0;
    for (int b = 0; b < BODIES; b++) {
        const struct percuss_body_motion *body = &engine->bodies[b];
        double p = engine->inertias[b].mass * body->velocity[2];
        sums[0] += p;
        sums[1] +=
            engine->inertias[b].moments[1] * body->angular_velocity[1] - body->position[0] * p;
    }
}

/* False: there is none any more. */
static bool next_line(struct engine *engine)
{
    char line[32];
    if (!fgets(line, sizeof line, stdin))
        return false;
    if (line[0] != '\n')
        engine->link.reconnect = strtod(line, NULL);
    return true;
}

static void advance(struct engine *engine)
{
    struct percuss_slow_contact contact = contact_now(engine);
    while (percuss_slow_advance(engine->slow, 1, &contact)) {
        printf("error %s\n", percuss_slow_error_text());
        fflush(stdout);
        REQUIRE(next_line(engine), "%s\n", percuss_slow_error_text());
    }
}

/* One impact from a fresh touch, with what follows of it. */
static void impact(struct engine *engine, double speed)
{
    struct percuss_slow_contact contact;
    double before[2], after[2], rate, rate_after;
    for (int i = 0; i < BODIES; i++) {
        memset(engine->bodies[i].velocity, 0, sizeof engine->bodies[i].velocity);
        memset(engine->bodies[i].angular_velocity, 0, sizeof(double[3]));
        memset(engine->bodies[i].position, 0, sizeof engine->bodies[i].position);
    }
    engine->bodies[SPHERE].position[0] = site;
    engine->bodies[SPHERE].position[2] = sphere_radius + beam_radius + 1e-4;
    advance(engine);                                    /* apart: armed */
    engine->bodies[SPHERE].position[2] -= 1e-4 + 1e-12; /* touching whatever rounding does */
    engine->bodies[SPHERE].velocity[2] = -speed;
    contact = contact_now(engine);
    percuss_slow_gap_rates(engine->bodies, 1, &contact, &rate);
    momentum(engine, before);
    double available = energy(engine);
    advance(engine);
    /* no motion: W and n hold still, and the bodies overlap all the while */
    double end = engine->time + 0.4;
    while (engine->time < end) {
        double step = fmin(engine->time + 1e-3, end);
        engine->time = fmin(step, percuss_slow_next(engine->slow));
        advance(engine);
    }
    percuss_slow_gap_rates(engine->bodies, 1, &contact, &rate_after);
    momentum(engine, after);
    for (int i = 0; i < 2; i++)
        REQUIRE(fabs(after[i] - before[i]) <= 1e-12 * fabs(before[0]),
                "momentum %d: %.17g, %.17g\n", i, before[i], after[i]);
    /* the reply's own energy balance is closed to ten times the tolerance */
    REQUIRE(energy(engine) + engine->vibration <= (available + engine->spent) * (1.0 + 1e-4),
            "energy %.12g of %.12g\n", energy(engine) + engine->vibration,
            available + engine->spent);
    REQUIRE(fabs(-rate_after / rate - engine->restitution) <= 1e-9, "e %.12g, %.12g\n",
            -rate_after / rate, engine->restitution);
    REQUIRE(!engine->answered || fabs(engine->restitution - engine->restitution_reply) <= 1e-9,
            "e %.12g, reply %.12g\n", engine->restitution, engine->restitution_reply);
    printf("%s e = %.12f after = %.15e %s\n", engine->answered ? "percuss" : "declared",
           engine->restitution, rate_after, engine->message);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    bool falls_back = argc == 5 && strcmp(argv[4], "fall-back") == 0;
    REQUIRE(argc == 4 || falls_back, "usage: slow_client DOMAIN list|total IMPACTS [fall-back]\n");
    static struct engine engine;
    struct percuss_client_config client_config = percuss_client_config_default();
    struct percuss_client *client;
    client_config.domain = (uint32_t)strtoul(argv[1], NULL, 10);
    REQUIRE(!percuss_client_create(&client_config, &client), "%s\n", percuss_error_text());
    engine.link = percuss_slow_link_default(client);
    engine.link.reconnect = 60.0; /* only ends what would hang */
    struct percuss_slow_config config = percuss_slow_config_default();
    config.body_count = BODIES;
    config.bodies = (struct percuss_slow_body[]){{.id = "steel-sphere"}, {.id = "al-beam"}};
    config.engine = (struct percuss_slow_engine){
        .context = &engine, .probe = probe, .apply = apply, .now = now};
    config.service = percuss_slow_link_service(&engine.link);
    config.options.tolerance = 1e-5;
    config.restitution = 0.45;
    config.fall_back = falls_back;
    config.application = strcmp(argv[2], "total") ? PERCUSS_SLOW_LIST : PERCUSS_SLOW_TOTAL;
    config.report = report;
    config.report_context = &engine;
    REQUIRE(!percuss_slow_create(&config, &engine.slow), "%s\n", percuss_slow_error_text());
    /* the catalogue's bodies: steel 7800, aluminium 2700 kg/m^3, the rotation of a Timoshenko beam
     */
    const double sphere = 7800.0 * 4.0 / 3.0 * M_PI * pow(sphere_radius, 3.0);
    const double beam = 2700.0 * M_PI * beam_radius * beam_radius;
    const double turn = beam * (1.0 / 12.0 + beam_radius * beam_radius / 4.0);
    engine.inertias[SPHERE] = (struct percuss_slow_inertia){sphere, {1e-5, 1e-5, 1e-5}};
    engine.inertias[BEAM] = (struct percuss_slow_inertia){beam, {4e-5, turn, turn}};
    for (int i = 0; i < BODIES; i++)
        engine.bodies[i].orientation[0] = 1.0;
    int impacts = atoi(argv[3]);
    for (int i = 0; i < impacts; i++) {
        if (i > 0 && !next_line(&engine))
            break;
        impact(&engine, 0.2 + 0.01 * i);
    }
    struct percuss_slow_counts counts = percuss_slow_counts(engine.slow);
    printf("%llu impacts, %llu requests, %llu repeated, %llu declared\n",
           (unsigned long long)counts.impacts, (unsigned long long)counts.requests,
           (unsigned long long)counts.repeated, (unsigned long long)counts.declared);
    percuss_slow_free(engine.slow);
    percuss_client_free(client);
    return EXIT_SUCCESS;
}
