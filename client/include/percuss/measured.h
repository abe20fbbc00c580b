/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Measured impacts beside simulated ones, and parameters of bodies from them: libpercuss-measured,
 * with a client of libpercuss or of libpercuss-local. SI units; NAN: not known or undefined. Errors
 * are in percuss_measured_error_text, not in percuss_error_text. A pointer that is NULL is treated
 * as percuss.h says. */
#ifndef PERCUSS_MEASURED_H
#define PERCUSS_MEASURED_H

#include <percuss/percuss.h>

enum { PERCUSS_MAX_FITTED = 8, PERCUSS_FITTED_QUANTITIES = 3 };

struct percuss_measured_impact {
    double speed; /* of approach, > 0 */
    double restitution;
    double impulse;       /* of all sub-impacts */
    double sub_impacts;   /* a count */
    double first_impulse; /* of the first sub-impact */
    double first_duration;
    double second_start; /* of the second sub-impact of at least 1 % of the impulse, after the
                            start of the first */
    double at;           /* place along a beam, 0..1; NAN: that of the question */
    double restitution_half_width; /* of the 95 % interval of a restitution that was measured; 0 or
                                      NAN: not known */
};

/* A file as percuss compare reads it, with the same options. A member that is 0 is not said. */
struct percuss_measured_file {
    const char *file;
    size_t column_count;
    const char *const *columns; /* each as --column: "NAME=HEADING[:UNIT]" */
    size_t uncertainty_count;
    const char *const *uncertainties; /* each as --uncertainty: "NAME=VALUE", half of the 95 %
                                         interval of each number of a column */
    double scale;                     /* m of a pixel */
    double rate;                      /* frames or readings a second, Hz */
    double gravity;                   /* m/s^2 */
};

/* Impacts of one pair of bodies; opaque. */
struct percuss_measured;

/* The client, and the scene. A moves, B is at rest; the pair's bodies are of the client's
 * catalogue, its speed is not looked at. */
struct percuss_measured_question {
    struct percuss_client *client;
    struct percuss_pair pair;
    struct percuss_options options;
    double timeout;        /* s for 64 impacts */
    unsigned permutations; /* behind the p-value of the energy distance, 1..1000000 */
    uint64_t seed;         /* of these */
    double
        noise; /* of calibration: relative standard deviation of a measured number to start with */
};

/* An impact as it was measured, completed by the masses, and its twin. */
struct percuss_measured_twin {
    struct percuss_measured_impact measured, simulated;
    enum percuss_status status;
    double residual; /* of the restitution: simulated less measured */
};

struct percuss_measured_distance {
    double value;
    double p; /* of a distance at least as large, if both were of one distribution */
};

/* Of the restitution. Members may be appended. */
struct percuss_comparison {
    double measured_mean, measured_deviation;
    double simulated_mean, simulated_deviation;
    double residual_mean, residual_half_width, residual_rms; /* half width: 95 %, of the mean */
    struct percuss_measured_distance kolmogorov_smirnov, energy_distance;
    size_t sub_impacts_known, sub_impacts_equal; /* impacts */
    size_t impact_count;
    struct percuss_measured_twin *impacts;
    size_t warning_count;
    char **warnings; /* each kind once */
};

/* A parameter to be found, or found. */
struct percuss_fitted {
    enum percuss_parameter parameter;
    char body[PERCUSS_ID_SIZE]; /* one of the pair's */
    double start;               /* NAN: the catalogue's */
    double value, low, high;    /* 95 % interval */
    bool determined;            /* by the data: the interval is not as wide as half the value */
};

/* Members may be appended. */
struct percuss_calibration {
    size_t parameter_count;
    struct percuss_fitted parameters[PERCUSS_MAX_FITTED]; /* as they were asked for */
    double correlation[PERCUSS_MAX_FITTED][PERCUSS_MAX_FITTED];
    /* the first sub-impact's impulse, its duration, the start of the second */
    size_t known[PERCUSS_FITTED_QUANTITIES], used[PERCUSS_FITTED_QUANTITIES]; /* readings */
    double scatter[PERCUSS_FITTED_QUANTITIES]; /* relative standard deviation of the residuals */
    size_t impacts;
    double freedom; /* degrees */
    size_t warning_count;
    char **warnings;
};

#ifdef __cplusplus
extern "C" {
#endif

/* Reads a file, or one of which no more than its columns is said, or takes over so many impacts:
 * each needs a speed, and a restitution or an impulse. INVALID_ARGUMENT names member, lines or
 * index, values and the allowed ones. To be freed. */
PERCUSS_API enum percuss_result percuss_measured_read_file(const struct percuss_measured_file *file,
                                                           struct percuss_measured **measured);
PERCUSS_API enum percuss_result percuss_measured_read(const char *file, size_t column_count,
                                                      const char *const *columns,
                                                      struct percuss_measured **measured);
PERCUSS_API enum percuss_result
percuss_measured_create(size_t count, const struct percuss_measured_impact *impacts,
                        struct percuss_measured **measured);
PERCUSS_API void percuss_measured_free(struct percuss_measured *measured);

/* The number of impacts. */
PERCUSS_API size_t percuss_measured_count(const struct percuss_measured *measured);

/* Notes on their reading, such as omitted rows, a text each, the impacts' as long as they live;
 * NULL from the first index on that has none. */
PERCUSS_API const char *percuss_measured_note(const struct percuss_measured *measured,
                                              size_t index);

/* The pair at its default places, default options, 60 s, 1999 permutations, seed 1, noise 0.01. A
 * client or a body that is NULL is refused when the question is asked. */
PERCUSS_API struct percuss_measured_question
percuss_measured_question_default(struct percuss_client *client, const struct percuss_body *a,
                                  const struct percuss_body *b);

/* Asks for the twin of every impact. INVALID_ARGUMENT where a twin is refused, with its message, or
 * where a history of a body that vibrates cannot tell the impulse; otherwise as percuss_solve. The
 * result is to be freed after OK. */
PERCUSS_API enum percuss_result
percuss_measured_compare(const struct percuss_measured *measured,
                         const struct percuss_measured_question *question,
                         struct percuss_comparison *comparison);
PERCUSS_API void percuss_comparison_free(struct percuss_comparison *comparison);

/* Fits 1..8 parameters to the first sub-impact's impulse and duration and the start of the second:
 * `calibration` says which and from where (parameter_count; parameter, body, start), the rest is
 * filled. A tolerance of 0 is 1e-4. INVALID_ARGUMENT, too, where the data do not suffice. The
 * result is to be freed after OK. */
PERCUSS_API enum percuss_result
percuss_measured_calibrate(const struct percuss_measured *measured,
                           const struct percuss_measured_question *question,
                           struct percuss_calibration *calibration);
PERCUSS_API void percuss_calibration_free(struct percuss_calibration *calibration);

/* The error of the calling thread's last call of this library that did not return OK. */
PERCUSS_API const char *percuss_measured_error_text(void);

#ifdef __cplusplus
}
#endif

#endif
