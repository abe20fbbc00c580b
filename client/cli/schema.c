/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss schema: the JSON that the program reads and prints. */

#include <jansson.h>
#include <string.h>

#include "cli.h"
#include "ensemble_output.h"
#include "json_schema.h"
#include "reply_json.h"
#include "request_json.h"
#include "schema_files.h"

/* JSON Schemas of the commands' outputs besides replies and reports of ensembles. */

JSON_TABLE(task, PERCUSS_TASK_FIELDS)
JSON_TABLE(server, PERCUSS_SERVER_FIELDS)
JSON_TABLE(dent, PERCUSS_DENT_FIELDS)
JSON_TABLE(relaxation_term, PERCUSS_RELAXATION_TERM_FIELDS)
JSON_TABLE(contact_law, PERCUSS_CONTACT_LAW_FIELDS)
JSON_TABLE(material_pair, PERCUSS_MATERIAL_PAIR_FIELDS)

/* A member of an object that a command puts together. */
struct member {
    const char *name;
    const char *type; /* number (or null), integer, string, boolean; of `list`: its elements' */
    const char *what;
    json_t *(*schema)(void); /* of an object, instead of the type */
    bool list;
};

static json_t *type_of(const struct member *member)
{
    if (member->schema)
        return member->schema();
    if (strcmp(member->type, "number") == 0)
        return json_pack("{s[ss]}", "type", "number", "null");
    return json_pack("{ss}", "type", member->type);
}

/* All members are there; newer versions may add others. */
static json_t *object_of(const struct member *members, size_t count)
{
    json_t *properties = json_object(), *required = json_array();
    for (size_t i = 0; i < count; i++) {
        json_t *schema = type_of(&members[i]);
        if (members[i].list)
            schema = json_pack("{ssso}", "type", "array", "items", schema);
        json_object_set_new(schema, "description", json_string(members[i].what));
        json_object_set_new(properties, members[i].name, schema);
        json_array_append_new(required, json_string(members[i].name));
    }
    return json_pack("{sssoso}", "type", "object", "properties", properties, "required", required);
}
#define VALUE(name, type, what)                                                                    \
    {                                                                                              \
        name, type, what, NULL, false                                                              \
    }
#define VALUES(name, type, what)                                                                   \
    {                                                                                              \
        name, type, what, NULL, true                                                               \
    }
#define NESTED(name, what, schema)                                                                 \
    {                                                                                              \
        name, NULL, what, schema, false                                                            \
    }
#define LIST(name, what, schema)                                                                   \
    {                                                                                              \
        name, NULL, what, schema, true                                                             \
    }
#define OBJECT(members) object_of(members, sizeof members / sizeof *members)

#define WARNINGS                                                                                   \
    VALUES("warnings", "string", "each kind once, with how many have it and which is the first")

static json_t *point_schema(void)
{
    static const struct member members[] = {
        VALUE("speed", "number", "m/s"),
        VALUE("angle", "number", "degrees, of the flight from the normal"),
        VALUE("restitution", "number", ""),
        VALUE("error", "number", "of the restitution, by time steps and modes"),
        VALUE("error_total", "number", "of the restitution, by these and the models"),
        VALUE("impulse", "number", "N s"),
        VALUE("sub_impacts", "integer", ""),
        VALUE("significant", "integer", "those of at least 1 % of the impulse"),
        VALUE("end_time", "number", "s"),
        VALUE("status", "string", "of the reply"),
        NESTED("reply", "as query prints it", reply_schema),
    };
    return OBJECT(members);
}

static json_t *answer_schema(void)
{
    static const struct member members[] = {
        VALUE("speed", "number", "m/s"),
        VALUE("contact_model", "string", "asked for"),
        NESTED("reply", "as query prints it where one is asked for", reply_schema),
    };
    return OBJECT(members);
}

/* of several answers */
static json_t *query_schema(void)
{
    static const struct member members[] = {LIST(
        "answers", "of the first speed by each contact model, then of the next", answer_schema)};
    return OBJECT(members);
}

static json_t *curve_schema(void)
{
    static const struct member members[] = {
        VALUE("b", "string", "body B"),
        VALUE("contact_model", "string", "asked for"),
        LIST("points", "one a speed, or angle", point_schema),
    };
    return OBJECT(members);
}

