/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a solve may use besides its request; all borrowed. */
#ifndef PERCUSS_SOLVE_MEANS_H
#define PERCUSS_SOLVE_MEANS_H

#include "base/watch.h"
#include "model/body.h"

struct contact_table_source; /* contact/law_table.h */

struct solve_means {
    const struct body_set *catalogue;
    const struct contact_table_source *tables; /* of contact laws; NULL: none */
    struct watch watch;                        /* who is asked about once a millisecond whether to
                                                  go on; otherwise it ends with TIMEOUT */
};

#endif
