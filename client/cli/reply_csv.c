/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reply_csv.h"

#include <math.h>
#include <stdio.h>

#include "csv.h"
#include "reply_table.h"

/* The id of a body of the request; empty: the reply is not of this request. */
static const char *body_of(const struct percuss_request *request, size_t contact, bool b)
{
    if (contact >= request->contact_count)
        return "";
    uint32_t body = b ? request->contacts[contact].b : request->contacts[contact].a;
    return body < request->body_count ? request->bodies[body].id : "";
}

void reply_csv_head(const char *lead, bool units)
{
    csv_head(stdout, lead, units);
    csv_head(stdout,
             "contact,a,b,restitution,error,impulse,sub_impacts,end_time,status,sub_impact,start,"
             "end,sub_impulse,peak_force,max_indentation,negligible",
             units);
    putchar('\n');
}

void reply_csv_print(const char *lead, const struct percuss_request *request,
                     const struct percuss_reply *reply)
{
    /* only its numbers are printed of one that is not there */
    const struct percuss_sub_impact none = {
        .start = NAN, .end = NAN, .impulse = NAN, .peak_force = NAN, .max_indentation = NAN};
    for (size_t c = 0; c < reply->contact_count; c++) {
        const struct percuss_contact_result *contact = &reply->contacts[c];
        for (uint32_t i = 0; i == 0 || i < contact->sub_impacts_listed; i++) {
            const bool there = i < contact->sub_impacts_listed;
            const struct percuss_sub_impact *sub = there ? &contact->sub_impacts[i] : &none;
            printf("%s%zu,", lead, c);
            csv_text(stdout, body_of(request, c, false));
            putchar(',');
            csv_text(stdout, body_of(request, c, true));
            printf(",%.17g,%.17g,%.17g,%u,%.17g,%s", contact->restitution,
                   reply_restitution_error(reply), contact->impulse, contact->sub_impact_count,
                   contact->end_time, percuss_status_name(reply->status));
            printf(",%u,%.17g,%.17g,%.17g,%.17g,%.17g,%d\n", there ? i + 1 : 0, sub->start,
                   sub->end, sub->impulse, sub->peak_force, sub->max_indentation, sub->negligible);
        }
    }
    reply_table_tell(reply);
}
