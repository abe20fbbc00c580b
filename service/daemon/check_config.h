/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Whether a daemon with these settings would start. */
#ifndef PERCUSS_DAEMON_CHECK_CONFIG_H
#define PERCUSS_DAEMON_CHECK_CONFIG_H

#include <stdbool.h>

#include "respond/settings.h"

/* Looks at the catalogue and its bodies, the folders of tables and reduced bodies, the store, and
 * whether the domain can be joined; changes nothing. Prints "ok" on stdout, or on stderr everything
 * that is wrong, a line each. */
bool check_config(const struct settings *settings);

#endif
