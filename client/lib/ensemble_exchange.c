/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble_exchange.h"

#include <stdlib.h>
#include <string.h>

void ensemble_exchange_note(struct ensemble_exchange *exchange,
                            const percuss_v1_EnsembleProgress *wire)
{
    exchange->heard++;
    exchange->told++;
    exchange->progress = (struct percuss_ensemble_progress){
        .done = wire->done,
        .samples = wire->samples,
        .mean = wire->mean,
        .standard_deviation = wire->standard_deviation,
        .half_width = wire->half_width,
    };
}

/* Makes room for so many numbers. */
static bool grow(struct ensemble_exchange *exchange, size_t numbers)
{
    if (numbers <= exchange->room)
        return true;
    size_t room = 2 * exchange->room > numbers ? 2 * exchange->room : numbers;
    double *rows = realloc(exchange->rows, room * sizeof *rows);
    if (!rows)
        return false;
    exchange->rows = rows;
    exchange->room = room;
    return true;
}

void ensemble_exchange_add(struct ensemble_exchange *exchange,
                           const percuss_v1_EnsembleSamples *wire)
{
    /* reliable and in order: a part that is not the next one is of another asking */
    if (wire->part == 0)
        exchange->arrived = 0;
    if (wire->part != exchange->arrived || wire->columns == 0 ||
        wire->rows._length % wire->columns != 0)
        return;
    size_t at = wire->part == 0 ? 0 : exchange->numbers;
    if (!grow(exchange, at + wire->rows._length))
        return;
    if (wire->rows._length > 0)
        memcpy(exchange->rows + at, wire->rows._buffer,
               wire->rows._length * sizeof *exchange->rows);
    exchange->numbers = at + wire->rows._length;
    exchange->columns = wire->columns;
    exchange->parts = wire->parts;
    exchange->arrived++;
    exchange->heard++;
}

bool ensemble_exchange_is_complete(const struct ensemble_exchange *exchange)
{
    return exchange->arrived > 0 && exchange->arrived == exchange->parts &&
           exchange->numbers == exchange->reply.samples * exchange->columns;
}
