/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/identity.h"

#include "daemon/log.h"
#include "wire_security.h"

static const double LOOK_SECONDS = 86400.0;

void identity_read(struct identity *identity, const char *folder)
{
    *identity = (struct identity){.looked = -LOOK_SECONDS};
    if (folder && !wire_validity_read(folder, &identity->validity))
        identity->folder = folder;
}

void identity_look(struct identity *identity, double now, time_t then)
{
    char words[128];
    bool ended = then > identity->validity.end;
    if (!identity->folder || (ended == identity->ended && now - identity->looked < LOOK_SECONDS))
        return;
    identity->looked = now;
    identity->ended = ended;
    if (!wire_validity_holds(&identity->validity, then, words, sizeof words))
        log_line(LEVEL_ERROR, "security: %s/%s: clients that come now do not believe it",
                 identity->folder, words);
    else if (wire_validity_ends_soon(&identity->validity, then, words, sizeof words))
        log_line(LEVEL_WARNING, "security: %s/%s: make the folder anew before, and restart",
                 identity->folder, words);
}

static void log_revocation(const char *folder, const struct wire_revocation *found)
{
    if (found->is_missing)
        log_line(LEVEL_WARNING, "security: %s/crl.pem: is not there any more; the last list stays",
                 folder);
    if (found->lost)
        log_line(
            LEVEL_WARNING,
            "security: %s/crl.pem: lacks entries of the last list: %u, which are no longer revoked",
            folder, found->lost);
    if (found->listed)
        log_line(LEVEL_INFO, "security: %s/crl.pem: revoked certificates: %u, cut off now: %u",
                 folder, found->listed, found->cut_off);
}

void identity_revoke(const char *folder)
{
    char problem[512];
    struct wire_revocation found;
    if (!folder)
        return;
    if (!wire_security_revoke(folder, &found, problem, sizeof problem))
        log_line(LEVEL_ERROR, "%s; the last list stays", problem);
    else
        log_revocation(folder, &found);
}

bool identity_remark(const char *folder, char *remark, size_t size)
{
    struct wire_validity validity;
    return !wire_validity_read(folder, &validity) &&
           wire_security_remark(folder, &validity, time(NULL), remark, size);
}
