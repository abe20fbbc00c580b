/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "html_impact.h"

#include <stdio.h>

#include "body_json.h"
#include "html_page.h"
#include "reply_json.h"
#include "request_json.h"

static void put_history(FILE *out, const char *name, const double *values, size_t count)
{
    if (!values)
        return;
    fprintf(out, ",\"%s\":", name);
    html_page_put_numbers(out, values, count);
}

static void put_histories(FILE *out, const void *context)
{
    const struct percuss_trace *trace = context;
    fputs(",\"trace\":[", out);
    for (size_t c = 0; c < trace->contact_count; c++) {
        const struct percuss_contact_trace *t = &trace->contacts[c];
        fprintf(out, "%s{\"contact\":%zu", c ? "," : "", c);
        put_history(out, "time", t->time, t->count);
        put_history(out, "force", t->force, t->count);
        put_history(out, "indentation", t->indentation, t->count);
        put_history(out, "gap", t->gap, t->count);
        put_history(out, "gap_rate", t->gap_rate, t->count);
        put_history(out, "displacement_a", t->displacement_a, t->count);
        put_history(out, "displacement_b", t->displacement_b, t->count);
        put_history(out, "force_tangential_1", t->force_tangential_1, t->count);
        put_history(out, "force_tangential_2", t->force_tangential_2, t->count);
        put_history(out, "slip_1", t->slip_1, t->count);
        put_history(out, "slip_2", t->slip_2, t->count);
        fputc('}', out);
    }
    fputc(']', out);
}

/* Of each body of the request what the catalogue says of it; null: nothing. NULL: out of memory. */
static json_t *bodies_of(const struct percuss_request *request,
                         const struct percuss_body_list *bodies)
{
    json_t *array = json_array();
    bool good = array;
    for (size_t i = 0; good && i < request->body_count; i++) {
        const struct percuss_body *body = percuss_body_find(bodies, request->bodies[i].id);
        good = json_array_append_new(array, body ? body_to_json(body) : json_null()) == 0;
    }
    if (good)
        return array;
    json_decref(array);
    return NULL;
}

int html_impact(const char *file, const struct impact_run *run,
                const struct percuss_body_list *bodies, const char *title,
                const struct common *common)
{
    json_t *data =
        json_pack("{sosososo}", "title", title ? json_text_or_null(title) : json_null(), "request",
                  request_to_json(&run->request), "reply", reply_to_json(&run->reply), "bodies",
                  bodies_of(&run->request, bodies));
    return html_page_write(file, data, put_histories, &run->trace, common);
}
