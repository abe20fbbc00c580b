/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How to start a server: with the files beside this program, built or installed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"
#include "domains.h"
#include "start_advice.h"

/* From the folder of this program; in a build tree, build/bin of the source. */
static const struct {
    const char *daemon, *settings;
} places[] = {{"percussd", "../../config/percussd.yaml"}, {INSTALLED_DAEMON, INSTALLED_SETTINGS}};

/* A file of the daemon's package, from the folder of the package's percuss. */
static const char UNIT[] = "../lib/systemd/system/percussd.service";
static const char UNIT_SETTINGS[] = "../../etc/percuss/percussd.yaml";

/* The folder of this program in `folder`; false: unknown. */
static bool own_folder(char folder[PATH_MAX])
{
    ssize_t length = readlink("/proc/self/exe", folder, PATH_MAX - 1);
    if (length <= 0)
        return false;
    folder[length] = '\0';
    char *slash = strrchr(folder, '/');
    if (!slash)
        return false;
    *slash = '\0';
    return true;
}

/* The file at `from`/`path` as a user here would write it; false: there is none. */
static bool start_advice_find(const char *from, const char *path, char found[PATH_MAX])
{
    char whole[PATH_MAX];
    char here[PATH_MAX];
    if (snprintf(whole, sizeof whole, "%s/%s", from, path) >= (int)sizeof whole ||
        !realpath(whole, found))
        return false;
    size_t length = getcwd(here, sizeof here) ? strlen(here) : 0;
    if (length > 1 && strncmp(found, here, length) == 0 && found[length] == '/')
        memmove(found, found + length + 1, strlen(found + length));
    return true;
}

/* The domain that the unit's settings name, 0 without. */
static unsigned unit_domain(const char *folder)
{
    char path[PATH_MAX], line[256];
    unsigned domain = 0;
    FILE *settings = start_advice_find(folder, UNIT_SETTINGS, path) ? fopen(path, "r") : NULL;
    while (settings && fgets(line, sizeof line, settings))
        (void)sscanf(line, "domain: %u", &domain);
    if (settings)
        fclose(settings);
    return domain;
}

/* Whether the service manager has a daemon that would be found. */
static bool unit_suits(const struct common *common, const char *folder)
{
    char path[PATH_MAX];
    const bool partition = common->partition && common->partition[0];
    return !partition && start_advice_find(folder, UNIT, path) &&
           unit_domain(folder) == common->domain;
}

bool start_advice_program(char daemon[PATH_MAX])
{
    char folder[PATH_MAX], path[PATH_MAX];
    bool known = own_folder(folder), found = false;
    for (size_t i = 0; known && !found && i < sizeof places / sizeof places[0]; i++)
        found = snprintf(path, sizeof path, "%s/%s", folder, places[i].daemon) < PATH_MAX &&
                realpath(path, daemon);
    return found;
}

bool start_advice_daemon(char daemon[PATH_MAX], char settings[PATH_MAX])
{
    char folder[PATH_MAX];
    bool known = own_folder(folder), found = false;
    for (size_t i = 0; known && !found && i < sizeof places / sizeof places[0]; i++)
        found = start_advice_find(folder, places[i].daemon, daemon) &&
                start_advice_find(folder, places[i].settings, settings);
    return found;
}

void start_advice(const struct common *common, char *text, size_t size)
{
    char folder[PATH_MAX];
    char daemon[PATH_MAX];
    char settings[PATH_MAX];
    const bool partition = common->partition && common->partition[0];
    const bool unit = own_folder(folder) && unit_suits(common, folder);
    const bool found = start_advice_daemon(daemon, settings);
    snprintf(text, size, "start one with: %s%s --config %s --domain %u%s%s",
             unit ? "systemctl start percussd; or by yourself: " : "", found ? daemon : "percussd",
             found ? settings : "FILE", common->domain, partition ? " --partition " : "",
             partition ? common->partition : "");
}

/* Where else servers are: "; one is in domain 7, 9". */
static void list_domains(const struct common *common, char *text, size_t size)
{
    unsigned domains[DOMAINS_MOST];
    size_t count = domains_with_server(common, domains), length = 0;
    *text = '\0';
    for (size_t i = 0; i < count && length < size; i++)
        length += (size_t)snprintf(text + length, size - length, "%s%u",
                                   i ? ", " : "; one is in domain ", domains[i]);
}

void complain_no_server(const struct common *common)
{
    char what[768];
    char elsewhere[128];
    char advice[3 * PATH_MAX];
    /* before the library has something else to say */
    snprintf(what, sizeof what, "%s", percuss_error_text());
    list_domains(common, elsewhere, sizeof elsewhere);
    start_advice(common, advice, sizeof advice);
    complain("%s%s; percuss doctor looks for the reason; --local needs none; %s", what, elsewhere,
             advice);
}
