/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "base/units.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_POWER = 9,   /* of one unit: a digit */
    MOST_FACTORS = 8, /* units in a product */
    NUMBER_SIZE =
        400 /* of a number's text; the longest exact double has 767 digits, none needs them */
};

/* A unit, or a product of them: times numerator / denominator * 10^ten in SI. */
struct unit {
    double numerator, denominator;
    int ten;
    int mass, length, time; /* powers of kg, m, s */
};

struct named {
    const char *name;
    bool prefixed;
    struct unit unit;
};

/* International foot, of which a mile has 5,280, and pound of 1959; psi is lbf/in^2 with g
 * = 9.80665 m/s^2. */
static const struct named UNITS[] = {
    {"m", true, {1, 1, 0, 0, 1, 0}},
    {"g", true, {1, 1, -3, 1, 0, 0}},
    {"s", true, {1, 1, 0, 0, 0, 1}},
    {"N", true, {1, 1, 0, 1, 1, -2}},
    {"Pa", true, {1, 1, 0, 1, -1, -2}},
    {"Hz", true, {1, 1, 0, 0, 0, -1}},
    {"bar", true, {1, 1, 5, 1, -1, -2}},
    {"t", false, {1, 1, 3, 1, 0, 0}},
    {"min", false, {60, 1, 0, 0, 0, 1}},
    {"h", false, {3600, 1, 0, 0, 0, 1}},
    {"in", false, {254, 1, -4, 0, 1, 0}},
    {"ft", false, {3048, 1, -4, 0, 1, 0}},
    {"mi", false, {1609344, 1, -3, 0, 1, 0}},
    {"mph", false, {1609344, 3600, -3, 0, 1, -1}},
    {"lb", false, {45359237, 1, -8, 1, 0, 0}},
    {"psi", true, {44482216152605, 64516, -5, 1, -1, -2}},
};

/* As accelerometers count. */
static const struct unit STANDARD_GRAVITY = {980665, 1, -5, 0, 1, -2};

static const struct {
    const char *name;
    int ten;
} PREFIXES[] = {
    {"n", -9}, {"u", -6}, {"\xC2\xB5", -6}, {"\xCE\xBC", -6}, {"m", -3}, {"c", -2},
    {"d", -1}, {"k", 3},  {"M", 6},         {"G", 9},         {"T", 12},
};

static const struct {
    const char *name, *si, *example;
    int mass, length, time;
} QUANTITIES[QUANTITY_COUNT] = {
    [QUANTITY_NUMBER] = {"number", "", "0.3", 0, 0, 0},
    [QUANTITY_LENGTH] = {"length", "m", "8 mm", 0, 1, 0},
    [QUANTITY_STRESS] = {"stress", "Pa", "70 GPa", 1, -1, -2},
    [QUANTITY_DENSITY] = {"density", "kg/m^3", "2.7 g/cm^3", 1, -3, 0},
    [QUANTITY_CURVATURE] = {"curvature", "1/m", "5 1/m", 0, -1, 0},
    [QUANTITY_FREQUENCY] = {"frequency", "Hz", "20 kHz", 0, 0, -1},
    [QUANTITY_SPEED] = {"speed", "m/s", "300 mm/s", 0, 1, -1},
    [QUANTITY_TIME] = {"time", "s", "20 ms", 0, 0, 1},
    [QUANTITY_IMPULSE] = {"impulse", "N s", "30 mN s", 1, 1, -1},
    [QUANTITY_ACCELERATION] = {"acceleration", "m/s^2", "9.81 m/s^2", 0, 1, -2},
};

const char *units_name(enum quantity quantity)
{
    return QUANTITIES[quantity].name;
}

const char *units_si(enum quantity quantity)
{
    return QUANTITIES[quantity].si;
}

const char *units_example(enum quantity quantity)
{
    return QUANTITIES[quantity].example;
}

const char *units_known(size_t number, int *prefixed)
{
    if (number >= sizeof UNITS / sizeof *UNITS)
        return NULL;
    *prefixed = UNITS[number].prefixed;
    return UNITS[number].name;
}

