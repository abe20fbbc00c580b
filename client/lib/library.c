/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "library.h"

#include "error.h"

const struct client_operations LIBRARY_OPERATIONS = {
    .error_text = error_last,
    .free = client_free,
    .id = client_id,
    .observes = client_observes,
    .server = client_server,
    .connect = connect_find,
    .ping = connect_ping,
    .solve = exchange_ask,
    .solve_traced = solve_traced,
    .solve_batch = solve_batch,
    .solve_ensemble = solve_ensemble,
    .submit = exchange_submit,
    .wait = exchange_wait,
    .poll = exchange_poll,
    .cancel = exchange_cancel,
    .servers = servers_list,
    .bodies = bodies_list,
    .specimens = specimens_list,
    .clear_specimen = specimens_clear,
    .watch = client_watch,
    .warning = client_warning,
};
