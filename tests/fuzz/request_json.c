/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A request as JSON, and a distribution as text: read into a request that the library takes, or
 * refused in words. */
#include "request_json.h"
#include <percuss/percuss.h>

#include "convert.h"
#include "fuzz.h"
#include "input_text.h"

static void read_request(const uint8_t *data, size_t size)
{
    static struct json_request request;
    static struct request_storage storage;
    struct json_fault fault = {""};
    json_error_t error;
    json_t *root = json_loadb((const char *)data, size, JSON_REJECT_DUPLICATES, &error);
    if (!root)
        return;
    if (request_json_read(root, &request, &fault)) {
        percuss_v1_Request wire;
        enum percuss_result result = convert_request(&request.request, &storage, &wire);
        FUZZ_REQUIRE(result == PERCUSS_RESULT_OK || percuss_error_text()[0],
                     "refused without a word");
    } else {
        fuzz_refused(PERCUSS_BAD_REQUEST, fault.text);
    }
    json_decref(root);
}

/* NAME[@BODY]=DISTRIBUTION, but for lists, which are files */
static void read_input(const uint8_t *data, size_t size)
{
    char text[256];
    struct percuss_input input = {0};
    struct input_fault fault = {""};
    size_t length = size < sizeof text ? size : sizeof text - 1;
    memcpy(text, data, length);
    text[length] = '\0';
    if (strstr(text, "list:"))
        return;
    if (input_text_read(text, &input, &fault))
        input_text_middle(&input);
    else
        FUZZ_REQUIRE(fault.text[0], "refused without a word");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size && data[0] == '{')
        read_request(data, size);
    else if (size)
        read_input(data, size);
    return 0;
}
