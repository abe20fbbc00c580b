/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reply_json.h"

#include <math.h>
#include <percuss/percuss.h>
#include <stdio.h>

#include "cli.h"

json_t *json_number(double number)
{
    return isfinite(number) ? json_real(number) : json_null();
}

static void set(json_t *object, const char *name, double number)
{
    json_object_set_new(object, name, json_number(number));
}

static void set_text(json_t *object, const char *name, const char *text)
{
    // what is not UTF-8 becomes null rather than a missing member
    json_t *value = json_string(text);
    json_object_set_new(object, name, value ? value : json_null());
}

static void set_count(json_t *object, const char *name, uint64_t count)
{
    json_object_set_new(object, name, json_integer((json_int_t)count));
}

static void set_flag(json_t *object, const char *name, bool flag)
{
    json_object_set_new(object, name, json_boolean(flag));
}

static void set_octets(json_t *object, const char *name, const uint8_t octets[16])
{
    char text[33];
    format_hex(octets, text);
    set_text(object, name, text);
}

static void set_vector(json_t *object, const char *name, const double vector[3])
{
    json_t *array = json_array();
    for (int i = 0; i < 3; ++i)
        json_array_append_new(array, json_number(vector[i]));
    json_object_set_new(object, name, array);
}

/* A new array as a member; the object owns it. */
static json_t *set_array(json_t *object, const char *name)
{
    json_t *array = json_array();
    json_object_set_new(object, name, array);
    return array;
}

/* A new object at the end of the array, which owns it. */
static json_t *append_object(json_t *array)
{
    json_t *object = json_object();
    json_array_append_new(array, object);
    return object;
}

static void add_sub_impact(json_t *array, const struct percuss_sub_impact *sub)
{
    json_t *object = append_object(array);
    set(object, "start", sub->start);
    set(object, "compression_end", sub->compression_end);
    set(object, "end", sub->end);
    set(object, "impulse", sub->impulse);
    set(object, "compression_impulse", sub->compression_impulse);
    set(object, "peak_force", sub->peak_force);
    set(object, "max_indentation", sub->max_indentation);
    set(object, "gap_rate_before", sub->gap_rate_before);
    set(object, "gap_rate_after", sub->gap_rate_after);
    set_flag(object, "negligible", sub->negligible);
}

static void add_contact(json_t *array, const struct percuss_contact_result *contact)
{
    json_t *object = append_object(array);
    set(object, "impulse", contact->impulse);
    set_vector(object, "impulse_vector", contact->impulse_vector);
    set(object, "impulse_compression", contact->impulse_compression);
    set(object, "restitution", contact->restitution);
    set(object, "inverse_effective_mass", contact->inverse_effective_mass);
    set(object, "end_time", contact->end_time);
    set_count(object, "sub_impact_count", contact->sub_impact_count);
    json_t *sub_impacts = set_array(object, "sub_impacts");
    for (uint32_t i = 0; i < contact->sub_impacts_listed; ++i)
        add_sub_impact(sub_impacts, &contact->sub_impacts[i]);
}

static void set_bodies_after(json_t *root, const struct percuss_reply *reply)
{
    json_t *velocities = set_array(root, "velocity_after");
    for (size_t i = 0; i < reply->velocity_after_count; ++i) {
        json_t *object = append_object(velocities);
        set_text(object, "id", reply->velocity_after[i].id);
        set_vector(object, "velocity", reply->velocity_after[i].velocity);
        set_vector(object, "angular_velocity", reply->velocity_after[i].angular_velocity);
    }
    json_t *states = set_array(root, "states_after");
    for (size_t i = 0; i < reply->states_after_count; ++i) {
        json_t *object = append_object(states);
        set_text(object, "id", reply->states_after[i].id);
        set_text(object, "state", reply->states_after[i].state);
    }
}

static void set_energy(json_t *root, const struct percuss_energy *energy)
{
    json_t *object = json_object();
    json_object_set_new(root, "energy", object);
    set(object, "available", energy->available);
    set(object, "rigid_after", energy->rigid_after);
    json_t *vibration = set_array(object, "vibration");
    for (size_t i = 0; i < energy->vibration_count; ++i) {
        json_t *body = append_object(vibration);
        set_text(body, "id", energy->vibration[i].id);
        set(body, "energy", energy->vibration[i].energy);
    }
    set(object, "damping", energy->damping);
    set(object, "plastic", energy->plastic);
    set(object, "stored", energy->stored);
    set(object, "closure", energy->closure);
}

static void set_error(json_t *root, const struct percuss_error_estimate *error)
{
    json_t *object = json_object();
    json_object_set_new(root, "error", object);
    set(object, "restitution_time", error->restitution_time);
    set(object, "restitution_modes", error->restitution_modes);
    set(object, "impulse_time", error->impulse_time);
    set(object, "impulse_modes", error->impulse_modes);
    set(object, "restitution_by_speed", error->restitution_by_speed);
    set_flag(object, "tolerance_met", error->tolerance_met);
}

static void set_model(json_t *root, const struct percuss_model *model)
{
    json_t *object = json_object();
    json_object_set_new(root, "model", object);
    json_t *bodies = set_array(object, "bodies");
    for (size_t i = 0; i < model->body_count; ++i) {
        json_t *body = append_object(bodies);
        set_text(body, "id", model->bodies[i].id);
        set_count(body, "modes", model->bodies[i].modes);
        set_flag(body, "rigid", model->bodies[i].rigid);
        set_text(body, "theory", model->bodies[i].theory);
        set(body, "shear_factor", model->bodies[i].shear_factor);
    }
    set_text(object, "contact_model", percuss_contact_model_name(model->contact_model));
    set_text(object, "compliance", percuss_compliance_name(model->compliance));
    set_text(object, "method", percuss_method_name(model->method));
    set_text(object, "reason", model->reason);
    set(object, "omitted_error", model->omitted_error);
}

static void set_header(json_t *root, const struct percuss_reply *reply)
{
    set_octets(root, "client", reply->client);
    set_count(root, "sequence", reply->sequence);
    set_octets(root, "server", reply->server);
    set_text(root, "catalogue_revision", reply->catalogue_revision);
    set_text(root, "version", reply->version);
    set_text(root, "status", percuss_status_name(reply->status));
    set_text(root, "message", reply->message);
    set_flag(root, "complete", reply->complete);
    set_text(root, "end_reason", percuss_end_reason_name(reply->end_reason));
    set(root, "window", reply->window);
}

json_t *reply_to_json(const struct percuss_reply *reply)
{
    json_t *root = json_object();
    set_header(root, reply);
    json_t *contacts = set_array(root, "contacts");
    for (size_t i = 0; i < reply->contact_count; ++i)
        add_contact(contacts, &reply->contacts[i]);
    set_text(root, "delassus_source", percuss_delassus_source_name(reply->delassus_source));
    set_bodies_after(root, reply);
    set_energy(root, &reply->energy);
    set_error(root, &reply->error);
    set_model(root, &reply->model);
    set(root, "time_shift", reply->time_shift);
    json_t *warnings = set_array(root, "warnings");
    for (size_t i = 0; i < reply->warning_count; ++i)
        json_array_append_new(warnings, json_string(reply->warnings[i]));
    json_t *timing = json_object();
    json_object_set_new(root, "timing", timing);
    set(timing, "queue", reply->timing.queue);
    set(timing, "solve", reply->timing.solve);
    return root;
}

void json_print(json_t *value)
{
    json_dumpf(value, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    putchar('\n');
    json_decref(value);
}
