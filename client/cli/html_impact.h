/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An impact as a page for a browser, which needs no network: the bodies in motion, the histories,
 * the numbers. */
#ifndef PERCUSS_CLI_HTML_IMPACT_H
#define PERCUSS_CLI_HTML_IMPACT_H

#include "cli.h"
#include "plot_impact.h"

/* Writes the page of an answer with histories. `bodies`: the catalogue; `title` NULL: the names of
 * the bodies of the first contact. Exit code; complains in the name of --html. */
int html_impact(const char *file, const struct impact_run *run,
                const struct percuss_body_list *bodies, const char *title,
                const struct common *common);

#endif
