/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/sites_file.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/atomic_file.h"

static const char FIRST[] = "percuss sites 1";
/* Sites of one body: each lookup goes through all of them. */
enum { MOST_SITES = 10000 };
/* Numbers of a site's line: face, point, flexibility, tensor. */
enum { NUMBERS = 11 };

/* BODY.sites, for free(); NULL: no memory. */
static char *sites_path(const struct mesh_body *body)
{
    char *path;
    return asprintf(&path, "%s.sites", body->path) < 0 ? NULL : path;
}

static enum percuss_status out_of_memory(const struct mesh_body *body, struct fault *fault)
{
    return fault_set(fault, PERCUSS_INTERNAL, "%.400s.sites: out of memory", body->path);
}

static enum percuss_status refuse_line(const struct mesh_body *body, size_t line, const char *must,
                                       struct fault *fault)
{
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s.sites:%zu: %s", body->path, line, must);
}

/* How sites are solved for: one more where a release gives other flexibilities for the same mesh.
 */
enum { METHOD = 1 };

/* The body's line: what its sites hold for. Another release may take out other modes, or state
 * flexibilities for another contact, of the same mesh. */
static void body_line(const struct mesh_body *body, char line[256])
{
    snprintf(line, 256, "body %s %zu %.17g %d", body->hash, body->removed, body->cut, METHOD);
}

/* ---- reading ---- */

/* False: the line is none of a site of the body. */
static bool read_site(const struct mesh_body *body, const char *text, struct mesh_body_site *site)
{
    double numbers[NUMBERS], size = 0.0;
    for (int i = 0; i < NUMBERS; i++) {
        char *end;
        numbers[i] = strtod(text, &end);
        if (end == text || isinf(numbers[i]) || (i < 4 && isnan(numbers[i])))
            return false;
        text = end;
    }
    if (*text || !(numbers[0] >= 0.0 && numbers[0] < (double)body->face_count))
        return false;
    site->face = (unsigned)numbers[0];
    memcpy(site->point, numbers + 1, sizeof site->point);
    site->flexibility = numbers[4];
    memcpy(site->tensor, numbers + 5, sizeof site->tensor);
    for (int k = 0; k < 6; k++)
        size += site->tensor[k];
    /* all of a tensor is known, or nothing */
    for (int k = 0; k < 6 && isnan(size); k++)
        site->tensor[k] = NAN;
    return true;
}

/* Room for one more. */
static bool make_room(struct mesh_body *body)
{
    struct mesh_body_site *sites =
        realloc(body->added, (body->added_count + 1) * sizeof *body->added);
    if (sites)
        body->added = sites;
    return sites != NULL;
}

/* The sites' lines, up to "end". */
static enum percuss_status read_lines(FILE *file, struct mesh_body *body, struct fault *fault)
{
    char line[512];
    size_t at = 2;
    while (fgets(line, sizeof line, file)) {
        unsigned long count;
        at++;
        line[strcspn(line, "\n")] = '\0';
        if (sscanf(line, "end %lu", &count) == 1)
            return count == body->added_count
                       ? PERCUSS_OK
                       : refuse_line(body, at, "must be the number of sites: it is damaged", fault);
        if (!make_room(body))
            return out_of_memory(body, fault);
        if (body->added_count == MOST_SITES || strncmp(line, "site ", 5) != 0 ||
            !read_site(body, line + 5, &body->added[body->added_count]))
            return refuse_line(body, at,
                               "must be a site of the body, \"site FACE X Y Z FLEXIBILITY XX YY ZZ "
                               "XY YZ ZX\": the file is damaged",
                               fault);
        body->added_count++;
    }
    return refuse_line(body, at + 1, "must be \"end COUNT\": the file is cut short", fault);
}

/* An open file, which is empty while the first sites are being solved for. */
static enum percuss_status read_open(FILE *file, struct mesh_body *body, struct fault *fault)
{
    char line[256], own[256];
    if (!fgets(line, sizeof line, file))
        return PERCUSS_OK;
    line[strcspn(line, "\n")] = '\0';
    if (strcmp(line, FIRST) != 0)
        return refuse_line(body, 1, "must be \"percuss sites 1\": made by percuss-reduce", fault);
    if (!fgets(line, sizeof line, file) || strncmp(line, "body ", 5) != 0)
        return refuse_line(body, 2, "must be \"body HASH MODES CUT METHOD\"", fault);
    line[strcspn(line, "\n")] = '\0';
    /* those of a body that the present one has replaced count no more */
    body_line(body, own);
    if (strcmp(line, own) != 0)
        return PERCUSS_OK;
    return read_lines(file, body, fault);
}

