/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The catalogue that percuss-ros2 announces, as the two tables of `percuss bodies --csv` without
 * their heads, `--pairs` after an empty line; last the places with names. Waits for a list that is
 * not of the catalogue with the revision BEFORE, and prints its own on the standard error.
 *
 * usage: ros2_bodies DOMAIN [BEFORE]; exit code 1: none is announced */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "percuss_msgs.h"
#include "wire.h"

enum { MILLISECONDS = 20000 };

static void text(const char *words)
{
    printf(strchr(words, ',') ? "\"%s\"," : "%s,", words);
}

static void print_body(const percuss_msgs_msg_dds__Body_ *body)
{
    const geometry_msgs_msg_dds__Vector3_ *half = &body->half_extents;
    text(body->id);
    text(body->shape);
    text(body->material);
    printf("%.17g,%.17g,%.17g,%.17g,%.17g", body->mass, half->x, half->y, half->z,
           body->tip_radius);
    for (int i = 0; i < 8; i++)
        printf(",%.17g",
               i == percuss_msgs_msg_dds__Override_RADIUS ? body->radius : body->parameters[i]);
    putchar(',');
    text(body->description);
    printf("%.17g,%.17g,", body->loss_factor, body->loss_frequency);
    for (uint32_t i = 0; i < body->relaxation._length; i++)
        printf("%s%.17g %.17g", i ? "; " : "", body->relaxation._buffer[i].share,
               body->relaxation._buffer[i].time);
    printf(",%.17g,%.17g,%.17g\n", body->rate_reference, body->rate_exponent,
           body->rate_coefficient);
}

static void print_pair(const percuss_msgs_msg_dds__MaterialPair_ *pair)
{
    const percuss_msgs_msg_dds__ContactLaw_ *law = &pair->law;
    text(pair->material_a);
    text(pair->material_b);
    printf("%.17g,%.17g,", pair->friction, pair->friction_deviation);
    text(law->name);
    text(law->kind);
    printf("%.17g,%.17g,%.17g,%.17g,%.17g,", law->stiffness, law->exponent, law->hysteresis,
           law->dissipation, law->deviation);
    text(law->points);
    printf("%u,%.17g,%.17g,", law->point_count, law->max_indentation, law->max_force);
    text(law->unloading);
    printf("%.17g\n", law->residual_indentation);
}

static void print_sites(const percuss_msgs_msg_dds__Body_ *body)
{
    for (uint32_t i = 0; i < body->sites._length; i++) {
        const percuss_msgs_msg_dds__BodySite_ *site = &body->sites._buffer[i];
        printf("%s %s %.17g %.17g %.17g %.17g %.17g %.17g\n", body->id, site->name, site->point.x,
               site->point.y, site->point.z, site->normal.x, site->normal.y, site->normal.z);
    }
}

static void print(const percuss_msgs_msg_dds__BodyList_ *list)
{
    for (uint32_t i = 0; i < list->bodies._length; i++)
        print_body(&list->bodies._buffer[i]);
    putchar('\n');
    for (uint32_t i = 0; i < list->pairs._length; i++)
        print_pair(&list->pairs._buffer[i]);
    putchar('\n');
    for (uint32_t i = 0; i < list->bodies._length; i++) {
        const percuss_msgs_msg_dds__Body_ *body = &list->bodies._buffer[i];
        printf("%s %u %u\n", body->id, body->end_supports[0], body->end_supports[1]);
        print_sites(body);
    }
    fprintf(stderr, "%s\n", list->catalogue_revision);
}

int main(int argc, char **argv)
{
    void *sample = NULL;
    dds_sample_info_t info;
    bool found = false;
    if (argc < 2)
        return 2;
    dds_entity_t participant = wire_participant_create((uint32_t)strtoul(argv[1], NULL, 10));
    dds_qos_t *qos = wire_qos_announcement(NULL);
    dds_entity_t topic = dds_create_topic(participant, &percuss_msgs_msg_dds__BodyList__desc,
                                          "rt/percuss/bodies", NULL, NULL);
    dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
    dds_delete_qos(qos);
    for (int i = 0; i < MILLISECONDS && !found; i++) {
        if (dds_take(reader, &sample, &info, 1, 1) == 1) {
            const percuss_msgs_msg_dds__BodyList_ *list = sample;
            found = info.valid_data && (argc < 3 || strcmp(list->catalogue_revision, argv[2]) != 0);
            if (found)
                print(list);
            dds_return_loan(reader, &sample, 1);
        }
        dds_sleepfor(DDS_MSECS(1));
    }
    dds_delete(participant);
    return found ? EXIT_SUCCESS : EXIT_FAILURE;
}
