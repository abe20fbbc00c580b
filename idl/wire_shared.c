/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_shared.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

/* The socket of iox-roudi, of iceoryx 2. */
static const char ROUDI[] = "/tmp/roudi";

enum { LARGEST_FILE = 1 << 20 };

/* The comments become blanks. */
static void blank_comments(char *text)
{
    for (char *start; (start = strstr(text, "<!--"));) {
        const char *end = strstr(start, "-->");
        size_t length = end ? (size_t)(end + 3 - start) : strlen(start);
        memset(start, ' ', length);
    }
}

/* The content of the first element of that name ("<NAME"), which ends with one of the next; NULL:
 * there is none. */
static const char *find_content(const char *text, const char *start)
{
    const char *element = strcasestr(text, start);
    const char *content = element ? strchr(element, '>') : NULL;
    return content ? content + 1 : NULL;
}

static bool is_enabled(const char *xml)
{
    char *text = strdup(xml);
    bool enabled = false;
    if (!text)
        return false;
    blank_comments(text);
    for (const char *shared = text; !enabled && (shared = find_content(shared, "<SharedMemory"));) {
        const char *end = strcasestr(shared, "</SharedMemory");
        const char *value = find_content(shared, "<Enable");
        if (!value || (end && value > end))
            continue;
        enabled = strncasecmp(value + strspn(value, " \t\r\n"), "true", 4) == 0;
    }
    free(text);
    return enabled;
}

static bool is_enabled_in(const char *path)
{
    char *text = calloc(1, LARGEST_FILE + 1);
    FILE *file = text ? fopen(path, "re") : NULL;
    bool enabled = file && fread(text, 1, LARGEST_FILE, file) > 0 && is_enabled(text);
    if (file)
        fclose(file);
    free(text);
    return enabled;
}

bool wire_shared_is_asked(const char *configuration)
{
    static const char scheme[] = "file://";
    char path[4096];
    bool asked = false;
    while (!asked && *configuration) {
        configuration += strspn(configuration, ", \t\r\n");
        /* XML, in which any commas are its own: more of it, or files, may follow */
        if (*configuration == '<') {
            asked = is_enabled(configuration);
            const char *end = strrchr(configuration, '>');
            configuration = end ? end + 1 : "";
            continue;
        }
        size_t length = strcspn(configuration, ",");
        const char *name = configuration;
        if (strncmp(name, scheme, strlen(scheme)) == 0)
            name += strlen(scheme);
        snprintf(path, sizeof path, "%.*s", (int)(configuration + length - name), name);
        asked = is_enabled_in(path);
        configuration += length;
    }
    return asked;
}

bool wire_shared_is_there(void)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    snprintf(address.sun_path, sizeof address.sun_path, "%s", ROUDI);
    int file = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    bool there = file >= 0 && connect(file, (const struct sockaddr *)&address, sizeof address) == 0;
    if (file >= 0)
        close(file);
    return there;
}
