/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What is possible but improbable of a body: mostly a number in another unit than was meant. Of the
 * numbers that both sides of the wire have, so that a file can be checked before a daemon reads it,
 * and a daemon's bodies from outside. */
#ifndef PERCUSS_PLAUSIBLE_H
#define PERCUSS_PLAUSIBLE_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

struct plausible_body {
    const char *shape;
    double young, density, yield; /* NAN: not one for all; infinite yield: stays elastic */
    const double *half_extents;   /* [3], m; 0: without bounds */
};

/* The key that is worth a look, and why. */
struct plausible_remark {
    const char *key;
    char text[160];
};
enum { PLAUSIBLE_MOST = 8 };

struct plausible_range {
    const char *key, *unit;
    double low, high;
    const char *below, *above; /* what to think of */
};

/* Solids that are hit: balsa has 100 kg/m^3 and osmium 22,600; soft rubber has 1 MPa and
 * diamond 1.2 TPa; lead yields at 5 MPa, the hardest steels at 3 GPa. */
static inline void plausible_number(const struct plausible_range *range, double value,
                                    struct plausible_remark *remarks, size_t *count)
{
    if (!(value < range->low || (value > range->high && isfinite(value))))
        return;
    struct plausible_remark *remark = &remarks[(*count)++];
    remark->key = range->key;
    snprintf(remark->text, sizeof remark->text, "%.6g %s: %s %.6g %s: %s", value, range->unit,
             value < range->low ? "below" : "above", value < range->low ? range->low : range->high,
             range->unit, value < range->low ? range->below : range->above);
}

/* The number of remarks about its material. */
static inline size_t plausible_material(const struct plausible_body *body,
                                        struct plausible_remark remarks[PLAUSIBLE_MOST])
{
    static const struct plausible_range density = {"density",
                                                   "kg/m^3",
                                                   100.0,
                                                   25000.0,
                                                   "is a unit missing, such as g/cm^3?",
                                                   "no solid is as heavy"};
    static const struct plausible_range young = {
        "young", "Pa", 1e6, 1.5e12, "is a unit missing, such as GPa?", "no solid is as stiff"};
    /* Metals, glass and ceramics are as heavy: lead has 16 GPa. Magnesium (45 GPa), beryllium and
     * carbon fibres lie between 1600 and 2500 kg/m^3, and so does PTFE, with 0.4 GPa and more. */
    const double heavy = 1600.0, metal = 2500.0;
    const struct plausible_range stiff = {"young",
                                          "Pa",
                                          body->density < metal ? 0.2e9 : 1e9,
                                          1.2e12,
                                          "softer than what has this density: is GPa meant?",
                                          "no solid is as stiff: is GPa meant?"};
    static const struct plausible_range yield = {
        "yield", "Pa", 1e5, 2e10, "is a unit missing, such as MPa?", "no solid is as strong"};
    size_t count = 0;
    plausible_number(&density, body->density, remarks, &count);
    plausible_number(body->density >= heavy && body->young >= young.low ? &stiff : &young,
                     body->young, remarks, &count);
    plausible_number(&yield, body->yield, remarks, &count);
    return count;
}

/* Whether a solid may be a metal: lead has 16 GPa and osmium 560, magnesium 1,740 kg/m^3. Plastics
 * are softer, woods and carbon fibres lighter; glass, stone and ceramics cannot be told from it. */
static inline bool plausible_metal(double young, double density)
{
    return young >= 10e9 && young <= 600e9 && density >= 1700.0;
}

/* How bodies are described whose material states `yield: none`. */
#define PLAUSIBLE_ELASTIC "no yield"

/* Not improbable, but worth a word: a metal of which neither a yield is stated nor that it has none
 * (`none`). False: nothing to say. */
static inline bool plausible_unstated(const struct plausible_body *body, bool none,
                                      struct plausible_remark *remark)
{
    if (none || !isinf(body->yield) || !plausible_metal(body->young, body->density))
        return false;
    remark->key = "yield";
    snprintf(remark->text, sizeof remark->text,
             "not stated: it stays elastic in every contact; a metal yields (mostly at %.4g to "
             "%.4g MPa): state yield, or none",
             1e-9 * body->young, 1e-8 * body->young);
    return true;
}

/* The same of a plastic, rubber or wood, which no metal, glass or ceramic is as soft as, and of
 * which neither a loss_factor nor a relaxation is stated (`stated`); of improbable numbers nothing.
 */
static inline bool plausible_lossless(const struct plausible_body *body, bool stated,
                                      struct plausible_remark *remark)
{
    struct plausible_remark others[PLAUSIBLE_MOST];
    if (stated || !(body->young < 10e9) || plausible_material(body, others) > 0)
        return false;
    remark->key = "loss_factor";
    snprintf(remark->text, sizeof remark->text,
             "not stated: its contacts lose nothing by it; hard plastics have 0.02 to 0.1, rubber "
             "0.05 to 1: state loss_factor, or 0");
    return true;
}

static inline void plausible_say(struct plausible_remark *remark, const char *key,
                                 const char *format, double value, double bound)
    __attribute__((format(printf, 3, 0)));
static inline void plausible_say(struct plausible_remark *remark, const char *key,
                                 const char *format, double value, double bound)
{
    remark->key = key;
    snprintf(remark->text, sizeof remark->text, format, value, bound);
}

/* The number of remarks about its size; of a mesh percuss-reduce makes them. A bar that is not even
 * as long as two thicknesses has no waves of a bar. One of more than a thousand radii is a wire: of
 * steel and 1 m, held at one end, it would hang down by a fifth of its length. What is thicker than
 * 2 m, or a bar of more than 100 m, is seldom hit, nor is what is thinner than a hair. */
static inline size_t plausible_size(const struct plausible_body *body,
                                    struct plausible_remark remarks[PLAUSIBLE_MOST])
{
    const double *half = body->half_extents;
    bool bar = strcmp(body->shape, "rod") == 0 || strcmp(body->shape, "beam") == 0;
    double length = 2.0 * half[0], thick = fmax(half[1], half[2]), thin = fmin(half[1], half[2]);
    double across = bar ? 2.0 * thick : fmax(length, 2.0 * thick);
    double thinnest = 2.0 * fmin(half[0], thin);
    size_t count = 0;
    if (!(length > 0.0) || strcmp(body->shape, "mesh") == 0)
        return 0;
    /* as a bar */
    if (bar && length < 4.0 * thick)
        plausible_say(&remarks[count++], "length",
                      "%.6g m: shorter than four radii (of %.6g m): a cylinder or a block is the "
                      "shape of compact bodies",
                      length, thick);
    if (bar && length > 1000.0 * thin)
        plausible_say(&remarks[count++], "length",
                      "%.6g m: more than 1000 radii (of %.6g m): thinner than any bar", length,
                      thin);
    if (bar && length > 100.0)
        plausible_say(&remarks[count++], "length", "%.6g m: more than %g m", length, 100.0);
    /* as anything */
    if (across > 2.0)
        plausible_say(&remarks[count++], "size",
                      "%.6g m: more than %g m: is a unit missing, such as mm?", across, 2.0);
    if (thinnest < 2e-5)
        plausible_say(&remarks[count++], "size", "%.6g m: less than a hair has (%g m)", thinnest,
                      2e-5);
    return count;
}

#endif