const char *units_prefix(size_t number)
{
    return number < sizeof PREFIXES / sizeof *PREFIXES ? PREFIXES[number].name : NULL;
}

static size_t units_digits(const char *text)
{
    return strspn(text, "0123456789");
}

/* End of the exponent that begins here; the text itself: none begins. */
static const char *exponent_end(const char *text)
{
    if (*text != 'e' && *text != 'E')
        return text;
    const char *at = text + 1 + (text[1] == '+' || text[1] == '-');
    return units_digits(at) > 0 ? at + units_digits(at) : text;
}

/* End of the digits before an exponent. */
static const char *mantissa_end(const char *text)
{
    const char *at = text + (*text == '+' || *text == '-');
    size_t whole = units_digits(at), fraction = 0;
    at += whole;
    if (*at == '.') {
        fraction = units_digits(at + 1);
        at += 1 + fraction;
    }
    return whole + fraction > 0 ? at : text;
}

const char *units_number_end(const char *text)
{
    const char *end = mantissa_end(text);
    return end == text ? text : exponent_end(end);
}

static bool begins(const char *text, size_t length, const char *name)
{
    return length >= strlen(name) && memcmp(text, name, strlen(name)) == 0;
}

static const struct unit *find_plain(const char *text, size_t length, bool prefixed)
{
    for (size_t i = 0; i < sizeof UNITS / sizeof *UNITS; i++)
        if (begins(text, length, UNITS[i].name) && strlen(UNITS[i].name) == length &&
            (!prefixed || UNITS[i].prefixed))
            return &UNITS[i].unit;
    return NULL;
}

/* A unit by its name, with a prefix or without. */
static bool units_find(const char *text, size_t length, struct unit *unit)
{
    const struct unit *plain = find_plain(text, length, false);
    if (plain)
        *unit = *plain;
    for (size_t i = 0; !plain && i < sizeof PREFIXES / sizeof *PREFIXES; i++) {
        size_t before = strlen(PREFIXES[i].name);
        if (!begins(text, length, PREFIXES[i].name))
            continue;
        plain = find_plain(text + before, length - before, true);
        if (plain) {
            *unit = *plain;
            unit->ten += PREFIXES[i].ten;
        }
    }
    return plain;
}

/* "^-2", "-2", "2", "²", "³" or nothing: 1. */
static const char *read_power(const char *at, int *power)
{
    static const char *const raised[] = {"\xC2\xB2", "\xC2\xB3"};
    for (int i = 0; i < 2; i++)
        if (begins(at, strlen(at), raised[i])) {
            *power = 2 + i;
            return at + strlen(raised[i]);
        }
    const char *number = at + (*at == '^');
    bool negative = *number == '-';
    number += negative;
    *power = 1;
    if (units_digits(number) != 1)
        return at; /* a lone sign remains and is refused as a unit */
    *power = negative ? '0' - *number : *number - '0';
    return number + 1;
}

static void units_multiply(struct unit *product, const struct unit *unit, int power)
{
    for (int i = 0; i < abs(power); i++) {
        product->numerator *= power > 0 ? unit->numerator : unit->denominator;
        product->denominator *= power > 0 ? unit->denominator : unit->numerator;
    }
    product->ten += power * unit->ten;
    product->mass += power * unit->mass;
    product->length += power * unit->length;
    product->time += power * unit->time;
}

/* A sign between two units, with the blanks around it. *inverse: a slash. */
static const char *read_sign(const char *at, bool *inverse)
{
    const char *start = at;
    at += strspn(at, " ");
    *inverse = *at == '/';
    at += *at == '/' || *at == '*';
    at += strspn(at, " ");
    return at > start ? at : NULL;
}

/* Length of a unit's name; the micro sign begins with the same byte as the raised digits, which end
 * a name. */
static size_t name_length(const char *at)
{
    size_t micro = begins(at, strlen(at), "\xC2\xB5") ? 2 : 0;
    return micro + strcspn(at + micro, " */^-0123456789\xC2");
}

