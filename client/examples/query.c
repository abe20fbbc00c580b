/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The impact of the steel sphere on the aluminium beam. Asks twice: for one speed, and for many at
 * once. Needs a percussd with the shipped catalogue; the domain may be the argument. */

#include <percuss/percuss.h>
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

/* Asked some ten times a second while a call waits; says after 2 s that a server is looked for. */
static bool wait_on(void *context)
{
    unsigned *asked = context;
    if (++*asked == 20)
        fputs("looking for a percussd ...\n", stderr);
    return true; /* false gives it up */
}

/* A sphere of 15 mm just touches the top of a beam of 10 mm radius at a quarter of its length. */
static void describe(struct percuss_request *request, double speed)
{
    percuss_request_init(request);
    struct percuss_body_motion *sphere = percuss_request_add_body(request, "steel-sphere");
    sphere->position[0] = -0.25;
    sphere->position[2] = 0.010 + 0.015;
    sphere->velocity[2] = -speed;
    percuss_request_add_body(request, "al-beam"); /* at the origin along x, at rest */
    struct percuss_contact *contact = percuss_request_add_contact(request, 0, 1);
    contact->point[0] = -0.25;
    contact->point[2] = 0.010;
    contact->normal[2] = 1.0; /* from b, the beam, to a, the sphere */
    request->options.tolerance = 1e-4;
}

static void print(const struct percuss_reply *reply)
{
    /* a refusal is an answer too: its message names the wrong field and the allowed values */
    if (reply->status != PERCUSS_OK)
        printf("%s: %s\n", percuss_status_name(reply->status), reply->message);
    for (size_t i = 0; i < reply->contact_count; i++) {
        const struct percuss_contact_result *contact = &reply->contacts[i];
        printf("e = %.5f, impulse %.5f N s\n", contact->restitution, contact->impulse);
        for (uint32_t j = 0; j < contact->sub_impacts_listed; j++)
            printf("  from %7.4f to %7.4f ms: %.5f N s\n", 1e3 * contact->sub_impacts[j].start,
                   1e3 * contact->sub_impacts[j].end, contact->sub_impacts[j].impulse);
    }
}

int main(int argc, char **argv)
{
    struct percuss_client_config config = percuss_client_config_default();
    if (argc > 1) /* else that of PERCUSS_DOMAIN, or 0 */
        config.domain = (uint32_t)atoi(argv[1]);
    struct percuss_client *client;
    struct percuss_request request;
    struct percuss_reply reply;
    check(percuss_client_create(&config, &client));
    unsigned asked = 0;
    percuss_client_watch(client, wait_on, &asked);
    check(percuss_client_connect(client, 3.0));
    percuss_client_watch(client, NULL, NULL);

    /* one question, waited for */
    describe(&request, 0.3);
    check(percuss_solve(client, &request, 10.0, &reply));
    print(&reply);
    percuss_reply_free(&reply);

    /* many questions; replies come in any order, reply.sequence says which question it was */
    for (int i = 1; i <= 4; i++) {
        describe(&request, 0.1 * i);
        check(percuss_submit(client, &request, NULL));
    }
    for (int i = 1; i <= 4; i++) {
        check(percuss_wait(client, 0, 10.0, &reply));
        printf("question %llu: ", (unsigned long long)reply.sequence);
        print(&reply);
        percuss_reply_free(&reply);
    }
    percuss_client_free(client);
    return EXIT_SUCCESS;
}
