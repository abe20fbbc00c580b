/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Gives a harness the inputs of files and folders: what was found once is a test in every build.
 * usage: fuzz_NAME FILE|FOLDER... */
#include <dirent.h>
#include <sys/stat.h>

#include "fuzz.h"

static size_t given;

static void give_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    FUZZ_REQUIRE(file && fseek(file, 0, SEEK_END) == 0, "%s: cannot be read", path);
    long size = ftell(file);
    rewind(file);
    /* to its exact size, so that tools see every byte read beyond it */
    uint8_t *data = malloc((size_t)size + !size);
    FUZZ_REQUIRE(data && fread(data, 1, (size_t)size, file) == (size_t)size, "%s: cannot be read",
                 path);
    fclose(file);
    /* stays as the last line where the harness ends the process */
    fprintf(stderr, "%s\n", path);
    LLVMFuzzerTestOneInput(data, (size_t)size);
    given++;
    free(data);
}

static void give(const char *path)
{
    struct stat about;
    char inside[4096];
    FUZZ_REQUIRE(stat(path, &about) == 0, "%s: is not there", path);
    if (!S_ISDIR(about.st_mode)) {
        give_file(path);
        return;
    }
    struct dirent **list;
    int count = scandir(path, &list, NULL, alphasort);
    for (int i = 0; i < count; i++) {
        snprintf(inside, sizeof inside, "%s/%s", path, list[i]->d_name);
        if (list[i]->d_name[0] != '.')
            give(inside);
        free(list[i]);
    }
    if (count >= 0)
        free(list);
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        give(argv[i]);
    FUZZ_REQUIRE(given > 0, "usage: %s FILE|FOLDER...", argv[0]);
    printf("%zu inputs\n", given);
    return 0;
}