/* Of one curve its points, of several the curves. */
static json_t *sweep_schema(void)
{
    static const struct member members[] = {
        LIST("points", "one a speed, or angle, of the only curve", point_schema),
        LIST("curves", "where several bodies or models are asked for", curve_schema),
        WARNINGS,
    };
    json_t *schema = OBJECT(members);
    json_object_set_new(schema, "required", json_pack("[s]", "warnings"));
    json_object_set_new(schema, "oneOf",
                        json_pack("[{s[s]}{s[s]}]", "required", "points", "required", "curves"));
    return schema;
}

static json_t *measured_schema(void)
{
    static const struct member members[] = {
        VALUE("restitution", "number", ""),
        VALUE("impulse", "number", "N s"),
        VALUE("sub_impacts", "number", ""),
        VALUE("first_impulse", "number", "N s, of the first sub-impact"),
        VALUE("first_duration", "number", "s, of the first sub-impact"),
        VALUE("second_start", "number", "s, of the second one after the first"),
    };
    return OBJECT(members);
}

static json_t *left_schema(void)
{
    static const struct member members[] = {
        VALUE("line", "integer", "of the file"),
        VALUE("reason", "string", "what the row lacks"),
    };
    return OBJECT(members);
}
#define LEFT_OUT LIST("left_out", "rows of the file that tell no impact", left_schema)

static json_t *twin_schema(void)
{
    static const struct member members[] = {
        VALUE("speed", "number", "m/s"),
        VALUE("at", "number", "fraction of the length"),
        NESTED("measured", "null where it was not", measured_schema),
        NESTED("simulated", "the same of its twin", measured_schema),
        VALUE("restitution_half_width", "number",
              "of the 95 % interval of the measured restitution; null: not known"),
        VALUE("status", "string", "of the reply"),
        VALUE("residual", "number", "restitution simulated less measured"),
    };
    return OBJECT(members);
}

static json_t *moments_schema(void)
{
    static const struct member members[] = {
        VALUE("mean", "number", ""),
        VALUE("standard_deviation", "number", ""),
    };
    return OBJECT(members);
}

static json_t *residual_schema(void)
{
    static const struct member members[] = {
        VALUE("mean", "number", ""),
        VALUE("half_width", "number", "of its 95 % interval"),
        VALUE("root_mean_square", "number", ""),
    };
    return OBJECT(members);
}

static json_t *distance_schema(void)
{
    static const struct member members[] = {
        VALUE("value", "number", ""),
        VALUE("p", "number", "p-value"),
    };
    return OBJECT(members);
}

static json_t *compare_schema(void)
{
    static const struct member members[] = {
        NESTED("measured", "of the restitution", moments_schema),
        NESTED("simulated", "of the restitution", moments_schema),
        NESTED("residual", "of the restitution, simulated less measured", residual_schema),
        NESTED("kolmogorov_smirnov", "distance of the distributions", distance_schema),
        NESTED("energy_distance", "distance of the distributions", distance_schema),
        VALUE("sub_impacts_known", "integer", "impacts whose number was measured"),
        VALUE("sub_impacts_equal", "integer", "of these, with as many in the twin"),
        LIST("impacts", "impact by impact", twin_schema),
        LEFT_OUT,
        WARNINGS,
    };
    return OBJECT(members);
}

static json_t *fitted_schema(void)
{
    static const struct member members[] = {
        VALUE("parameter", "string", ""),
        VALUE("body", "string", ""),
        VALUE("start", "number", "SI unit of the parameter; null: the catalogue's"),
        VALUE("value", "number", "that fits best"),
        VALUE("low", "number", "of its 95 % interval"),
        VALUE("high", "number", "of its 95 % interval"),
        VALUE("determined", "boolean", "whether the data tell it"),
    };
    return OBJECT(members);
}

static json_t *quantity_schema(void)
{
    static const struct member members[] = {
        VALUE("quantity", "string", ""),
        VALUE("known", "integer", "readings"),
        VALUE("used", "integer", "readings"),
        VALUE("scatter", "number", "relative"),
    };
    return OBJECT(members);
}

static json_t *row_schema(void)
{
    return json_pack("{sss{s[ss]}}", "type", "array", "items", "type", "number", "null");
}

static json_t *calibrate_schema(void)
{
    static const struct member members[] = {
        LIST("parameters", "", fitted_schema),
        LIST("correlation", "row by row, of the parameters", row_schema),
        LIST("quantities", "what was measured", quantity_schema),
        VALUE("impacts", "integer", ""),
        VALUE("freedom", "number", "degrees of freedom"),
        LEFT_OUT,
        WARNINGS,
    };
    return OBJECT(members);
}

