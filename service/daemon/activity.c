/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/activity.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "exchange/clock.h"

/* The lock is held. */
static void forget(struct activity *activity)
{
    activity->owner = NULL;
    activity->text[0] = '\0';
    activity->progress = activity->begun = NAN;
}

void activity_create(struct activity *activity)
{
    pthread_mutex_init(&activity->lock, NULL);
    forget(activity);
}

void activity_release(struct activity *activity)
{
    pthread_mutex_destroy(&activity->lock);
}

void activity_set(struct activity *activity, const void *owner, double progress, const char *format,
                  ...)
{
    va_list arguments;
    va_start(arguments, format);
    pthread_mutex_lock(&activity->lock);
    if (!activity->owner || activity->owner == owner) {
        if (!activity->owner)
            activity->begun = clock_now();
        activity->owner = owner;
        vsnprintf(activity->text, sizeof activity->text, format, arguments);
        activity->progress = progress;
    }
    pthread_mutex_unlock(&activity->lock);
    va_end(arguments);
}

void activity_clear(struct activity *activity, const void *owner)
{
    pthread_mutex_lock(&activity->lock);
    if (activity->owner == owner)
        forget(activity);
    pthread_mutex_unlock(&activity->lock);
}

void activity_read(struct activity *activity, char *text, size_t size, double *progress)
{
    pthread_mutex_lock(&activity->lock);
    snprintf(text, size, "%s", activity->text);
    *progress = activity->progress;
    pthread_mutex_unlock(&activity->lock);
}

double activity_begun(struct activity *activity)
{
    pthread_mutex_lock(&activity->lock);
    double begun = activity->begun;
    pthread_mutex_unlock(&activity->lock);
    return begun;
}
