/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Prints the modelDescription.xml of the FMU by the table that it is linked with. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model.h"

/* Units by the exponents of SI. */
static const struct unit {
    const char *name;
    int kg, m, s, rad;
} UNITS[] = {
    {"s", 0, 0, 1, 0},     {"m", 0, 1, 0, 0},      {"m/s", 0, 1, -1, 0},
    {"m/s2", 0, 1, -2, 0}, {"1/kg", -1, 0, 0, 0},  {"N.s", 1, 1, -1, 0},
    {"J", 1, 2, -2, 0},    {"rad/s", 0, 0, -1, 1}, {"N.m.s", 1, 2, -1, 0},
};

/* A text as the value of an attribute. */
static void print_attribute(const char *name, const char *text)
{
    printf(" %s=\"", name);
    for (; *text; text++) {
        if (*text == '"')
            fputs("&quot;", stdout);
        else if (*text == '&')
            fputs("&amp;", stdout);
        else if (*text == '<')
            fputs("&lt;", stdout);
        else
            putchar(*text);
    }
    putchar('"');
}

static void print_units(void)
{
    puts("  <UnitDefinitions>");
    for (size_t i = 0; i < sizeof UNITS / sizeof *UNITS; i++) {
        const struct unit *unit = &UNITS[i];
        printf("    <Unit name=\"%s\"><BaseUnit kg=\"%d\" m=\"%d\" s=\"%d\" rad=\"%d\"/></Unit>\n",
               unit->name, unit->kg, unit->m, unit->s, unit->rad);
    }
    puts("  </UnitDefinitions>");
}

static const char *causality(const struct variable *variable)
{
    static const char *const NAMES[] = {
        [VARIABLE_TIME] = "independent",  [VARIABLE_PARAMETER] = "parameter",
        [VARIABLE_INPUT] = "input",       [VARIABLE_STATE] = "output",
        [VARIABLE_DERIVATIVE] = "local",  [VARIABLE_INDICATOR] = "local",
        [VARIABLE_CONTINUOUS] = "output", [VARIABLE_DISCRETE] = "output",
    };
    return NAMES[variable->role];
}

static const char *variability(const struct variable *variable)
{
    return variable->role == VARIABLE_PARAMETER  ? "fixed"
           : variable->role == VARIABLE_DISCRETE ? "discrete"
                                                 : "continuous";
}

/* With as few digits as tell it from every other one. */
static void print_number(const char *name, double value)
{
    char text[32];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    print_attribute(name, text);
}

static void print_start(const struct variable *variable)
{
    if (!variable_has_start(variable))
        return;
    if (variable->type == VARIABLE_BOOLEAN)
        print_attribute("start", variable->start != 0.0 ? "true" : "false");
    else if (variable->type != VARIABLE_STRING)
        print_number("start", variable->start);
}

static void print_variable(unsigned reference)
{
    static const char *const TYPES[] = {
        [VARIABLE_FLOAT64] = "Float64",
        [VARIABLE_INT32] = "Int32",
        [VARIABLE_BOOLEAN] = "Boolean",
        [VARIABLE_STRING] = "String",
    };
    const struct variable *variable = &MODEL.variables[reference];
    const char *type = TYPES[variable->type];
    printf("    <%s", type);
    print_attribute("name", variable->name);
    printf(" valueReference=\"%u\"", reference);
    print_attribute("description", variable->meaning);
    print_attribute("causality", causality(variable));
    print_attribute("variability", variability(variable));
    if (variable->role == VARIABLE_STATE)
        print_attribute("initial", "exact");
    if (variable->unit)
        print_attribute("unit", variable->unit);
    print_start(variable);
    if (variable->role == VARIABLE_DERIVATIVE)
        printf(" derivative=\"%u\"", reference - 1);
    if (variable->type == VARIABLE_STRING) {
        fputs("><Start", stdout);
        print_attribute("value", variable->text);
        printf("/></%s>\n", type);
    } else
        puts("/>");
}

/* Each variable of the roles, which are bits, as depending on each of others. */
static void print_structure(const char *element, unsigned roles, unsigned knowns)
{
    for (size_t i = 0; i < MODEL.variable_count; i++) {
        if (!(roles & 1u << MODEL.variables[i].role))
            continue;
        printf("    <%s valueReference=\"%zu\" dependencies=\"", element, i);
        const char *gap = "";
        for (size_t j = 0; j < MODEL.variable_count; j++) {
            if (!(knowns & 1u << MODEL.variables[j].role))
                continue;
            printf("%s%zu", gap, j);
            gap = " ";
        }
        puts("\"/>");
    }
}

static void print_interfaces(void)
{
    printf("  <ModelExchange modelIdentifier=\"%s\" needsCompletedIntegratorStep=\"true\" "
           "canBeInstantiatedOnlyOncePerProcess=\"false\" canGetAndSetFMUState=\"true\" "
           "canSerializeFMUState=\"true\"/>\n",
           MODEL.identifier);
    printf("  <CoSimulation modelIdentifier=\"%s\" "
           "canBeInstantiatedOnlyOncePerProcess=\"false\" canGetAndSetFMUState=\"true\" "
           "canSerializeFMUState=\"true\" canHandleVariableCommunicationStepSize=\"true\" "
           "hasEventMode=\"true\" canReturnEarlyAfterIntermediateUpdate=\"false\"/>\n",
           MODEL.identifier);
}

int main(void)
{
    /* the head */
    puts("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    printf("<fmiModelDescription fmiVersion=\"3.0\"");
    print_attribute("modelName", MODEL.identifier);
    print_attribute("instantiationToken", MODEL.token);
    print_attribute("description", MODEL.meaning);
    print_attribute("version", PERCUSS_VERSION);
    print_attribute("license", "Apache-2.0");
    print_attribute("generationTool", "percuss " PERCUSS_VERSION);
    print_attribute("variableNamingConvention", "structured");
    puts(">");

    /* its interfaces, units and variables */
    print_interfaces();
    print_units();
    puts("  <LogCategories>\n"
         "    <Category name=\"logStatusError\" description=\"errors, which are always told\"/>\n"
         "    <Category name=\"logImpacts\" description=\"each impact, with its warnings\"/>\n"
         "  </LogCategories>");
    puts("  <DefaultExperiment startTime=\"0\" stopTime=\"1\" stepSize=\"0.01\"/>");

    /* the table */
    puts("  <ModelVariables>");
    for (size_t i = 0; i < MODEL.variable_count; i++)
        print_variable((unsigned)i);
    puts("  </ModelVariables>\n  <ModelStructure>");
    unsigned calculated = 1u << VARIABLE_CONTINUOUS | 1u << VARIABLE_DISCRETE;
    unsigned known = 1u << VARIABLE_INPUT | 1u << VARIABLE_STATE;
    print_structure("Output", calculated | 1u << VARIABLE_STATE, known);
    print_structure("ContinuousStateDerivative", 1u << VARIABLE_DERIVATIVE, known);
    print_structure("InitialUnknown", calculated | 1u << VARIABLE_DERIVATIVE,
                    known | 1u << VARIABLE_PARAMETER);
    print_structure("EventIndicator", 1u << VARIABLE_INDICATOR, known);
    puts("  </ModelStructure>\n</fmiModelDescription>");
    return fflush(stdout) == 0 && !ferror(stdout) ? EXIT_SUCCESS : EXIT_FAILURE;
}
