/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A service as rmw_cyclonedds has it: user data pair the two topics of a service and of a client,
 * and questions and answers begin with 16 octets by which the client knows its own. */
#ifndef PERCUSS_ROS2_SERVICE_H
#define PERCUSS_ROS2_SERVICE_H

#include <dds/dds.h>
#include <stdbool.h>

enum { SERVICE_ID_SIZE = 128 };

/* "serviceid=<this participant's guid>;" for the reader of requests and the writer of replies. */
void service_name(dds_entity_t participant, dds_qos_t *qos);

/* The id in "clientid=...;" of a peer's user data, up to a zero octet. False, and empty: there is
 * none, or a longer one. */
bool service_client_id(const void *data, size_t size, char id[SERVICE_ID_SIZE]);

/* Waits up to a second until a replies' reader of the peer with the request writer `client` has
 * been matched: a reply that is written before is lost. By the id of a service's client, else by
 * the participant. False: there is none. */
bool service_await(dds_entity_t requests, dds_entity_t replies, dds_instance_handle_t client);

#endif