static json_t *export_point_schema(void)
{
    static const struct member members[] = {
        VALUE("speed", "number", "m/s"),
        VALUE("restitution", "number", ""),
        VALUE("error_total", "number", "of the restitution, by time steps, modes and models"),
        VALUE("duration", "number", "of the sub-impact with the largest impulse, s"),
        VALUE("model", "number", "the other simulator's restitution"),
    };
    return OBJECT(members);
}

static json_t *export_schema(void)
{
    static const struct member members[] = {
        VALUE("for", "string", "the other simulator"),
        LIST("points", "one a speed", export_point_schema),
        VALUE("worst", "number", "largest difference of the restitutions"),
        VALUE("mass", "number", "effective, of the pair, kg"),
        VALUE("duration", "number", "of the contact in the other simulator, s"),
        VALUE("step", "number", "of its time, at most, s"),
        VALUE("restitution", "number", "at all speeds; null: it depends on the speed"),
        VALUE("stiffness", "number", "of the pair, N/m"),
        VALUE("damping", "number", "of the pair, N s/m; null: by the dissipation"),
        VALUE("dissipation", "number", "of Hunt and Crossley, s/m; null: by the damping"),
        WARNINGS,
    };
    return OBJECT(members);
}

static json_t *site_schema(void)
{
    static const struct member members[] = {
        VALUE("name", "string", ""),
        VALUES("point", "number", "m, in the body's frame"),
        VALUES("normal", "number", "outward"),
    };
    return OBJECT(members);
}

static json_t *relaxation_schema(void)
{
    return json_schema(relaxation_term_members(), false);
}

static json_t *pair_schema(void)
{
    return json_schema(material_pair_members(), false);
}

static json_t *body_schema(void)
{
    static const struct member members[] = {
        VALUE("id", "string", ""),
        VALUE("shape", "string", ""),
        VALUE("material", "string", ""),
        VALUE("mass", "number", "kg; null: a half-space"),
        VALUE("description", "string", "dimensions, theory and ends in words"),
        VALUES("half_extents", "number", "m, half the size along x, y, z; 0: without bounds"),
        VALUE("radius", "number", "m; 0: it has none"),
        VALUE("tip_radius", "number", "m, of a rod's or a beam's caps; null: flat ends of a rod"),
        VALUES("supports", "string", "at -x and +x: free, pinned or clamped"),
        VALUES("inertia", "number", "kg m^2, diagonal about the centre of mass"),
        VALUES("products", "number", "kg m^2, elements yz, zx, xy"),
        LIST("sites", "of a mesh", site_schema),
        VALUE("loss_factor", "number", "of its material; null: not stated"),
        VALUE("loss_frequency", "number", "Hz, at which that was measured; null: not stated"),
        LIST("relaxation", "of its material: a Prony series", relaxation_schema),
        VALUE("rate_reference", "number", "1/s; null: its yield is that of any rate of strain"),
        VALUE("rate_exponent", "number", "of Cowper and Symonds; null: by the coefficient"),
        VALUE("rate_coefficient", "number", "of Johnson and Cook; null: by the exponent"),
    };
    json_t *schema = OBJECT(members);
    json_t *properties = json_object_get(schema, "properties");
    /* parameters that a request may override */
    for (unsigned p = 0; p < PERCUSS_PARAMETER_COUNT; p++)
        if (p != PERCUSS_PARAMETER_RADIUS)
            json_object_set_new(properties, percuss_parameter_name(p),
                                json_pack("{s[ss]ss}", "type", "number", "null", "description",
                                          "SI unit; null: it has none, or of yield: elastic"));
    return schema;
}

static json_t *bodies_schema(void)
{
    static const struct member members[] = {
        LIST("bodies", "by id", body_schema),
        LIST("pairs",
             "with the material of a body, of which the catalogue states friction or a law",
             pair_schema),
    };
    return OBJECT(members);
}

static json_t *remark_schema(void)
{
    static const struct member members[] = {
        VALUE("of", "string", "materials or bodies"),
        VALUE("name", "string", "of the material or body"),
        VALUE("key", "string", "of the catalogue, or size"),
        VALUE("text", "string", "why it is improbable"),
    };
    return OBJECT(members);
}

/* bodies --check */
static json_t *remarks_schema(void)
{
    static const struct member members[] = {
        VALUE("bodies", "integer", "that were looked at"),
        LIST("remarks", "", remark_schema),
    };
    return OBJECT(members);
}

static json_t *dent_schema(void)
{
    return json_schema(dent_members(), false);
}

