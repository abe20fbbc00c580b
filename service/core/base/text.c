/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "base/text.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Powers of ten that are exact doubles. */
static const double POWERS[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
enum { HIGHEST_POWER = sizeof POWERS / sizeof *POWERS - 1 };

/* With more digits their rounding is comparable with that of the double. */
enum { MOST_DIGITS = 9 };
/* Exceeds the rounding error of a number of so many digits. */
static const double ROUNDING = 1e-6;
/* log10(2) */
static const double DIGITS_PER_BIT = 0.30102999566398120;
/* %g writes no exponent from this one on. */
enum { LEAST_PLAIN = -4 };

/* A number's first digits as an integer, the last of them rounded, and the power of ten of the
 * first. */
struct decimal {
    unsigned digits;
    int exponent;
};

struct text text_begin(char *buffer, size_t size)
{
    *buffer = '\0';
    return (struct text){buffer, size};
}

static void add_bytes(struct text *text, const char *bytes, size_t count)
{
    count = count < text->left - 1 ? count : text->left - 1;
    memcpy(text->at, bytes, count);
    text->at += count;
    text->left -= count;
    *text->at = '\0';
}

void text_add(struct text *text, const char *words)
{
    add_bytes(text, words, strlen(words));
}

void text_add_count(struct text *text, size_t count)
{
    char digits[24];
    size_t first = sizeof digits;
    do {
        digits[--first] = (char)('0' + count % 10);
        count /= 10;
    } while (count > 0);
    add_bytes(text, digits + first, sizeof digits - first);
}

void text_format(struct text *text, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int length = vsnprintf(text->at, text->left, format, args);
    va_end(args);
    size_t written = length < 0 ? 0 : (size_t)length;
    written = written < text->left ? written : text->left - 1;
    text->at += written;
    text->left -= written;
}

/* Rounds a value > 0. False: it is outside the table of powers, or too near the middle between two
 * decimals for a product of doubles to decide. */
static bool to_decimal(double value, int digits, struct decimal *decimal)
{
    /* the power of ten, or one less than it, from that of two */
    int binary;
    frexp(value, &binary);
    int exponent = (int)floor((binary - 1) * DIGITS_PER_BIT);
    for (;; exponent++) {
        /* rounded once: the powers are exact */
        int shift = digits - 1 - exponent;
        if (abs(shift) > HIGHEST_POWER)
            return false;
        double scaled = shift < 0 ? value / POWERS[-shift] : value * POWERS[shift];
        if (scaled >= POWERS[digits])
            continue;
        double whole = floor(scaled);
        double over = scaled - whole - 0.5;
        *decimal = (struct decimal){(unsigned)whole + (over > 0.0), exponent};
        /* 9.99 becomes 10 */
        if (decimal->digits == (unsigned)POWERS[digits]) {
            decimal->digits /= 10;
            decimal->exponent++;
        }
        return fabs(over) > ROUNDING;
    }
}

/* Writes as %g does: no trailing zeros, and an exponent where the number is too large or too
 * small. */
static void add_decimal(struct text *text, struct decimal decimal, int digits)
{
    char out[40];
    int exponent = decimal.exponent;
    bool plain = exponent >= LEAST_PLAIN && exponent < digits;
    size_t used = 0;
    /* zeros before the first digit */
    if (plain && exponent < 0) {
        memcpy(out, "0.0000", 6);
        used = (size_t)(1 - exponent);
    }
    /* the digits, with the point among them */
    size_t first = used;
    int before = !plain ? 1 : exponent < 0 ? 0 : exponent + 1;
    char figures[MOST_DIGITS];
    for (int i = digits - 1; i >= 0; i--, decimal.digits /= 10)
        figures[i] = (char)('0' + decimal.digits % 10);
    int last = digits;
    while (last > before && last > 1 && figures[last - 1] == '0')
        last--;
    for (int i = 0; i < last; i++) {
        if (i == before && used > first)
            out[used++] = '.';
        out[used++] = figures[i];
    }
    add_bytes(text, out, used);
    if (!plain) {
        text_add(text, exponent < 0 ? "e-" : "e+");
        text_add(text, abs(exponent) < 10 ? "0" : "");
        text_add_count(text, (size_t)abs(exponent));
    }
}

void text_add_number(struct text *text, double value, int digits)
{
    struct decimal decimal;
    if (digits <= MOST_DIGITS && value > 0.0 && value <= POWERS[HIGHEST_POWER] &&
        to_decimal(value, digits, &decimal))
        add_decimal(text, decimal, digits);
    else
        text_format(text, "%.*g", digits, value);
}
