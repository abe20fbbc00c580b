/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reply_table.h"

#include <math.h>
#include <stdio.h>

#include "others.h"

double reply_restitution_error(const struct percuss_reply *reply)
{
    return fabs(reply->error.restitution_time) + fabs(reply->error.restitution_modes);
}

double reply_total_error(const struct percuss_reply *reply)
{
    const double total = reply->error.restitution_total;
    bool known = total >= reply_restitution_error(reply) || reply->error.restitution_model > 0.0;
    return known ? total : NAN;
}

unsigned reply_significant(const struct percuss_contact_result *contact)
{
    unsigned count = 0;
    for (uint32_t i = 0; i < contact->sub_impacts_listed; i++)
        count += !contact->sub_impacts[i].negligible;
    return count;
}

/* "a on b" of the i-th contact. */
static void print_title(const struct percuss_request *request, size_t i)
{
    const struct percuss_contact *contact = &request->contacts[i];
    if (i < request->contact_count && contact->a < request->body_count &&
        contact->b < request->body_count)
        printf("%s on %s\n", request->bodies[contact->a].id, request->bodies[contact->b].id);
}

static void cross(const double a[3], const double b[3], double result[3])
{
    for (int i = 0; i < 3; i++)
        result[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

bool reply_has_friction(const struct percuss_reply *reply)
{
    bool has = false;
    for (size_t i = 0; i < reply->contact_count; i++)
        has = has || reply->contacts[i].friction > 0.0;
    return has;
}

/* How fast A's point approaches B's along the normal, and how fast it moves along the surface. */
struct meeting {
    double approach, slip; /* m/s */
};

static struct meeting meeting_of(const struct percuss_request *request,
                                 const struct percuss_contact *contact)
{
    double relative[3] = {0.0}, rate = 0.0, square = 0.0;
    for (int which = 0; which < 2; which++) {
        const struct percuss_body_motion *body =
            &request->bodies[which == 0 ? contact->a : contact->b];
        double arm[3], turning[3];
        for (int i = 0; i < 3; i++)
            arm[i] = contact->point[i] - body->position[i];
        cross(body->angular_velocity, arm, turning);
        for (int i = 0; i < 3; i++)
            relative[i] += (which == 0 ? 1.0 : -1.0) * (body->velocity[i] + turning[i]);
    }
    for (int i = 0; i < 3; i++)
        rate += contact->normal[i] * relative[i];
    for (int i = 0; i < 3; i++)
        square += pow(relative[i] - rate * contact->normal[i], 2.0);
    return (struct meeting){0.0 - rate, sqrt(square)}; /* never -0 */
}

/* Share of the approach below which a slip is rounding. */
static const double NO_SLIP = 1e-9;

/* The question: speed, place, ends and materials. */
static void print_question(const struct percuss_request *request, size_t i,
                           const struct scene_text *scene)
{
    const struct percuss_contact *contact = &request->contacts[i];
    if (i >= request->contact_count || contact->a >= request->body_count ||
        contact->b >= request->body_count)
        return;
    const struct meeting meeting = meeting_of(request, contact);
    printf("  impact       %.6g m/s", meeting.approach);
    if (!scene)
        printf(" at (%.4g, %.4g, %.4g) m", contact->point[0], contact->point[1], contact->point[2]);
    else
        printf("%s%s", scene->place[0] ? ", " : "", scene->place);
    if (meeting.slip > NO_SLIP * fabs(meeting.approach))
        printf(", sliding at %.6g m/s", meeting.slip);
    putchar('\n');
    if (scene)
        printf("  bodies       %s\n", scene->bodies);
}

/* Of two parts of a pair, below which the second is rounding. */
static const double NO_SECOND = 1e-9;

/* A pair along both tangents; one number where there is nothing along the second. */
struct pair_text {
    char text[48];
};

static struct pair_text pair_of(const double pair[2])
{
    struct pair_text text;
    snprintf(text.text, sizeof text.text,
             fabs(pair[1]) <= NO_SECOND * fabs(pair[0]) ? "%.6g" : "(%.6g, %.6g)", pair[0],
             pair[1]);
    return text;
}

/* 0 where it is rounding beside `scale`. */
static double settled(double value, double scale)
{
    return fabs(value) <= NO_SLIP * scale ? 0.0 : value;
}

/* What friction does in a contact that has it. */
static void print_friction(const struct percuss_contact_result *contact)
{
    if (!(contact->friction > 0.0))
        return;
    printf("  friction     %g, %s\n", contact->friction,
           percuss_friction_state_name(contact->friction_state));
    printf("  tangential   %s N s", pair_of(contact->impulse_tangential).text);
    if (contact->impulse_tangential_error > 0.0)
        printf(" +- %.2g", contact->impulse_tangential_error);
    const double before = hypot(contact->slip_before[0], contact->slip_before[1]);
    const double after[2] = {settled(contact->slip_after[0], before),
                             settled(contact->slip_after[1], before)};
    printf("\n  slip         %s m/s, after it %s m/s", pair_of(contact->slip_before).text,
           pair_of(after).text);
    if (!isnan(contact->tangential_restitution))
        printf("  (tangential restitution %.6g)", settled(contact->tangential_restitution, 1.0));
    putchar('\n');
    /* the restitution by impulses may be above 1 where friction turns a body */
    if (!isnan(contact->restitution_kinematic))
        printf("  kinematic    %.6g is the restitution by the rates of the gap",
               contact->restitution_kinematic);
    if (!isnan(contact->restitution_energetic))
        printf(", %.6g by the work of the force", contact->restitution_energetic);
    if (!isnan(contact->restitution_kinematic) || !isnan(contact->restitution_energetic))
        putchar('\n');
}

/* Of a longer list the negligible ones are left out. */
enum { LONG_LIST = 40 };

static void print_sub_impacts(const struct percuss_contact_result *contact)
{
    /* a long list goes without its negligible ones */
    unsigned hidden = contact->sub_impacts_listed > LONG_LIST
                          ? contact->sub_impacts_listed - reply_significant(contact)
                          : 0;
    if (contact->sub_impacts_listed == 0)
        return;
    printf("\n  %4s %10s %10s %13s %8s %10s %12s", "#", "start/ms", "length/us", "impulse/N s",
           "share/%", "peak/N", "indent./um");
    printf(contact->friction > 0.0 ? " %15s  %s\n" : "\n", "tangential/N s", "slip");
    for (uint32_t i = 0; i < contact->sub_impacts_listed; i++) {
        const struct percuss_sub_impact *sub = &contact->sub_impacts[i];
        if (hidden && sub->negligible)
            continue;
        printf("  %4u %10.4f %10.2f %13.6g %8.2f %10.4g %12.4g", i + 1, 1e3 * sub->start,
               1e6 * (sub->end - sub->start), sub->impulse, 100.0 * sub->impulse / contact->impulse,
               sub->peak_force, 1e6 * sub->max_indentation);
        if (contact->friction > 0.0)
            printf(" %15s  %s", pair_of(sub->impulse_tangential).text,
                   percuss_friction_state_name(sub->friction_state));
        puts(sub->negligible ? "  negligible" : "");
    }
    /* the hidden sub-impacts */
    if (hidden)
        printf("  ... and %u negligible ones (--json lists them)\n", hidden);
    if (contact->sub_impacts_listed < contact->sub_impact_count)
        printf("  ... %u more\n", contact->sub_impact_count - contact->sub_impacts_listed);
}

/* Where an unstated yield makes so much of the error, its rest is told. */
static const double ELASTIC_SHARE = 0.9;

/* With all that is known to be wrong with it, and the parts of that. */
static void print_restitution(const struct percuss_reply *reply, double restitution)
{
    double numerical = reply_restitution_error(reply);
    double total = reply_total_error(reply);
    bool whole = !isnan(total);
    printf("  restitution  %.6g +- %.2g  (the model ", restitution, whole ? total : numerical);
    if (whole)
        printf("%.2g", reply->error.restitution_model);
    else
        printf("not known");
    printf(", modes and steps %.1g)\n", numerical);
    double elastic = total - reply->error.restitution_yield;
    if (whole && elastic < ELASTIC_SHARE * total)
        printf("               +- %.2g if metals whose yield is not stated stay elastic\n",
               elastic);
}

static void print_contact(const struct percuss_reply *reply,
                          const struct percuss_contact_result *contact)
{
    print_restitution(reply, contact->restitution);
    printf("  impulse      %.6g N s", contact->impulse);
    /* a group's restitution is as wrong as its worst contact's */
    if (reply->contact_count > 1 && contact->impulse_error > 0.0)
        printf(" +- %.2g", contact->impulse_error);
    printf("  (%.6g N s stops the approach)\n", contact->impulse_compression);
    print_friction(contact);
    printf("  duration     %.4g ms (%s)\n", 1e3 * contact->end_time,
           percuss_end_reason_name(reply->end_reason));
    printf("  sub-impacts  %u", contact->sub_impact_count);
    unsigned significant = reply_significant(contact);
    if (significant < contact->sub_impacts_listed)
        printf(", %u of them significant", significant);
    putchar('\n');
    print_sub_impacts(contact);
}

static void print_share(const char *name, double energy, double available)
{
    if (energy != 0.0)
        printf(", %s %.2f %%", name, 100.0 * energy / available);
}

static void print_energy(const struct percuss_energy *energy)
{
    printf("\n  energy       %.5g J available: rigid motion %.2f %%", energy->available,
           100.0 * energy->rigid_after / energy->available);
    for (size_t i = 0; i < energy->vibration_count; i++) {
        char name[PERCUSS_ID_SIZE + 16];
        snprintf(name, sizeof name, "vibration of %s", energy->vibration[i].id);
        print_share(name, energy->vibration[i].energy, energy->available);
    }
    print_share("damping", energy->damping, energy->available);
    print_share("plastic", energy->plastic, energy->available);
    print_share("friction", energy->friction, energy->available);
    print_share("stored", energy->stored, energy->available);
    printf(" (closure %.0e)\n", energy->closure / energy->available);
}

static void print_model(const struct percuss_model *model)
{
    printf("  model        %s contact, %s compliance, %s method",
           percuss_contact_model_name(model->contact_model),
           percuss_compliance_name(model->compliance), percuss_method_name(model->method));
    for (size_t i = 0; i < model->body_count; i++) {
        const struct percuss_body_model *body = &model->bodies[i];
        if (body->rigid)
            printf("; %s rigid", body->id);
        else
            printf("; %s %s, %u modes", body->id, body->theory, body->modes);
    }
    putchar('\n');
    if (model->reason[0])
        printf("               %s\n", model->reason);
    if (model->omitted_error > 0.0)
        printf("               what was left out changes the restitution by about %.1g\n",
               model->omitted_error);
}

void reply_table_tell(const struct percuss_reply *reply)
{
    if (reply->status != PERCUSS_OK)
        complain("%s: %s", percuss_status_name(reply->status), reply->message);
    for (size_t i = 0; i < reply->warning_count; i++)
        complain("warning: %s", reply->warnings[i]);
}

void reply_table_print(const struct percuss_request *request, const struct percuss_reply *reply,
                       const struct scene_text *scene)
{
    for (size_t i = 0; i < reply->contact_count; i++) {
        print_title(request, i);
        print_question(request, i, scene);
        print_contact(reply, &reply->contacts[i]);
    }
    if (reply->contact_count > 0) {
        print_energy(&reply->energy);
        print_model(&reply->model);
        print_server_line(reply->server, reply->catalogue_revision);
    }
    if (reply->time_shift != 0.0 && !isnan(reply->time_shift))
        printf("  time shift   %.4g us\n", 1e6 * reply->time_shift);
    reply_table_tell(reply);
}