static json_t *specimen_schema(void)
{
    static const struct member members[] = {
        VALUE("specimen", "string", "its name"),
        VALUE("body", "string", "of the catalogue"),
        VALUE("impacts", "integer", "that it has had"),
        LIST("patches", "its dents", dent_schema),
    };
    return OBJECT(members);
}

static json_t *dents_schema(void)
{
    static const struct member members[] = {LIST("specimens", "", specimen_schema)};
    return OBJECT(members);
}

static json_t *server_schema(void)
{
    return json_schema(server_members(), false);
}

static json_t *status_schema(void)
{
    static const struct member members[] = {LIST("servers", "", server_schema)};
    return OBJECT(members);
}

static json_t *ping_schema(void)
{
    static const struct member members[] = {
        VALUE("count", "integer", "pings"),
        VALUE("shortest", "number", "s"),
        VALUE("mean", "number", "s"),
        VALUE("longest", "number", "s"),
    };
    return OBJECT(members);
}

static json_t *finding_schema(void)
{
    static const struct member members[] = {
        VALUE("level", "string", "ok, warning or problem"),
        VALUE("subject", "string", "what was looked at"),
        VALUE("found", "string", "in words"),
        VALUE("advice", "string", "what to do; empty: nothing"),
    };
    return OBJECT(members);
}

static json_t *doctor_schema(void)
{
    static const struct member members[] = {
        VALUE("problems", "integer", "findings of that level"),
        VALUE("warnings", "integer", "findings of that level"),
        LIST("findings", "in the order in which it looks", finding_schema),
    };
    return OBJECT(members);
}

/* Of the files that percussd reads. */
static json_t *catalogue_schema(void)
{
    return json_loads(SCHEMA_OF_catalogue, 0, NULL);
}

static json_t *settings_schema(void)
{
    return json_loads(SCHEMA_OF_percussd, 0, NULL);
}

struct kind {
    const char *name;
    json_t *(*schema)(void);
};

static const struct kind kinds[] = {
    {"request", request_schema},   {"reply", reply_schema},     {"ensemble", ensemble_schema},
    {"sweep", sweep_schema},       {"compare", compare_schema}, {"calibrate", calibrate_schema},
    {"bodies", bodies_schema},     {"remarks", remarks_schema}, {"dents", dents_schema},
    {"status", status_schema},     {"ping", ping_schema},       {"doctor", doctor_schema},
    {"export", export_schema},     {"query", query_schema},     {"catalogue", catalogue_schema},
    {"settings", settings_schema},
};
#define KIND_NAMES                                                                                 \
    "request, reply, ensemble, sweep, compare, calibrate, export, bodies, remarks, dents, "        \
    "status, ping, "                                                                               \
    "doctor, query, catalogue, settings"

struct choice {
    struct common *common;
    const struct kind *kind;
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct choice *choice = state->input;
    switch (key) {
    /* options that all commands share */
    case ARGP_KEY_INIT:
        state->child_inputs[0] = choice->common;
        return 0;
    /* the kind of JSON: the first argument alone */
    case ARGP_KEY_ARG:
        for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
            if (!choice->kind && !strcmp(kinds[i].name, text))
                choice->kind = &kinds[i];
        if (!choice->kind || state->arg_num > 0)
            argp_error(state, "'%s': one of " KIND_NAMES " is allowed", text);
        return 0;
    case ARGP_KEY_NO_ARGS:
        argp_error(state, "one of " KIND_NAMES " is needed");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
const struct argp schema_argp = {
    .parser = parse,
    .args_doc =
        "request|reply|ensemble|sweep|compare|calibrate|export|bodies|remarks|dents|status|ping|"
        "doctor|query|catalogue|settings",
    .doc = "Prints the JSON Schema of the requests that 'query --request' reads, of the replies "
           "that 'query --json' prints (query: of several), of what another command prints with "
           "--json, or of the remarks of "
           "'bodies --check --json', or of a catalogue or settings in YAML; asks no server.",
    .children = children,
};

int command_schema(int argc, char **argv, struct common *common)
{
    struct choice choice = {common, NULL};
    argp_parse(&schema_argp, argc, argv, 0, NULL, &choice);
    json_t *schema = choice.kind->schema();
    json_t *root = json_pack("{ssss}", "$schema", "https://json-schema.org/draft/2020-12/schema",
                             "title", choice.kind->name);
    json_object_update(root, schema);
    json_decref(schema);
    json_print(root);
    return EXIT_ANSWERED;
}
