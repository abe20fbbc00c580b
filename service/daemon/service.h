/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The life of the running service: it begins, reloads its catalogue, drains and ends. */
#ifndef PERCUSS_DAEMON_SERVICE_H
#define PERCUSS_DAEMON_SERVICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/fault.h"
#include "respond/settings.h"

/* Of the main thread alone. */
struct service;

/* Loads the catalogue, joins the domain under that server id (NULL: one of its own) and starts the
 * threads; `settings` stays the caller's and must outlive the service. NULL with a fault. */
struct service *service_create(const struct settings *settings, const uint8_t *server,
                               struct fault *fault);

/* Reads the catalogue again; a bad one is logged and changes nothing. */
void service_reload(struct service *service);

/* Publishes the status and drops expired states and replies: to be called about once a second. */
void service_tick(struct service *service);

/* Whether every thread that should move has moved within the last `patience` seconds; one that has
 * not is logged. To be called about as often as service_tick. */
bool service_is_alive(struct service *service, double patience);

/* Its status in a line. */
void service_describe(struct service *service, char *text, size_t size);

/* From now on new requests are refused. */
void service_begin_drain(struct service *service);

/* Waits until all queued requests are answered and delivered, at most `seconds`. False: some are
 * not. */
bool service_drain(struct service *service, double seconds);

/* Ends the running solves with BUSY, ensembles with the samples that they have, and waits as
 * service_drain does. */
bool service_cut_short(struct service *service);

/* Ends the threads and leaves the domain. */
void service_free(struct service *service);

/* Queues a check and a copy of the store of specimens; the log has the result. */
void service_back_up(struct service *service);

#endif
