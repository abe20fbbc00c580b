/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The members of what servers announce of themselves and of specimens, see fields.h. */
#ifndef PERCUSS_FIELDS_SERVER_H
#define PERCUSS_FIELDS_SERVER_H

#define PERCUSS_SERVER_FIELDS(F, L)                                                                \
    F(OCTETS, server, "its id")                                                                    \
    F(TEXT, version, "of the program")                                                             \
    F(TEXT, catalogue_revision, "hash of the catalogue")                                           \
    F(TEXT, catalogue, "file")                                                                     \
    F(TEXT, host, "its name")                                                                      \
    F(COUNT, process, "its number")                                                                \
    F(TEXT, state, "ready, draining")                                                              \
    F(COUNT, workers, "threads that solve")                                                        \
    F(COUNT, bodies, "of the catalogue")                                                           \
    F(COUNT, queue_length, "requests that wait")                                                   \
    F(COUNT, queue_capacity, "requests that may wait")                                             \
    F(LONG_COUNT, answered, "requests")                                                            \
    F(LONG_COUNT, refused, "requests")                                                             \
    F(COUNT, specimens, "that it keeps")                                                           \
    F(VALUE, uptime, "s")                                                                          \
    F(TEXT, activity, "what a long computation is doing")                                          \
    F(VALUE, progress, "0..1; undefined: nothing is running")                                      \
    L(LIST, tasks, task_count, task,                                                               \
      "what it does and what waits, 16 at most: those that run before those that wait, the "       \
      "oldest first")                                                                              \
    F(COUNT, all_tasks, "how many there are, listed or not")

#define PERCUSS_TASK_FIELDS(F, ...)                                                                \
    F(OCTETS, client, "who waits for it; zeros: nobody")                                           \
    F(LONG_COUNT, sequence, "its number, of that client")                                          \
    F(CHOICE, kind, task_kind, PERCUSS_TASK_COUNT, "")                                             \
    F(FLAG, running, "false: it waits for its turn")                                               \
    F(VALUE, age, "s; since it was asked for")                                                     \
    F(VALUE, done, "share of it, 0..1; undefined: not known")

#define PERCUSS_RELAXATION_TERM_FIELDS(F, ...)                                                     \
    F(VALUE, share, "of the instantaneous modulus, that is lost")                                  \
    F(VALUE, time, "s; in which it falls to 1/e of that")

#define PERCUSS_CONTACT_LAW_FIELDS(F, ...)                                                         \
    F(TEXT, name, "its own; empty: there is none")                                                 \
    F(TEXT, kind, "power, hysteresis, hunt-crossley, points")                                      \
    F(VALUE, stiffness, "N/m^exponent; undefined: of points, as the next three")                   \
    F(VALUE, exponent, "of the indentation")                                                       \
    F(VALUE, hysteresis, "share of the work of loading that is lost")                              \
    F(VALUE, dissipation, "s/m; Hunt and Crossley's")                                              \
    F(VALUE, deviation, "standard deviation of the force over the force")                          \
    F(TEXT, points, "file of loading, as the catalogue names it")                                  \
    F(COUNT, point_count, "points of loading")                                                     \
    F(VALUE, max_indentation, "m; of the last one")                                                \
    F(VALUE, max_force, "N; of the last one")                                                      \
    F(TEXT, unloading, "file of unloading; empty: the way of loading")                             \
    F(VALUE, residual_indentation, "m; where unloading from the last one ends")

#define PERCUSS_MATERIAL_PAIR_FIELDS(F, L)                                                         \
    F(TEXT, material_a, "the first by name")                                                       \
    F(TEXT, material_b, "the other one, or the same")                                              \
    F(VALUE, friction, "coefficient; undefined: none is stated")                                   \
    F(VALUE, friction_deviation, "its standard deviation")                                         \
    L(OPTIONAL, law, contact_law,                                                                  \
      "the law of their contacts, which contact model auto takes; its name is empty: none is "     \
      "stated")

#define PERCUSS_DENT_FIELDS(F, ...)                                                                \
    F(VECTOR, point, INFINITY, "m; body frame")                                                    \
    F(VALUE, size, "m; radius of the patch")                                                       \
    F(VALUE, max_indentation, "m")                                                                 \
    F(VALUE, max_force, "N")                                                                       \
    F(VALUE, residual_indentation, "m; depth that stays")                                          \
    F(VALUE, contact_radius, "m; at the largest force")

#endif
