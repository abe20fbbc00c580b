/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One contact of two bodies at their default sites, as given by flags. */
#ifndef PERCUSS_CLI_SCENE_H
#define PERCUSS_CLI_SCENE_H

#include "cli.h"

enum { SCENE_CHOICES = 8 };

/* A place along a beam by its name; `at` and `at_length` say all others. */
enum scene_place { PLACE_NUMBER, PLACE_TIP, PLACE_ROOT };

/* How many angles of attack a command takes: one, one or LO:HI:N, or none. */
enum scene_angles { ANGLES_ONE, ANGLES_SWEPT, ANGLES_NONE };

struct scene {
    const char *a, *b; /* NULL: not given; b: the last one given */
    /* all bodies B and contact models given, for the commands that take several */
    const char *all_b[SCENE_CHOICES];
    enum percuss_contact_model models[SCENE_CHOICES];
    size_t b_count, model_count;
    double at, at_length; /* along a beam: fraction, or m from its end at -x (NAN: not given) */
    enum scene_place place;
    bool at_given;
    const char *at_a, *at_b;  /* names of sites; NULL: not given */
    enum scene_angles angles; /* set before flags are parsed */
    double angle, last_angle; /* of A's flight from the normal, degrees; the last of several */
    unsigned angle_count;     /* 0: not given */
    bool angle_list;          /* given as LO:HI:N */
    double spin;              /* rad/s */
    double friction;          /* coefficient; NAN: not given */
    bool askew;               /* any flag of friction, angle or spin */
    bool given;               /* any flag */
    struct percuss_options options;
};

/* Parses --a, --b, --at, --tolerance, ... into the `struct scene` that is its input. */
extern const struct argp scene_argp;

/* Another need of a command besides --a and --b: "--speed V", and whether it was given. */
struct scene_need {
    const char *what;
    bool given;
};

/* Ends the process through argp_error if --a, --b or one of `count` others is missing, and names
 * all that are. `instead` is put behind that; may be empty. */
void scene_check_given(const struct scene *scene, const struct scene_need *others, size_t count,
                       const char *instead, struct argp_state *state);

/* Ends the process through argp_error if the id in the option is neither --a's nor --b's. */
void scene_check_body(const struct scene *scene, const char *option, const char *id,
                      struct argp_state *state);

/* For commands with one body B: ends the process through argp_error if it was given more than once.
 */
void scene_check_one_b(const struct scene *scene, struct argp_state *state);

/* For commands with one impact: ends the process through argp_error if --b or --contact-model was
 * given more than once. */
void scene_check_single(const struct scene *scene, struct argp_state *state);

/* Nothing given, defaults; the second takes no --angle and no --spin. */
struct scene scene_default(void);
struct scene scene_straight(void);

/* Where the scene's bodies come from: the server's catalogue. A body that it does not list is
 * placed as a point, so that the refusal is the server's. */
struct scene_bodies {
    struct percuss_body_list list;
    struct percuss_body strangers[2];
    struct percuss_pair pair; /* at speed 0 */
};

/* Reads the catalogue and finds the bodies. Exit code; complains. Release with
 * percuss_body_list_free(&bodies->list). */
int scene_find_bodies(const struct scene *scene, const struct common *common,
                      struct percuss_client *client, struct scene_bodies *bodies);

/* Share of the speed that is along the normal. */
double scene_normal_share(const struct scene *scene);

/* The request at that speed, which is along A's flight. Exit code; complains. */
int scene_request(const struct scene *scene, const struct scene_bodies *bodies, double speed,
                  struct percuss_request *request);

/* The question in words. */
struct scene_text {
    char place[320];  /* "in the middle of al-beam (default; --at S)"; empty: no choice */
    char bodies[384]; /* "steel-sphere of steel; al-beam of aluminium, ends free and free" */
    char title[512];  /* of a picture */
};
struct scene_text scene_describe(const struct scene *scene, const struct scene_bodies *bodies);

/* Asks on stderr whether a speed (m/s) that is improbable bears another unit. */
void scene_doubt_speed(double speed);

/* Prints to stderr which of the request's bodies the server lacks and which it knows, the most
 * similar id first, and in which catalogue. */
void scene_explain_unknown(const struct common *common, struct percuss_client *client,
                           const struct percuss_request *request,
                           const struct percuss_body_list *list);

#endif
