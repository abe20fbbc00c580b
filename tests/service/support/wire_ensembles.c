/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Ensembles on the wire: bad ones are refused by field, a good one is answered, and answered with
 * the same bytes when it is asked again. usage: wire_ensembles DOMAIN */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

static struct scene scene;
static uint64_t sequence;

/* An ensemble of the example with two inputs. */
struct ensemble {
    percuss_v1_EnsembleInput inputs[2];
    percuss_v1_EnsembleCorrelation correlation;
    double quantile, values[2];
    percuss_v1_EnsembleRequest request;
};

static struct ensemble good(void)
{
    struct ensemble e = {
        .inputs = {{.name = "speed",
                    .distribution = percuss_v1_DISTRIBUTION_UNIFORM,
                    .first = 0.1,
                    .second = 0.4,
                    .lower = NAN,
                    .upper = NAN},
                   {.name = "young",
                    .body = "al-beam",
                    .distribution = percuss_v1_DISTRIBUTION_NORMAL,
                    .first = 70e9,
                    .second = 1e9,
                    .lower = NAN,
                    .upper = NAN}},
        .correlation = {0, 1, 0.5},
        .quantile = 0.5,
        .values = {0.1, 0.2},
        .request = {.samples = 20, .seed = 5},
    };
    return e;
}

/* Sends it and returns the reply, to be given back. */
static const percuss_v1_EnsembleReply *ask(struct peer *peer, struct ensemble *e)
{
    percuss_v1_EnsembleRequest *request = &e->request;
    request->scene = scene.request;
    request->inputs._buffer = e->inputs;
    request->inputs._length = request->inputs._maximum = 2;
    request->quantiles._buffer = &e->quantile;
    request->quantiles._length = request->quantiles._maximum = 1;
    if (request->correlations._length)
        request->correlations._buffer = &e->correlation;
    peer_send_ensemble(peer, request);
    return peer_receive(peer, PEER_ENSEMBLE, 20.0);
}

static void refused(struct peer *peer, struct ensemble e, const char *words)
{
    e.request.sequence = ++sequence;
    const percuss_v1_EnsembleReply *reply = ask(peer, &e);
    REQUIRE(reply->sequence == sequence && reply->status == percuss_v1_STATUS_BAD_REQUEST &&
                strstr(reply->message, words) && reply->statistics._length == 0,
            "'%s' expected; status %u: %s", words, reply->status, reply->message);
    peer_return(peer, PEER_ENSEMBLE, reply);
}

static void bad_inputs(struct peer *peer)
{
    struct ensemble e = good();
    strcpy(e.inputs[1].name, "colour");
    refused(peer, e, "inputs[1].name: 'colour'");
    e = good();
    strcpy(e.inputs[1].body, "no-such-body");
    refused(peer, e, "inputs[1].body: 'no-such-body'");
    e = good();
    strcpy(e.inputs[0].body, "al-beam");
    refused(peer, e, "inputs[0].body: 'al-beam'");
    e = good();
    e.inputs[0].distribution = 77;
    refused(peer, e, "inputs[0].distribution: 77");
    e = good();
    e.inputs[0].first = NAN;
    refused(peer, e, "inputs[0].first: nan");
    e = good();
    e.inputs[1].second = INFINITY;
    refused(peer, e, "inputs[1].second: inf");
    e = good();
    e.inputs[1].lower = 80e9;
    e.inputs[1].upper = 90e9;
    e.inputs[1].second = 1.0;
    refused(peer, e, "truncation");
    e = good();
    e.inputs[0].distribution = percuss_v1_DISTRIBUTION_LIST;
    refused(peer, e, "inputs[0].values: none given");
    e = good();
    strcpy(e.inputs[1].body, "steel-sphere");
    strcpy(e.inputs[1].name, "site");
    e.inputs[1].first = 0.5;
    e.inputs[1].second = 0.1;
    refused(peer, e, "steel-sphere: must be a beam");
}

