/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ask.h"

#include <stdio.h>
#include <string.h>

#include "say.h"
#include "take.h"

static const double PATIENCE = 3.0; /* s for a server to appear; discovery takes 0.1 s */

unsigned ask_connections(struct ask_line *line)
{
    pthread_mutex_lock(&line->lock);
    unsigned count = line->connections;
    pthread_mutex_unlock(&line->lock);
    return count;
}

bool ask_connect(struct ask_line *line, unsigned seen)
{
    unsigned failures = atomic_load(&line->failures);
    pthread_mutex_lock(&line->lock);
    /* another thread may have connected meanwhile, or tried in vain */
    if (line->connections == seen && atomic_load(&line->failures) == failures) {
        if (percuss_client_connect(line->client, PATIENCE) == PERCUSS_RESULT_OK) {
            line->connections++;
            say("connected to a percussd in domain %u", line->domain);
        } else {
            atomic_fetch_add(&line->failures, 1);
        }
    }
    bool connected = line->connections > seen;
    pthread_mutex_unlock(&line->lock);
    return connected;
}

static uint32_t status_of(enum percuss_result result)
{
    switch (result) {
    case PERCUSS_RESULT_INVALID_ARGUMENT:
        return PERCUSS_BAD_REQUEST;
    case PERCUSS_RESULT_TIMEOUT:
        return PERCUSS_TIMEOUT;
    case PERCUSS_RESULT_WINDOW_FULL:
        return PERCUSS_BUSY;
    case PERCUSS_RESULT_NO_SERVER:
    case PERCUSS_RESULT_INCOMPATIBLE:
        return percuss_msgs_msg_dds__Answer_STATUS_NO_SERVER;
    default:
        return PERCUSS_INTERNAL;
    }
}

static void refuse(struct ask *ask, uint32_t status, const char *message)
{
    snprintf(ask->message, sizeof ask->message, "%s", message);
    give_refusal(status, ask->message, &ask->answer);
}

void ask_answer(struct ask_line *line, struct ask *ask,
                const percuss_msgs_msg_dds__Question_ *question)
{
    char problem[TAKE_PROBLEM_SIZE];
    if (!take_question(question, &ask->request, problem)) {
        refuse(ask, PERCUSS_BAD_REQUEST, problem);
        return;
    }
    ask->request.sequence = atomic_fetch_add(&line->sequence, 1) + 1;
    unsigned seen = ask_connections(line);
    const double timeout = line->timeout;
    enum percuss_result result = PERCUSS_RESULT_NO_SERVER;
    if (seen > 0)
        result = percuss_solve(line->client, &ask->request, timeout, &ask->reply);
    /* one that has gone may have been started again, and knows by the number what it has answered
     */
    if (result == PERCUSS_RESULT_NO_SERVER && ask_connect(line, seen))
        result = percuss_solve(line->client, &ask->request, timeout, &ask->reply);
    if (result == PERCUSS_RESULT_NO_SERVER) {
        snprintf(problem, sizeof problem, "no percussd answers in DDS domain %u", line->domain);
        refuse(ask, status_of(result), problem);
    } else if (result != PERCUSS_RESULT_OK)
        refuse(ask, status_of(result), percuss_error_text());
    else if (!give_answer(&ask->pieces, &ask->reply, &ask->answer))
        refuse(ask, PERCUSS_INTERNAL, "the bridge is out of memory");
}

void ask_clear(struct ask *ask)
{
    give_pieces_free(&ask->pieces);
    percuss_reply_free(&ask->reply);
}
