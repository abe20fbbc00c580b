/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Files of meshes that tests write, read, damage and delete. */
#ifndef PERCUSS_TEST_FILES_H
#define PERCUSS_TEST_FILES_H

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "mesh/bulk.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_read.h"

static char file_path[64];
static struct fault file_fault;

static inline void file_write(const char *suffix, const void *data, size_t size)
{
    snprintf(file_path, sizeof file_path, "/tmp/percuss-test-%d%s", (int)getpid(), suffix);
    FILE *stream = fopen(file_path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(data, 1, size, stream), size);
    assert_int_equal(fclose(stream), 0);
}

/* Writes the text into a file, reads it in this unit and deletes it. */
static inline enum percuss_status file_read(const char *suffix, const char *text, double unit,
                                            struct solid_mesh *mesh)
{
    file_write(suffix, text, strlen(text));
    enum percuss_status status =
        mesh_read(file_path, &(struct mesh_options){.unit = unit}, mesh, &file_fault);
    unlink(file_path);
    return status;
}

/* The text is refused with a message that has these words. */
static inline void file_refused(const char *suffix, const char *text, const char *words)
{
    struct solid_mesh mesh;
    if (file_read(suffix, text, 0.001, &mesh) != PERCUSS_BAD_REQUEST)
        fail_msg("not refused, but should be for: %s", words);
    if (!strstr(file_fault.text, words))
        fail_msg("\"%s\" has not \"%s\"", file_fault.text, words);
    assert_null(mesh.points);
}

/* Puts `to` in place of the first `from` in a text; the same buffer each time. */
static inline const char *file_with(const char *text, const char *from, const char *to)
{
    static char changed[20000];
    const char *at = strstr(text, from);
    assert_non_null(at);
    snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
    return changed;
}

/* Whatever is done to a file, reading and checking it ends with a mesh or with words: it is cut
 * short, bytes of it change, numbers become large or none. `tries` of each. */
static inline void file_survives(const char *suffix, const void *data, size_t size, int tries)
{
    static const char *const WORDS[] = {"99999999999", "-7", "nan", "18446744073709551615", "0"};
    unsigned random = 1;
    char *damaged = malloc(size + 32);
    for (int i = 0; i < 3 * tries; i++) {
        struct solid_mesh mesh;
        random = random * 1103515245u + 12345u;
        size_t at = (size_t)(random >> 8) % size, length = size;
        memcpy(damaged, data, size);
        if (i % 3 == 0)
            length = at;
        else if (i % 3 == 1)
            damaged[at] = (char)(random >> 4);
        else
            memcpy(damaged + at, WORDS[random % 5u], fmin(strlen(WORDS[random % 5u]), size - at));
        file_write(suffix, damaged, length);
        file_fault.text[0] = '\0';
        enum percuss_status status =
            mesh_read(file_path, &(struct mesh_options){.unit = 1.0}, &mesh, &file_fault);
        assert_true(status == PERCUSS_OK || file_fault.text[0]);
        struct surface surface = {0};
        struct mesh_findings findings;
        if (status == PERCUSS_OK && surface_make(&mesh, &surface, &file_fault) == PERCUSS_OK &&
            surface_fit(&mesh, &surface, &file_fault) == PERCUSS_OK)
            mesh_check(&mesh, &surface, &findings, &file_fault);
        surface_free(&surface);
        solid_mesh_free(&mesh);
    }
    unlink(file_path);
    free(damaged);
}

#endif
