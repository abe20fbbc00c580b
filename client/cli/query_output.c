/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "query_output.h"

#include <stdio.h>

#include "ensemble_output.h"
#include "json_writer.h"
#include "reply_csv.h"
#include "reply_json.h"
#include "reply_table.h"

static void add_json(struct query_output *output, const struct impact_run *run, double speed,
                     const struct percuss_ensemble_reply *spread)
{
    json_t *reply = reply_to_json(&run->reply);
    if (spread)
        json_object_set_new(reply, "spread", ensemble_to_json(spread));
    if (!output->several) {
        json_print(reply);
        return;
    }
    json_t *answer = json_object();
    json_object_set_new(answer, "speed", json_number(speed));
    json_object_set_new(
        answer, "contact_model",
        json_string(percuss_contact_model_name(run->request.options.contact_model)));
    json_object_set_new(answer, "reply", reply);
    if (!output->answers)
        output->answers = json_array();
    json_array_append_new(output->answers, answer);
}

static void add_csv(const struct query_output *output, const struct impact_run *run, double speed)
{
    char lead[64] = "";
    if (output->several)
        snprintf(lead, sizeof lead, "%.17g,%s,", speed,
                 percuss_contact_model_name(run->request.options.contact_model));
    if (output->count == 0)
        reply_csv_head(output->several ? "speed,contact_model," : "", output->units);
    reply_csv_print(lead, &run->request, &run->reply);
}

static void add_table(const struct query_output *output, const struct impact_run *run, double speed)
{
    if (output->several)
        printf("%s%g m/s, contact model %s: ", output->count > 0 ? "\n" : "", speed,
               percuss_contact_model_name(run->request.options.contact_model));
    reply_table_print(&run->request, &run->reply, output->scene);
}

void query_output_add(struct query_output *output, const struct impact_run *run, double speed,
                      const struct percuss_ensemble_reply *spread)
{
    if (output->json)
        add_json(output, run, speed, spread);
    else if (output->csv)
        add_csv(output, run, speed);
    else
        add_table(output, run, speed);
    output->count++;
}

void query_output_end(struct query_output *output)
{
    if (output->answers)
        json_print(json_pack("{so}", "answers", output->answers));
    output->answers = NULL;
}
