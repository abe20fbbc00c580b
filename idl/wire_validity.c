/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_validity.h"

#include <limits.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DAY = 86400, WARNED_DAYS = 30, MOMENT = 2 /* s */, MOST_OCTETS = 1024 * 1024 };

static const char *const CERTIFICATES[] = {"cert.pem", "identity_ca.pem", "permissions_ca.pem"};
static const char PERMISSIONS[] = "permissions.p7s";

struct period {
    time_t begin, end;
};

static FILE *open_file(const char *folder, const char *name)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return fopen(path, "rbe");
}

static bool read_certificate(const char *folder, const char *name, struct period *period)
{
    FILE *file = open_file(folder, name);
    X509 *certificate = file ? PEM_read_X509(file, NULL, NULL, NULL) : NULL;
    struct tm begin, end;
    bool good = certificate && ASN1_TIME_to_tm(X509_get0_notBefore(certificate), &begin) == 1 &&
                ASN1_TIME_to_tm(X509_get0_notAfter(certificate), &end) == 1;
    if (good)
        *period = (struct period){timegm(&begin), timegm(&end)};
    X509_free(certificate);
    if (file)
        fclose(file);
    return good;
}

/* A file's text, to be freed; NULL: none, or too much for permissions. */
static char *read_text(const char *folder, const char *name)
{
    FILE *file = open_file(folder, name);
    char *text = file ? malloc(MOST_OCTETS) : NULL;
    size_t length = text ? fread(text, 1, MOST_OCTETS, file) : MOST_OCTETS;
    if (file)
        fclose(file);
    if (length < MOST_OCTETS) {
        text[length] = '\0';
        return text;
    }
    free(text);
    return NULL;
}

/* The date in the only element of that name: as XML Schema writes it, in UTC where it names no
 * zone. */
static bool find_date(const char *text, const char *element, time_t *date)
{
    const char *start = strstr(text, element);
    if (!start || strstr(start + 1, element))
        return false;
    struct tm parts = {.tm_isdst = 0};
    const char *rest = strptime(start + strlen(element), " %Y-%m-%dT%H:%M:%S", &parts);
    if (!rest || (*rest != '<' && *rest != 'Z'))
        return false;
    *date = timegm(&parts);
    return true;
}

/* Signed text is readable as it is (openssl smime -text). */
static bool read_permissions(const char *folder, struct period *period)
{
    char *text = read_text(folder, PERMISSIONS);
    bool good = text && find_date(text, "<not_before>", &period->begin) &&
                find_date(text, "<not_after>", &period->end);
    free(text);
    return good;
}

static void narrow(struct wire_validity *validity, const char *name, const struct period *period)
{
    if (!validity->begins || period->begin > validity->begin) {
        validity->begins = name;
        validity->begin = period->begin;
    }
    if (!validity->ends || period->end < validity->end) {
        validity->ends = name;
        validity->end = period->end;
    }
}

const char *wire_validity_read(const char *folder, struct wire_validity *validity)
{
    struct period period;
    *validity = (struct wire_validity){.begins = NULL};
    for (size_t i = 0; i < sizeof CERTIFICATES / sizeof *CERTIFICATES; i++) {
        if (!read_certificate(folder, CERTIFICATES[i], &period))
            return CERTIFICATES[i];
        narrow(validity, CERTIFICATES[i], &period);
    }
    if (read_permissions(folder, &period))
        narrow(validity, PERMISSIONS, &period);
    return NULL;
}

/* As "ended 3 days ago, on 2026-11-20", the day by UTC. */
static void say(const char *file, const char *when, time_t date, char *words, size_t size)
{
    struct tm parts;
    char day[32] = "";
    if (gmtime_r(&date, &parts))
        strftime(day, sizeof day, "%Y-%m-%d", &parts);
    snprintf(words, size, "%s: %s, on %s", file, when, day);
}

/* Whole days as text: "1 day", "30 days". */
static const char *count_days(time_t seconds, char text[32])
{
    long days = (long)(seconds / DAY);
    if (days == 0)
        return "less than a day";
    snprintf(text, 32, "%ld day%s", days, days == 1 ? "" : "s");
    return text;
}

bool wire_validity_holds(const struct wire_validity *validity, time_t then, char *words,
                         size_t size)
{
    char days[32], when[64];
    if (then > validity->end) {
        snprintf(when, sizeof when, "ended %s ago", count_days(then - validity->end, days));
        say(validity->ends, when, validity->end, words, size);
    } else if (then < validity->begin) {
        snprintf(when, sizeof when, "begins in %s", count_days(validity->begin - then, days));
        say(validity->begins, when, validity->begin, words, size);
    } else {
        return true;
    }
    return false;
}

bool wire_validity_is_over(const struct wire_validity *validity, time_t then)
{
    return validity->ends && then >= validity->end - MOMENT;
}

bool wire_validity_ends_soon(const struct wire_validity *validity, time_t then, char *words,
                             size_t size)
{
    char days[32], when[64];
    time_t left = validity->end - then;
    if (left < 0 || left >= (time_t)WARNED_DAYS * DAY)
        return false;
    snprintf(when, sizeof when, "ends in %s", count_days(left, days));
    say(validity->ends, when, validity->end, words, size);
    return true;
}
