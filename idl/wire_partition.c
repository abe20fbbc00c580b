/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_partition.h"

#include <stdio.h>
#include <string.h>

enum { DIGITS = 2, DIGITS_END = 34 }; /* of a client's id in the name */

bool wire_partition_is_good(const char *name)
{
    static const char allowed[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                  "0123456789._-";
    size_t length = strspn(name, allowed);
    return length > 0 && length < WIRE_PARTITION_SIZE && !name[length];
}

void wire_partition_of_replies(const uint8_t client[16], const char *partition,
                               char name[WIRE_REPLIES_SIZE])
{
    name[0] = 'c';
    name[1] = '_';
    for (int i = 0; i < 16; i++)
        snprintf(name + DIGITS + 2 * i, 3, "%02x", client[i]);
    if (partition && *partition)
        snprintf(name + DIGITS_END, WIRE_REPLIES_SIZE - DIGITS_END, ".%s", partition);
}
