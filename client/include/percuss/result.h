/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How a call of this library ended, and names for the numbers in replies. A reply's own status
 * (PERCUSS_OK, PERCUSS_BAD_REQUEST, ...) is the server's judgement and another matter. */
#ifndef PERCUSS_RESULT_H
#define PERCUSS_RESULT_H

#include <percuss/vocabulary.h>

#ifndef PERCUSS_API
#define PERCUSS_API __attribute__((visibility("default")))
#endif

#define PERCUSS_RESULT_LIST(X)                                                                     \
    X(OK, "ok")                                                                                    \
    X(PENDING, "not answered yet")                                                                 \
    X(TIMEOUT, "no answer in time")                                                                \
    X(NO_SERVER, "no server")                                                                      \
    X(INCOMPATIBLE, "a server of another wire version or configuration")                           \
    X(INVALID_ARGUMENT, "invalid argument")                                                        \
    X(WINDOW_FULL, "too many outstanding requests")                                                \
    X(UNKNOWN_SEQUENCE, "no outstanding request of that sequence")                                 \
    X(NO_MEMORY, "out of memory")                                                                  \
    X(TRANSPORT, "DDS failed")                                                                     \
    X(CANCELLED, "given up")

#define PERCUSS_RESULT_MEMBER(name, text) PERCUSS_RESULT_##name,
enum percuss_result { PERCUSS_RESULT_LIST(PERCUSS_RESULT_MEMBER) PERCUSS_RESULT_COUNT };

#ifdef __cplusplus
extern "C" {
#endif

/* The version of the library, "major.minor.patch". */
PERCUSS_API const char *percuss_version(void);

/* A few words for the result, never NULL. */
PERCUSS_API const char *percuss_result_text(enum percuss_result result);

/* The error of the calling thread's last call that did not return PERCUSS_RESULT_OK, or that
 * returned NULL: names the field, its value and the allowed values. Valid until the thread's next
 * call. */
PERCUSS_API const char *percuss_error_text(void);

/* The names used on the wire, in JSON and on the command line; "?" for an unknown number. */
PERCUSS_API const char *percuss_status_name(unsigned status);
PERCUSS_API const char *percuss_end_reason_name(unsigned end_reason);
PERCUSS_API const char *percuss_contact_model_name(unsigned contact_model);
PERCUSS_API const char *percuss_method_name(unsigned method);
PERCUSS_API const char *percuss_compliance_name(unsigned compliance);
PERCUSS_API const char *percuss_parameter_name(unsigned parameter);
PERCUSS_API const char *percuss_dents_name(unsigned dents);
PERCUSS_API const char *percuss_delassus_source_name(unsigned source);
PERCUSS_API const char *percuss_friction_name(unsigned friction);
PERCUSS_API const char *percuss_friction_state_name(unsigned state);

#ifdef __cplusplus
}
#endif

#endif
