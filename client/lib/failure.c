/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "failure.h"

#include <dds/dds.h>

#include "error.h"

enum percuss_result failure_dds(const char *what, int code)
{
    if (code == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)
        return error_set(PERCUSS_RESULT_TRANSPORT, "%s: our permissions do not allow it", what);
    return error_set(PERCUSS_RESULT_TRANSPORT, "%s: %s", what, dds_strretcode(-code));
}

enum percuss_result failure_lost(const char *server)
{
    return error_set(PERCUSS_RESULT_NO_SERVER,
                     "%s is gone; connect again to ask another one, or the same one restarted",
                     server);
}
