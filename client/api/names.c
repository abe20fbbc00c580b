/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <percuss/ensemble.h>
#include <percuss/result.h>
#include <percuss/task.h>
#include <stddef.h>

#define NAME_TEXT(name, text) text,
#define COUNT(array)          (sizeof(array) / sizeof(array)[0])

static const char *name_of(const char *const *names, size_t count, unsigned number)
{
    return number < count ? names[number] : "?";
}

const char *percuss_version(void)
{
    return PERCUSS_VERSION;
}

const char *percuss_result_text(enum percuss_result result)
{
    static const char *const names[] = {PERCUSS_RESULT_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), result);
}

const char *percuss_status_name(unsigned status)
{
    static const char *const names[] = {PERCUSS_STATUS_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), status);
}

const char *percuss_end_reason_name(unsigned end_reason)
{
    static const char *const names[] = {PERCUSS_END_REASON_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), end_reason);
}

const char *percuss_contact_model_name(unsigned contact_model)
{
    static const char *const names[] = {PERCUSS_CONTACT_MODEL_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), contact_model);
}

const char *percuss_method_name(unsigned method)
{
    static const char *const names[] = {PERCUSS_METHOD_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), method);
}

const char *percuss_compliance_name(unsigned compliance)
{
    static const char *const names[] = {PERCUSS_COMPLIANCE_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), compliance);
}

const char *percuss_dents_name(unsigned dents)
{
    static const char *const names[] = {PERCUSS_DENTS_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), dents);
}

const char *percuss_parameter_name(unsigned parameter)
{
    static const char *const names[] = {PERCUSS_PARAMETER_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), parameter);
}

const char *percuss_delassus_source_name(unsigned source)
{
    static const char *const names[] = {PERCUSS_DELASSUS_SOURCE_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), source);
}

const char *percuss_friction_name(unsigned friction)
{
    static const char *const names[] = {PERCUSS_FRICTION_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), friction);
}

const char *percuss_friction_state_name(unsigned state)
{
    static const char *const names[] = {PERCUSS_FRICTION_STATE_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), state);
}

const char *percuss_distribution_name(unsigned distribution)
{
    static const char *const names[] = {PERCUSS_DISTRIBUTION_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), distribution);
}

const char *percuss_sampling_name(unsigned sampling)
{
    static const char *const names[] = {PERCUSS_SAMPLING_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), sampling);
}

const char *percuss_task_kind_name(unsigned kind)
{
    static const char *const names[] = {PERCUSS_TASK_KIND_LIST(NAME_TEXT)};
    return name_of(names, COUNT(names), kind);
}