/* Inputs change every body of their id: with one that stands idle also the one that is struck. */
static void tables_of_twins(struct peer *peer)
{
    struct ensemble e = good();
    scene_fill(&scene, 1, 0.3);
    percuss_v1_BodyMotion *idle = &scene.bodies[1], *struck = &scene.bodies[2];
    snprintf(idle->id, sizeof idle->id, "al-rod-1");
    idle->position[2] = 0.010 - 0.5;
    idle->orientation[0] = sqrt(0.5);
    idle->orientation[2] = -sqrt(0.5);
    *struck = *idle;
    idle->position[0] = 1.0;
    scene.contacts[0].b = 2;
    scene.request.bodies._length = 3;
    scene.request.options.contact_model = percuss_v1_CONTACT_MODEL_TABLE;
    strcpy(e.inputs[1].body, "al-rod-1");
    refused(peer, e, "inputs[1].name: young: must be another one with options.contact_model table");
    scene_fill(&scene, 1, 0.3);
}

static void bad_numbers(struct peer *peer)
{
    struct ensemble e = good();
    e.request.samples = UINT64_MAX;
    refused(peer, e, "samples: 18446744073709551615");
    e = good();
    e.request.samples = 0;
    refused(peer, e, "samples: 0");
    e = good();
    e.request.sampling = 9;
    refused(peer, e, "sampling: 9");
    e = good();
    e.quantile = 1.5;
    refused(peer, e, "quantiles[0]: 1.5");
    e = good();
    e.request.bins = 4000000000u;
    refused(peer, e, "bins: 4000000000");
    e = good();
    e.request.contact = 7;
    refused(peer, e, "contact: 7");
    e = good();
    e.request.half_width = -INFINITY;
    refused(peer, e, "half_width: -inf");
    e = good();
    e.request.correlations._length = e.request.correlations._maximum = 1;
    e.correlation.coefficient = 2.0;
    refused(peer, e, "correlations[0].coefficient: 2");
    e.correlation = (percuss_v1_EnsembleCorrelation){0, 900, 0.5};
    refused(peer, e, "correlations[0]: inputs 0 and 900");
    scene.request.options.tolerance = -1.0;
    refused(peer, good(), "options.tolerance: -1");
    scene.request.options.tolerance = 0.0;
    strcpy(scene.bodies[1].state, "0123");
    refused(peer, good(), "scene.bodies[1].state: 0123");
    scene.bodies[1].state[0] = '\0';
    strcpy(scene.bodies[1].specimen, "bar-1");
    refused(peer, good(), "scene.bodies[1].specimen: bar-1: must be empty");
    scene.bodies[1].specimen[0] = '\0';
}

static void answered(struct peer *peer)
{
    struct ensemble e = good();
    e.request.sequence = ++sequence;
    e.request.correlations._length = e.request.correlations._maximum = 1;
    const percuss_v1_EnsembleReply *reply = ask(peer, &e);
    REQUIRE(reply->status == percuss_v1_STATUS_OK && reply->complete && reply->samples == 20 &&
                reply->statistics._length == 4 && reply->sensitivities._length == 2,
            "status %u: %s", reply->status, reply->message);
    double mean = reply->statistics._buffer[0].mean, solve = reply->timing.solve;
    REQUIRE(mean > 0.05 && mean < 0.8, "mean %g", mean);
    peer_return(peer, PEER_ENSEMBLE, reply);
    /* the same again is the stored reply, its timing included */
    reply = ask(peer, &e);
    REQUIRE(reply->statistics._buffer[0].mean == mean && reply->timing.solve == solve,
            "mean %.17g, not %.17g", reply->statistics._buffer[0].mean, mean);
    peer_return(peer, PEER_ENSEMBLE, reply);
    /* the number is taken */
    e.request.seed = 6;
    reply = ask(peer, &e);
    REQUIRE(reply->status == percuss_v1_STATUS_BAD_REQUEST &&
                strstr(reply->message, "was used for another request"),
            "status %u: %s", reply->status, reply->message);
    peer_return(peer, PEER_ENSEMBLE, reply);
    e.request.cancel = true;
    e.request.sequence = 4711;
    peer_send_ensemble(peer, &e.request);
    REQUIRE(!peer_hears(peer, PEER_ENSEMBLE, 0.3), "an answer to a cancel of nothing");
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: wire_ensembles DOMAIN\n");
        return 2;
    }
    struct peer peer;
    peer_open(&peer, (uint32_t)strtoul(argv[1], NULL, 10));
    scene_fill(&scene, 1, 0.3);
    bad_inputs(&peer);
    tables_of_twins(&peer);
    bad_numbers(&peer);
    answered(&peer);
    peer_close(&peer);
    printf("%llu ensembles got what they should\n", (unsigned long long)sequence);
    return EXIT_SUCCESS;
}
