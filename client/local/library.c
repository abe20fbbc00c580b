/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "library.h"

#include "error.h"

const struct client_operations LIBRARY_OPERATIONS = {
    .error_text = error_last,
    .free = local_free,
    .id = local_id,
    .observes = local_observes,
    .server = local_server,
    .connect = local_connect,
    .ping = local_ping,
    .solve = local_solve,
    .solve_traced = local_solve_traced,
    .solve_batch = local_solve_batch,
    .solve_ensemble = local_solve_ensemble,
    .submit = local_submit,
    .wait = local_wait,
    .poll = local_poll,
    .cancel = local_cancel,
    .servers = local_servers,
    .bodies = local_bodies,
    .specimens = local_specimens,
    .clear_specimen = local_clear_specimen,
    .watch = local_watch,
    .warning = local_warning,
};
