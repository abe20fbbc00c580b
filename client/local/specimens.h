/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Specimens: their dents come from the store, and those of an impact are durable before its reply
 * is seen. Replies are not kept: an impact that is asked for again is another one. */
#ifndef PERCUSS_LOCAL_SPECIMENS_H
#define PERCUSS_LOCAL_SPECIMENS_H

#include "desk.h"

/* Whether a question concerns the store. */
bool specimens_concern(const struct percuss_client *client, const struct question *question);

/* As responder_answer, at a desk. */
struct answer *specimens_answer(struct percuss_client *client, struct desk *desk,
                                const struct question *question);

#endif
