/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Files for tests of what reads them, in a folder of the test's own. */
#ifndef PERCUSS_TEST_MEASURED_FILES_H
#define PERCUSS_TEST_MEASURED_FILES_H

#include <dirent.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "remarks.h"

static char files_folder[] = "/tmp/percuss-measured-XXXXXX";

/* The path of a file with these bytes, until the next call. */
static inline const char *files_write(const char *name, const char *bytes, size_t size)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", files_folder, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    return path;
}

static inline const char *files_text(const char *name, const char *text)
{
    return files_write(name, text, strlen(text));
}

/* Whether one of the texts has the words. */
static inline bool files_say(const struct measured_fault *texts, size_t count, const char *words)
{
    bool said = false;
    for (size_t i = 0; i < count && i < REMARKS_KEPT; i++)
        said |= strstr(texts[i].text, words) != NULL;
    for (size_t i = 0; i < count && i < REMARKS_KEPT && !said; i++)
        print_error("'%s' does not say '%s'\n", texts[i].text, words);
    return said;
}

static inline int files_begin(void **state)
{
    (void)state;
    return mkdtemp(files_folder) ? 0 : 1;
}

static inline int files_end(void **state)
{
    (void)state;
    char path[400];
    DIR *folder = opendir(files_folder);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        snprintf(path, sizeof path, "%s/%s", files_folder, entry->d_name);
        if (entry->d_name[0] != '.')
            unlink(path);
    }
    if (folder)
        closedir(folder);
    return rmdir(files_folder);
}

#endif
