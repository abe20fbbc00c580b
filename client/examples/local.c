/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The impact of the steel sphere on the end of the aluminium rod, by the solver in this process: no
 * percussd is needed. Arguments: a catalogue, and the bodies' names there. */

#include <percuss/local.h>
#include <stdio.h>
#include <stdlib.h>

/* Every call returns PERCUSS_RESULT_OK or leaves an error text. */
static void check(enum percuss_result result)
{
    if (result == PERCUSS_RESULT_OK)
        return;
    fprintf(stderr, "%s: %s\n", percuss_result_text(result), percuss_error_text());
    exit(EXIT_FAILURE);
}

/* A name that the catalogue does not have: NULL, and the text says which one is similar. */
static const struct percuss_body *find(const struct percuss_body_list *bodies, const char *id)
{
    const struct percuss_body *body = percuss_body_find(bodies, id);
    if (!body)
        check(PERCUSS_RESULT_INVALID_ARGUMENT);
    return body;
}

int main(int argc, char **argv)
{
    struct percuss_local_config config = percuss_local_config_default();
    if (argc > 1)
        config.catalogue = argv[1];
    struct percuss_client *client;
    struct percuss_body_list bodies;
    struct percuss_request request;
    struct percuss_reply reply;
    check(percuss_local_open(&config, &client));
    check(percuss_bodies(client, 1.0, &bodies));

    /* from here on all is as with a server */
    struct percuss_pair pair =
        percuss_pair_default(find(&bodies, argc > 2 ? argv[2] : "steel-sphere"),
                             find(&bodies, argc > 3 ? argv[3] : "al-rod"));
    for (pair.speed = 0.1; pair.speed < 0.45; pair.speed += 0.1) {
        check(percuss_contact_pair(&pair, &request));
        check(percuss_solve(client, &request, 10.0, &reply));
        if (reply.status == PERCUSS_OK)
            printf("%.1f m/s: e = %.5f, impulse %.5f N s\n", pair.speed,
                   reply.contacts[0].restitution, reply.contacts[0].impulse);
        else
            printf("%s: %s\n", percuss_status_name(reply.status), reply.message);
        percuss_reply_free(&reply);
    }
    percuss_body_list_free(&bodies);
    percuss_client_free(client);
    return EXIT_SUCCESS;
}
