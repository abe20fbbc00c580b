/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_clock.h"

#include <time.h>

/* s: what may pass between two readings of clocks on a busy machine; no thread of DDS sleeps for
 * less than that */
static const double NOTICEABLE = 0.02;

static double read_clock(clockid_t id)
{
    struct timespec now;
    clock_gettime(id, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Read on both sides: who is interrupted in between does not take that for a step. */
static double read_ahead(void)
{
    double ahead = 0.0, within = 1.0;
    for (int i = 0; i < 4 && within > 1e-3; i++) {
        double before = read_clock(CLOCK_MONOTONIC);
        double day = read_clock(CLOCK_REALTIME);
        double after = read_clock(CLOCK_MONOTONIC);
        if (i > 0 && after - before >= within)
            continue;
        within = after - before;
        ahead = day - 0.5 * (before + after);
    }
    return ahead;
}

struct wire_clock wire_clock_start(void)
{
    return (struct wire_clock){.ahead = read_ahead()};
}

double wire_clock_step(struct wire_clock *clock)
{
    double ahead = read_ahead(), step = ahead - clock->ahead;
    clock->ahead = ahead;
    return step;
}

bool wire_clock_is_back(double step)
{
    return step < -NOTICEABLE;
}

void wire_clock_rouse(dds_entity_t writer)
{
    dds_qos_t *qos = dds_create_qos();
    dds_entity_t another = 0;
    if (dds_get_qos(writer, qos) == DDS_RETCODE_OK)
        another = dds_create_writer(dds_get_publisher(writer), dds_get_topic(writer), qos, NULL);
    dds_delete_qos(qos);
    /* for the thread that ends things its end is a task, and what it had of the other's is taken
     * from that at once */
    if (another > 0)
        dds_delete(another);
}
