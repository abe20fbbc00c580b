/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/own_law.h"

#include <stdlib.h>

void own_law_clear(struct own_law *law)
{
    free(law->points.indentation);
    free(law->unloading.indentation);
    law->points = law->unloading = (struct own_curve){0};
}
