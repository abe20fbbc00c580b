/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A whole request as JSON: members as in percuss_request, and optionally `client` (32 hexadecimal
 * digits) and `sequence`. */
#ifndef PERCUSS_CLI_REQUEST_JSON_H
#define PERCUSS_CLI_REQUEST_JSON_H

#include <jansson.h>
#include <percuss/request.h>
#include <stdbool.h>

struct json_request {
    struct percuss_request request; /* its delassus points into `delassus` */
    double delassus[PERCUSS_MAX_DELASSUS];
    bool has_client;
    uint8_t client[16];
};

/* Why a request is not read, with the path of the member. */
struct json_fault {
    char text[512];
};

/* Fills `request` from the JSON value. Omitted members take their defaults. False with the reason:
 * an unknown member, a wrong type or length, an unknown choice. */
bool request_json_read(const json_t *root, struct json_request *request, struct json_fault *fault);

/* The same from a file, or standard input for "-"; also false for text that is not JSON. */
bool request_json_load(const char *file, struct json_request *request, struct json_fault *fault);

/* The request as request_json_read takes it, but client and sequence. The caller releases it. NULL:
 * out of memory. */
json_t *request_to_json(const struct percuss_request *request);

/* The JSON Schema of a request; the caller releases it. */
json_t *request_schema(void);

#endif
