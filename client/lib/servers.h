/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Which servers there are, by what they announce. */
#ifndef PERCUSS_LIB_SERVERS_H
#define PERCUSS_LIB_SERVERS_H

#include "client.h"

/* s; servers that are there are all discovered within it, but for those that hang, and where the
 * machine is busy */
#define SERVERS_SETTLING 0.2
/* s; a server that others hear of is heard of within it, or by then they know that it has gone: its
 * lease of 1.7 s, and the second until they say so */
#define SERVERS_MISSING 2.7

/* Opens the reader that servers_look needs. */
enum percuss_result servers_open(struct percuss_client *client);

/* Those that have announced themselves by now, longest up first, draining ones last. For
 * percuss_server_list_free. `known` (may be NULL): how many there are by what those hear. */
enum percuss_result servers_look(struct percuss_client *client, struct percuss_server_list *list,
                                 size_t *known);

/* Words for a server: its id, and where it runs if it has announced itself (NULL: not yet). */
void servers_describe(const uint8_t id[16], const struct percuss_server *server,
                      char text[SERVERS_NAME_SIZE]);

/* Whether its id begins as the configuration says. */
bool servers_is_wanted(const struct percuss_client *client, const uint8_t id[16]);

/* The one of that id; NULL: it is not in the list. */
const struct percuss_server *servers_find(const struct percuss_server_list *list,
                                          const uint8_t id[16]);

/* Requests that wait for each of its workers; a long computation takes all of them. INFINITY: it
 * drains. */
double servers_load(const struct percuss_server *server);

/* How many read requests, announced or not. */
size_t servers_reading(const struct percuss_client *client);

#endif
