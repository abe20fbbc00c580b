/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/remarks.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

/* More of a distribution than this outside its truncation is worth a word. */
static const double TRUNCATED_SHARE = 0.01;

/* More samples than this that differ from the accuracy search by more than the tolerance, or one
 * that does by so many times of it, too. */
static const double OUTSIDE_SHARE = 0.05, OUTSIDE_FACTOR = 10.0;

__attribute__((format(printf, 2, 3))) static void warn(struct ensemble_report *report,
                                                       const char *format, ...)
{
    if (report->warning_count == REPORT_WARNINGS)
        return;
    va_list args;
    va_start(args, format);
    vsnprintf(report->warnings[report->warning_count++], sizeof *report->warnings, format, args);
    va_end(args);
}

/* Samples of which something is to be said. */
struct occurrence {
    uint64_t count, first;
};

static void note(struct occurrence *occurrence, uint64_t index)
{
    if (occurrence->count++ == 0)
        occurrence->first = index;
}

/* A sample that is solved again for its words. */
struct witness {
    const struct ensemble *ensemble;
    const struct watch *watch;      /* NULL: nobody */
    struct ensemble_worker *worker; /* NULL: none was called yet */
    uint64_t index;
    struct ensemble_sample sample;
    struct fault fault;
};

/* False: out of memory. */
static bool call(struct witness *witness, uint64_t index)
{
    if (witness->worker && witness->index == index)
        return true;
    if (!witness->worker &&
        ensemble_worker_create(&witness->worker, witness->ensemble, witness->watch, NULL))
        return false;
    witness->index = index;
    ensemble_solve(witness->worker, index, &witness->sample, &witness->fault);
    return true;
}

/* What it says to a kind of warning, or with WARNING_KINDS to its refusal. */
static const char *words_of(const struct witness *witness, enum warning_kind kind)
{
    /* what the worker has in mind then is another sample */
    if (witness->sample.status == PERCUSS_TIMEOUT)
        return "(no time was left to say why)";
    const char *text = kind == WARNING_KINDS
                           ? witness->fault.text
                           : warnings_text(ensemble_warnings(witness->worker), kind);
    return text ? text : "";
}

/* In the words of the first of them. */
static void quote(struct ensemble_report *report, const struct witness *witness,
                  const struct occurrence *occurrence, enum warning_kind kind)
{
    bool refusal = kind == WARNING_KINDS;
    warn(report, "samples: %llu of %llu%s, first %llu: %s",
         (unsigned long long)occurrence->count, (unsigned long long)report->done,
         refusal ? " were refused and are left out" : "", (unsigned long long)occurrence->first,
         words_of(witness, kind));
}

/* Every kind of warning once, and the refusals. False: out of memory. */
static bool warn_samples(struct ensemble_report *report, struct witness *witness,
                         const struct ensemble_sample *samples)
{
    /* how often each occurs, and where first */
    struct occurrence found[WARNING_KINDS + 1] = {0};
    for (uint64_t i = 0; i < report->done; i++) {
        if (!ensemble_sample_has_result(&samples[i]))
            note(&found[WARNING_KINDS], i);
        for (unsigned kinds = samples[i].warnings; kinds; kinds &= kinds - 1)
            note(&found[__builtin_ctz(kinds)], i);
    }
    /* in the words of that sample, solved again */
    bool good = true;
    for (int kind = 0; good && kind <= WARNING_KINDS; kind++) {
        if (found[kind].count == 0)
            continue;
        good = call(witness, found[kind].first);
        if (good)
            quote(report, witness, &found[kind], (enum warning_kind)kind);
    }
    return good;
}

static bool is_of_table(unsigned model)
{
    return contact_law_asked(model)->tables == CONTACT_TABLES_ONLY;
}

/* A table and the closed form differ by some 0.01: not to be taken for a spread of the inputs. */
static void warn_models(struct ensemble_report *report, const struct ensemble *ensemble,
                        const struct ensemble_sample *samples)
{
    uint64_t closed = 0;
    bool tables = is_of_table(ensemble->stated_model);
    for (uint64_t i = 0; i < report->done; i++) {
        if (!ensemble_sample_has_result(&samples[i]))
            continue;
        bool tabulated = is_of_table(samples[i].contact_model);
        tables = tables || tabulated;
        closed += contact_law_asked(samples[i].contact_model)->curve && !tabulated;
    }
    if (tables && closed)
        warn(report,
             "samples: %llu of %llu follow the closed form, for want of a table for their "
             "materials or so deep, others (or the impact as it is stated) a table: the two differ "
             "by some 0.01 in the restitution (contact_model closed-form takes one for all)",
             (unsigned long long)closed, (unsigned long long)report->done);
}

static void warn_numbers(struct ensemble_report *report, const struct ensemble *ensemble)
{
    const struct ensemble_spec *spec = &ensemble->spec;
    if (report->truncated)
        warn(report,
             "samples: %llu of %llu reached the horizon or the effort allowed before they "
             "were over",
             (unsigned long long)report->truncated, (unsigned long long)report->done);
    for (size_t i = 0; i < spec->input_count; i++) {
        double share = input_truncated(&spec->inputs[i]);
        if (share > TRUNCATED_SHARE)
            warn(report,
                 "inputs[%zu]: %s: %.2g of its distribution lies outside what is possible or "
                 "allowed and is cut off",
                 i, input_quantity_name(spec->inputs[i].quantity), share);
    }
}

/* What the samples that were solved again say of all. */
static void warn_verification(struct ensemble_report *report, const struct ensemble *ensemble)
{
    const struct report_verification *verification = &report->verification;
    double tolerance = ensemble->model.tolerance;
    if (verification->count == 0)
        return;
    /* samples that differ */
    double outside = 1.0 - verification->within;
    if (outside > OUTSIDE_SHARE || verification->largest > OUTSIDE_FACTOR * tolerance)
        warn(report,
             "verification: %.2g %% of %zu samples solved again by the accuracy search differ by "
             "more than the tolerance of %g, by up to %.2g: so do as many of all samples, %.2g to "
             "%.2g %% (the mean is off by %.1g, a quantile by up to %.1g)",
             100.0 * outside, verification->count, tolerance, verification->largest,
             100.0 * (1.0 - verification->within_bounds.high),
             100.0 * (1.0 - verification->within_bounds.low), fabs(verification->mean_shift),
             verification->quantile_shift);
    /* searches that do not know better */
    if ((double)verification->unmet > OUTSIDE_SHARE * (double)verification->count)
        warn(report,
             "verification: %zu of %zu samples: the accuracy search itself does not reach the "
             "tolerance of %g, by its own estimate",
             verification->unmet, verification->count, tolerance);
    /* a mean that is off */
    if (fabs(verification->mean_shift) > tolerance)
        warn(report,
             "verification: the mean is off by %.2g: more than the tolerance: ask for a "
             "finer one",
             verification->mean_shift);
}

bool remarks_fill(struct ensemble_report *report, const struct ensemble *ensemble,
                  const struct ensemble_sample *samples, const struct watch *watch)
{
    struct witness witness = {.ensemble = ensemble, .watch = watch};
    bool good = warn_samples(report, &witness, samples);
    ensemble_worker_free(witness.worker);
    if (!good)
        return false;
    warn_models(report, ensemble, samples);
    warn_numbers(report, ensemble);
    warn_verification(report, ensemble);
    return true;
}
