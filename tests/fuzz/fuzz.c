/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fuzz.h"

#include <sys/mman.h>
#include <unistd.h>

enum { SLOTS = 4 };

const char *fuzz_file(int slot, const uint8_t *data, size_t size)
{
    static struct {
        int descriptor;
        char path[64];
    } files[SLOTS];
    if (!files[slot].descriptor) {
        files[slot].descriptor = memfd_create("input", 0);
        snprintf(files[slot].path, sizeof files[slot].path, "/proc/self/fd/%d",
                 files[slot].descriptor);
    }
    bool good = ftruncate(files[slot].descriptor, 0) == 0 &&
                pwrite(files[slot].descriptor, data, size, 0) == (ssize_t)size;
    FUZZ_REQUIRE(good, "no file in memory");
    return files[slot].path;
}

void fuzz_refused(enum percuss_status status, const char *text)
{
    FUZZ_REQUIRE(status != PERCUSS_INTERNAL, "INTERNAL: %s", text);
    FUZZ_REQUIRE(text[0], "refused without a word");
    for (const char *c = text; *c; c++)
        FUZZ_REQUIRE((unsigned char)*c >= ' ' && *c != 0x7f, "control character %d in: %s", *c,
                     text);
}

void fuzz_take(struct fuzz_bytes *bytes, void *value, size_t size)
{
    size_t taken = bytes->left < size ? bytes->left : size;
    memset(value, 0, size);
    if (taken)
        memcpy(value, bytes->data, taken);
    bytes->data += taken;
    bytes->left -= taken;
}

struct fuzz_bytes fuzz_part(struct fuzz_bytes *bytes, const char *mark)
{
    struct fuzz_bytes part = *bytes;
    const uint8_t *end = bytes->left ? memmem(bytes->data, bytes->left, mark, strlen(mark)) : NULL;
    if (end)
        part.left = (size_t)(end - bytes->data);
    size_t passed = part.left + (end ? strlen(mark) : 0);
    bytes->data += passed;
    bytes->left -= passed;
    return part;
}
