/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/table_key.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "contact/law_closed_form.h"
#include "contact/plastic.h"

/* FNV-1a, 128 bits (RFC 9923): xor an octet, multiply by 2^88 + 0x13b. */
__extension__ typedef unsigned __int128 wide;

static const double MARGIN = 1.25, DEEPEST_SHARE = 0.02;

static wide fnv_start(void)
{
    return (wide)0x6c62272e07bb0142 << 64 | 0x62b821756295c58d;
}

static void fnv_number(wide *hash, uint64_t number)
{
    const wide prime = ((wide)1 << 88) + 0x13b;
    for (int shift = 0; shift < 64; shift += 8)
        *hash = (*hash ^ (unsigned char)(number >> shift)) * prime;
}

static void fnv_doubles(wide *hash, size_t count, const double *values)
{
    fnv_number(hash, count);
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        fnv_number(hash, bits);
    }
}

static void fnv_write(wide hash, char key[TABLE_KEY_SIZE])
{
    snprintf(key, TABLE_KEY_SIZE, "%016" PRIx64 "%016" PRIx64, (uint64_t)(hash >> 64),
             (uint64_t)hash);
}

struct constants {
    double list[4];
};

static struct constants constants_of(const struct material *material)
{
    return (struct constants){
        {material->young, material->poisson, material->yield, material->tangent}};
}

bool table_same_material(const struct material *a, const struct material *b)
{
    struct constants left = constants_of(a), right = constants_of(b);
    return memcmp(&left, &right, sizeof left) == 0;
}

void table_key(const struct region_input *input, char key[TABLE_KEY_SIZE])
{
    struct constants first = constants_of(&input->materials[0]);
    struct constants second = constants_of(&input->materials[1]);
    bool in_order = memcmp(&first, &second, sizeof first) <= 0;
    const double sizes[] = {input->radius, input->indentation, (double)input->resolution};
    wide hash = fnv_start();
    fnv_number(&hash, INDENTATION_VERSION);
    fnv_doubles(&hash, 4, in_order ? first.list : second.list);
    fnv_doubles(&hash, 4, in_order ? second.list : first.list);
    fnv_doubles(&hash, 3, sizes);
    fnv_write(hash, key);
}

void table_content_key(const struct indentation_table *table, char key[TABLE_KEY_SIZE])
{
    const double errors[] = {table->hertz, table->force_error, table->residual_error,
                             table->recovery_error};
    char inputs[TABLE_KEY_SIZE];
    table_key(&table->input, inputs);
    wide hash = fnv_start();
    for (size_t i = 0; i + 1 < TABLE_KEY_SIZE; i++)
        fnv_number(&hash, (unsigned char)inputs[i]);
    fnv_doubles(&hash, 4, errors);
    fnv_doubles(&hash, table->points, table->indentation);
    fnv_doubles(&hash, table->points, table->force);
    fnv_doubles(&hash, table->points, table->radius);
    fnv_doubles(&hash, table->branches, table->largest);
    fnv_doubles(&hash, table->branches, table->largest_force);
    fnv_doubles(&hash, table->branches, table->residual);
    fnv_doubles(&hash, table->branches * INDENTATION_SAMPLES, table->recovery);
    fnv_write(hash, key);
}

void table_numbers_key(size_t lists, const size_t *counts, const double *const *values,
                       char key[TABLE_KEY_SIZE])
{
    wide hash = fnv_start();
    for (size_t i = 0; i < lists; i++)
        fnv_doubles(&hash, counts[i], values[i]);
    fnv_write(hash, key);
}

/* Indentation at which a law has absorbed an energy (J). */
static double depth_for(const struct contact_law *law, double energy, double limit)
{
    double low = 0.0, high = limit;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        bool enough = law->operations->curve->work(law, middle) > energy;
        *(enough ? &high : &low) = middle;
    }
    return high;
}

struct region_input table_input(const struct material *a, const struct material *b, double speed)
{
    const double radius = TABLE_RADIUS;
    double limit = DEEPEST_SHARE * radius;
    double modulus = hertz_effective_modulus(a, b);
    struct hertz_contact hertz = hertz_contact_make(modulus, 0.5 / radius, 0.5 / radius);
    double mass = 4.0 / 3.0 * M_PI * radius * radius * radius * fmax(a->density, b->density);
    double energy = 0.5 * mass * speed * speed;
    double depth = pow(energy / (0.4 * hertz.stiffness), 0.4);
    if (closed_form_softer(a, b) >= 0) {
        struct contact_law law = contact_law_closed_form(&hertz, a, b);
        depth = depth_for(&law, energy, limit);
    }
    return (struct region_input){.materials = {*a, *b},
                                 .radius = radius,
                                 .indentation = fmin(MARGIN * depth, limit),
                                 .resolution = TABLE_RESOLUTION};
}