/* In place of those that the body has. */
static enum percuss_status read_again(FILE *file, struct mesh_body *body, struct fault *fault)
{
    free(body->added);
    body->added = NULL;
    body->added_count = 0;
    return read_open(file, body, fault);
}

enum percuss_status sites_file_read(struct mesh_body *body, struct fault *fault)
{
    char *path = sites_path(body);
    if (!path)
        return out_of_memory(body, fault);
    enum percuss_status status = PERCUSS_OK;
    FILE *file = fopen(path, "re");
    if (file) {
        status = read_again(file, body, fault);
        fclose(file);
    } else if (errno != ENOENT)
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: cannot be opened: %s", path,
                           strerror(errno));
    free(path);
    return status;
}

/* ---- adding ---- */

/* Opens the file, which is made if there is none, and holds it alone: until it is closed no other
 * process adds sites. The file that has the name afterwards is held, not one that another process
 * has replaced meanwhile. Returns its descriptor, or -1 with errno. */
static int hold_file(const char *path)
{
    for (;;) {
        struct stat held, named;
        int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (file < 0)
            return -1;
        int failed;
        while ((failed = flock(file, LOCK_EX)) != 0 && errno == EINTR)
            ;
        if (!failed && fstat(file, &held) == 0 && stat(path, &named) == 0 &&
            held.st_ino == named.st_ino && held.st_dev == named.st_dev)
            return file;
        int reason = errno;
        close(file);
        if (failed) {
            errno = reason;
            return -1;
        }
    }
}

/* Whether the body has a site there, on the same patch. */
static bool has_site(const struct mesh_body *body, const struct mesh_body_site *site)
{
    const struct mesh_body_site *there = mesh_body_added_at(body, site->face, site->point);
    return there && body->faces[there->face].patch == body->faces[site->face].patch;
}

/* Those that have no earlier one in reach. */
static enum percuss_status merge(struct mesh_body *body, size_t count,
                                 const struct mesh_body_site *sites, size_t *added,
                                 struct fault *fault)
{
    *added = 0;
    for (size_t i = 0; i < count; i++) {
        if (has_site(body, &sites[i]))
            continue;
        if (body->added_count == MOST_SITES)
            return fault_set(
                fault, PERCUSS_BAD_REQUEST,
                "%.300s.sites: must have at most %d sites: reduce the mesh with all of "
                "its flexibility",
                body->path, MOST_SITES);
        if (!make_room(body))
            return out_of_memory(body, fault);
        body->added[body->added_count++] = sites[i];
        ++*added;
    }
    return PERCUSS_OK;
}

/* All sites of the body, whole or not at all; 17 digits give the same bits back. */
static enum percuss_status write_sites(const char *path, const struct mesh_body *body,
                                       struct fault *fault)
{
    struct atomic_file aside;
    char line[256];
    int descriptor = atomic_file_create(&aside, path, 0666, fault);
    if (descriptor < 0)
        return PERCUSS_BAD_REQUEST;
    FILE *file = fdopen(descriptor, "w");
    if (!file) {
        close(descriptor);
        atomic_file_abandon(&aside);
        return out_of_memory(body, fault);
    }
    body_line(body, line);
    fprintf(file, "%s\n%s\n", FIRST, line);
    for (size_t i = 0; i < body->added_count; i++) {
        const struct mesh_body_site *site = &body->added[i];
        fprintf(file, "site %u %.17g %.17g %.17g %.17g", site->face, site->point[0], site->point[1],
                site->point[2], site->flexibility);
        for (int k = 0; k < 6; k++)
            fprintf(file, " %.17g", site->tensor[k]);
        fputc('\n', file);
    }
    fprintf(file, "end %zu\n", body->added_count);
    bool bad = ferror(file) || fflush(file) != 0;
    if (fclose(file) != 0 || bad) {
        atomic_file_abandon(&aside);
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: cannot be written: is the disk full?",
                         path);
    }
    return atomic_file_finish(&aside, true, fault);
}

enum percuss_status sites_file_add(struct mesh_body *body, size_t count,
                                   const struct mesh_body_site *sites, size_t *added,
                                   struct fault *fault)
{
    char *path = sites_path(body);
    if (!path)
        return out_of_memory(body, fault);
    enum percuss_status status = PERCUSS_OK;
    int held = hold_file(path);
    FILE *file = held < 0 ? NULL : fdopen(held, "r");
    if (!file)
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: cannot be written: %s", path,
                           strerror(errno));
    if (!file && held >= 0)
        close(held);
    /* with those of other processes */
    if (!status)
        status = read_again(file, body, fault);
    if (!status)
        status = merge(body, count, sites, added, fault);
    if (!status && *added > 0)
        status = write_sites(path, body, fault);
    if (file)
        fclose(file);
    free(path);
    return status;
}
