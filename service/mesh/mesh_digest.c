/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/mesh_digest.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#include <strings.h>

#include "mesh/inp_parts.h"

struct digest {
    struct sha256 *hash;
    bool deck; /* its lines are looked at */
    int depth;
    bool done; /* a *STEP has come: nothing is read beyond it */
};

static enum percuss_status add_file(struct digest *digest, const char *path, struct fault *fault);

/* Goes where a keyword line leads to. */
static enum percuss_status follow(struct digest *digest, struct scan *scan, char *line)
{
    struct card card;
    char path[INP_PATH_SIZE];
    /* a keyword that leads anywhere */
    card_parse(line, &card);
    if (strcmp(card.name, "STEP") == 0)
        digest->done = true;
    const char *name = strcmp(card.name, "INCLUDE") == 0 ? card_value(&card, "INPUT") : NULL;
    if (!name || !*name)
        return PERCUSS_OK;
    /* the reader refuses this, and reads no further */
    if (digest->depth == INP_MOST_DEPTH) {
        digest->done = true;
        return PERCUSS_OK;
    }
    /* the file beside this one */
    inp_beside(scan->file, name, path);
    digest->depth++;
    enum percuss_status status = add_file(digest, path, scan->fault);
    digest->depth--;
    return status;
}

static enum percuss_status add_file(struct digest *digest, const char *path, struct fault *fault)
{
    struct scan scan;
    char line[CARD_LINE_SIZE];
    enum percuss_status status = scan_open(path, &scan, fault), refused;
    if (status)
        return status;
    /* where an included file ends, which its bytes do not tell */
    uint64_t size = scan.size;
    if (digest->depth > 0)
        sha256_add(digest->hash, &size, sizeof size);
    sha256_add(digest->hash, scan.text, scan.size);
    while (!status && digest->deck && !digest->done && card_line(&scan, line, &refused))
        if (line[0] == '*')
            status = follow(digest, &scan, line);
    scan_close(&scan);
    return status;
}

enum percuss_status mesh_digest(const char *path, struct sha256 *hash, struct fault *fault)
{
    const char *kind = strrchr(path, '.');
    struct digest digest = {.hash = hash, .deck = kind && strcasecmp(kind, ".inp") == 0};
    return add_file(&digest, path, fault);
}
