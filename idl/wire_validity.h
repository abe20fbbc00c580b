/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Since when and until when an identity (wire_security.h) holds, by its certificates and its
 * permissions. */
#ifndef PERCUSS_WIRE_VALIDITY_H
#define PERCUSS_WIRE_VALIDITY_H

#include <stdbool.h>
#include <stddef.h>
#include <time.h>

/* Of all its files: which begins last and which ends first, s since 1970. */
struct wire_validity {
    time_t begin, end;
    const char *begins, *ends; /* names of files in the folder */
};

/* Reads it from the folder. NULL, or the name of the file that should be a certificate and is none;
 * permissions that are not one grant with its two dates are left to DDS. */
const char *wire_validity_read(const char *folder, struct wire_validity *validity);

/* Whether it holds then. False: `words` says "cert.pem: ended 3 days ago, on 2026-11-20". */
bool wire_validity_holds(const struct wire_validity *validity, time_t then, char *words,
                         size_t size);

/* Whether it has ended, or does so within two seconds: at the end DDS takes the participant away,
 * and a program that makes something in it then is ended. */
bool wire_validity_is_over(const struct wire_validity *validity, time_t then);

/* Whether it ends within 30 days from then. True: `words` says "cert.pem: ends in 3 days, on ...".
 */
bool wire_validity_ends_soon(const struct wire_validity *validity, time_t then, char *words,
                             size_t size);

#endif