/* Units with powers, multiplied and divided from left to right; "1/..." too. */
static bool read_units(const char *at, struct unit *product)
{
    bool inverse = false;
    *product = (struct unit){.numerator = 1.0, .denominator = 1.0};
    for (int i = 0; i < MOST_FACTORS; i++) {
        /* a name and its power; "1/" is allowed at the beginning only */
        struct unit unit = {.numerator = 1.0, .denominator = 1.0};
        int power = 1;
        size_t length = name_length(at);
        if (i == 0 && at[0] == '1' && at[1] == '/')
            at++;
        else if (!units_find(at, length, &unit))
            return false;
        else
            at = read_power(at + length, &power);
        units_multiply(product, &unit, inverse ? -power : power);
        /* another unit, or the end */
        if (!at[strspn(at, " ")])
            return true;
        at = read_sign(at, &inverse);
        if (!at)
            return false;
    }
    return false;
}

/* The number up to `end` times 10^ten, rounded once. NAN: the text is too long. */
static double read_scaled(const char *text, const char *end, int ten)
{
    char decimal[NUMBER_SIZE];
    const char *mantissa = mantissa_end(text);
    long exponent = end > mantissa ? strtol(mantissa + 1, NULL, 10) : 0;
    /* a larger exponent gives 0 or no finite number with any mantissa */
    exponent = exponent > 100000 ? 100000 : exponent < -100000 ? -100000 : exponent;
    int length =
        snprintf(decimal, sizeof decimal, "%.*se%ld", (int)(mantissa - text), text, exponent + ten);
    return length < NUMBER_SIZE ? strtod(decimal, NULL) : NAN;
}

static double units_read_value(const char *text, const char *end, const struct unit *unit)
{
    if (unit->numerator == 1.0 && unit->denominator == 1.0)
        return unit->ten == 0 ? strtod(text, NULL) : read_scaled(text, end, unit->ten);
    /* integer factors: only the product and the quotient are rounded */
    double up = unit->ten > 0 ? pow(10.0, unit->ten) : 1.0;
    double down = unit->ten < 0 ? pow(10.0, -unit->ten) : 1.0;
    return strtod(text, NULL) * (unit->numerator * up) / (unit->denominator * down);
}

enum units_problem units_read(const char *text, enum quantity quantity, double *value)
{
    struct unit unit = {.numerator = 1.0, .denominator = 1.0};
    const char *end = units_number_end(text);
    const char *name = end + strspn(end, " ");
    if (end == text)
        return UNITS_NO_NUMBER;
    /* the unit, if there is one, and its quantity */
    if (quantity == QUANTITY_ACCELERATION && !strcmp(name, "g"))
        unit = STANDARD_GRAVITY;
    else if (*name && !read_units(name, &unit))
        return UNITS_UNKNOWN;
    if (*name &&
        (quantity == QUANTITY_NUMBER || unit.mass != QUANTITIES[quantity].mass ||
         unit.length != QUANTITIES[quantity].length || unit.time != QUANTITIES[quantity].time))
        return UNITS_OF_ANOTHER;
    *value = units_read_value(text, end, &unit) + 0.0;
    return isfinite(*value) ? UNITS_GOOD : UNITS_NO_NUMBER;
}

void units_explain(const char *text, enum units_problem problem, enum quantity quantity,
                   const char *range, char *out, size_t size)
{
    const char *si = units_si(quantity), *unit = units_number_end(text);
    if (!*si) {
        snprintf(out, size, "a number%s is needed, without a unit", range);
        return;
    }
    int length = snprintf(out, size, "a %s%s is needed, in %s or with a unit, such as %s",
                          units_name(quantity), range, si, units_example(quantity));
    if ((problem != UNITS_UNKNOWN && problem != UNITS_OF_ANOTHER) || (size_t)length >= size)
        return;
    unit += strspn(unit, " ");
    snprintf(out + length, size - (size_t)length, "; %.40s is no %s", unit,
             problem == UNITS_UNKNOWN ? "unit that is known" : units_name(quantity));
}
