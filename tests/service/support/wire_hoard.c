/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests of which no two have a body in common, so that all that the daemon keeps of one is of no
 * use to the next: beams and rods of any stiffness with many modes, blocks of any Poisson's ratio,
 * half of them with histories. The catalogue has a "block" of 0.1 m, 0.02 m, 0.02 m.
 * usage: wire_hoard DOMAIN COUNT SEED */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

enum { WINDOW = 32 };
static const double patience = 120.0; /* s; only a hang lasts so long */

/* 0..1, another one for each number (splitmix64). */
static double draw(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static void fill(struct scene *scene, percuss_v1_Override overrides[2], uint64_t sequence,
                 uint64_t *state)
{
    static const char *const bodies[] = {"al-beam", "al-rod", "block"};
    const double which = draw(state);
    const int kind = which < 0.6 ? 0 : which < 0.97 ? 1 : 2; /* a block takes longest */
    scene_fill(scene, sequence, 0.1 + 0.3 * draw(state));
    percuss_v1_BodyMotion *body = &scene->bodies[1];
    snprintf(body->id, sizeof body->id, "%s", bodies[kind]);
    overrides[0] = (percuss_v1_Override){percuss_v1_PARAMETER_YOUNG, 5e10 + 3e10 * draw(state)};
    overrides[1] = (percuss_v1_Override){percuss_v1_PARAMETER_POISSON, 0.2 + 0.2 * draw(state)};
    body->overrides._buffer = overrides;
    body->overrides._length = body->overrides._maximum = 2;
    if (kind == 1) {
        /* upright, hit on its upper end */
        body->position[2] = 0.010 - 0.5;
        body->orientation[0] = sqrt(0.5);
        body->orientation[2] = -sqrt(0.5);
    } else if (kind == 0) {
        scene->contacts[0].point[0] = scene->bodies[0].position[0] = 0.4 * draw(state);
    }
    scene->request.options.tolerance = kind == 2 ? 1e-2 : pow(10.0, -4.0 - 3.0 * draw(state));
    scene->request.options.trace = draw(state) < 0.5;
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: wire_hoard DOMAIN COUNT SEED\n");
        return 2;
    }
    static struct peer peer;
    static struct scene scene;
    const unsigned long count = strtoul(argv[2], NULL, 10);
    uint64_t state = strtoull(argv[3], NULL, 10);
    unsigned long sent = 0, solved = 0;
    percuss_v1_Override overrides[2];
    peer_open(&peer, (uint32_t)strtoul(argv[1], NULL, 10));
    for (unsigned long done = 0; done < count; done++) {
        for (; sent < count && sent - done < WINDOW; sent++) {
            fill(&scene, overrides, sent + 1, &state);
            peer_send(&peer, &scene.request);
        }
        const percuss_v1_Reply *reply = peer_receive(&peer, PEER_SINGLE, patience);
        solved +=
            reply->status == percuss_v1_STATUS_OK || reply->status == percuss_v1_STATUS_TRUNCATED;
        peer_return(&peer, PEER_SINGLE, reply);
    }
    printf("%lu of %lu solved\n", solved, count);
    peer_close(&peer);
    return EXIT_SUCCESS;
}
