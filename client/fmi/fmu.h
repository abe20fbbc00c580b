/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One instance of the FMU: its numbers, its mode, and its log. */
#ifndef PERCUSS_FMI_FMU_H
#define PERCUSS_FMI_FMU_H

#include "model.h"
#include "source.h"

/* The standard's modes, as bits, so that a function can state where it is allowed. */
enum mode {
    MODE_INSTANTIATED = 1,
    MODE_INITIALIZATION = 2,
    MODE_EVENT = 4,
    MODE_CONTINUOUS = 8,
    MODE_STEP = 16,
    MODE_TERMINATED = 32
};

struct fmu {
    bool co_simulation;
    bool event_mode_used, early_return_allowed;
    bool logs_impacts;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
    char *resources;
    struct source *source; /* NULL: not opened yet */
    enum mode mode;
    _Alignas(max_align_t) unsigned char numbers[]; /* a model's, of MODEL.size bytes */
};

/* Tells the importer, and returns fmi3Error. */
fmi3Status fmu_error(struct fmu *fmu, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Whether the instance is in one of the modes; else tells that `function` is not for the one it is
 * in. False for no fmu, too. */
bool fmu_is_in(struct fmu *fmu, unsigned modes, const char *function);

/* Opens the source that the parameters choose, unless it is open. */
fmi3Status fmu_open(struct fmu *fmu);

/* A request with A coming to B at that speed, by the parameters. */
fmi3Status fmu_pair(struct fmu *fmu, double speed, struct percuss_request *request);

/* Asks; after initialization the impact is told under the category logImpacts. */
fmi3Status fmu_ask(struct fmu *fmu, const struct percuss_request *request, double gap_rate,
                   struct impact *impact);

#endif
