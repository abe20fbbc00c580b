/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Calls every function of the public headers, in every library that has it, once for each of its
 * pointers: with that one NULL, and all other arguments valid. None may crash; a NULL that is not
 * allowed (nulls.allowed) is INVALID_ARGUMENT where there is a result, and in any case named by the
 * error text. prototypes.awk makes the calls; a function or a type that is new does not compile
 * here, or is called, too. usage: nulls CATALOGUE LIBRARY... */
#include <dlfcn.h>
#include <math.h>
#include <percuss/ensemble_share.h>
#include <percuss/local.h>
#include <percuss/measured.h>
#include <percuss/slow_link.h>
#include <percuss/slowscale.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "domain.h"

static void *handle; /* of the library that is called */
static const char *library, *called,
    *argument; /* its file, the function, the pointer that is NULL */
static const char *(*error_text)(void);
static int calls, faults;

/* Of any library that is loaded with it; NULL: it has none of that name. */
static void *find(const char *name)
{
    return dlsym(handle, name);
}
#define FIND(function) ((__typeof__(&(function)))find(#function))

/* What the library itself defines. */
static void *find_own(const char *name)
{
    Dl_info info;
    void *address = dlsym(handle, name);
    return address && dladdr(address, &info) && !strcmp(info.dli_fname, library) ? address : NULL;
}

static void complain(const char *what, const char *text)
{
    fprintf(stderr, "%s: %s with %s NULL: %s: \"%s\"\n", library, called, argument, what, text);
    faults++;
}

static void crashed(int signal_number)
{
    char text[512];
    int length = snprintf(text, sizeof text, "%s: %s with %s NULL: signal %d\n", library, called,
                          argument, signal_number);
    _exit(write(STDERR_FILENO, text, (size_t)length) == length ? 1 : 2);
}

static bool watch(void *context)
{
    (void)context;
    return true;
}

static bool progress(void *context, const struct percuss_ensemble_progress *told)
{
    (void)context, (void)told;
    return true;
}

static void share(void *context, struct percuss_ensemble_sharing *sharing,
                  const struct percuss_ensemble_range *range)
{
    (void)context, (void)sharing, (void)range;
}

static bool probe(void *context, struct percuss_slow_view *view)
{
    (void)context;
    for (size_t i = 0; i < view->count; i++)
        view->gap_rate[i] = 0.0;
    return true;
}

static bool apply(void *context, const struct percuss_slow_contact *contact, double impulse)
{
    (void)context, (void)contact, (void)impulse;
    return true;
}

static double now(void *context)
{
    (void)context;
    return 0.0;
}

static const struct percuss_slow_body BODIES[] = {{.id = "steel-sphere"}, {.id = "al-rod"}};
static const char *const COLUMNS[] = {"speed=v"};
static const struct percuss_measured_file FILE_OF_IMPACTS = {.file = "nothing"};
static const struct percuss_measured_impact IMPACT = {.speed = 0.3, .restitution = 0.5};

/* Arguments. */
static struct {
    struct percuss_client *client;
    struct percuss_body_list bodies;
    struct percuss_pair pair;
    struct percuss_request request, filled;
    struct percuss_ensemble_request ensemble;
    struct percuss_ensemble_worker *worker;
    struct percuss_ensemble_range range;
    struct percuss_measured *measured;
    struct percuss_measured_question question;
    struct percuss_slow *slow;
    struct percuss_slow_config slow_config;
    struct percuss_slow_contact contact;
    struct percuss_slow_inertia inertias[2];
    struct percuss_body_motion motions[2];
    struct percuss_sub_impact sub;
    struct percuss_slow_link link;
    struct percuss_client_config client_config;
    struct percuss_local_config local_config;
    double numbers[16];
    uint64_t sequence;
    char octets[1 << 16];
} valid;

/* Results, which every call may fill. */
static struct {
    struct percuss_client *client;
    struct percuss_ensemble_worker *worker;
    struct percuss_measured *measured;
    struct percuss_slow *slow;
    struct percuss_body_list bodies;
    struct percuss_server_list servers;
    struct percuss_specimen_list specimens;
    struct percuss_reply reply;
    struct percuss_trace trace;
    struct percuss_ensemble_reply ensemble;
    struct percuss_comparison comparison;
    struct percuss_calibration calibration;
    struct percuss_slow_outcome outcome;
    double impulse[16];
} made;

#define VALID_double                                  0.01
#define VALID_size_t                                  1
#define VALID_uint32_t                                0
#define VALID_uint64_t                                7
#define VALID_char_p                                  valid.octets
#define VALID_const_char_p                            "nothing"
#define VALID_const_char_p_const_p                    COLUMNS
#define VALID_double_p                                made.impulse
#define VALID_const_double_p                          valid.numbers
#define VALID_uint8_t_p                               ((uint8_t *)valid.octets)
#define VALID_uint64_t_p                              (&valid.sequence)
#define VALID_void_p                                  ((void *)valid.octets)
#define VALID_const_void_p                            ((const void *)valid.octets)
#define VALID_percuss_progress_function_p             progress
#define VALID_percuss_share_function_p                share
#define VALID_percuss_watch_function_p                watch
#define VALID_struct_percuss_client_p                 valid.client
#define VALID_const_struct_percuss_client_p           valid.client
#define VALID_struct_percuss_client_p_p               (&made.client)
#define VALID_const_struct_percuss_client_config_p    (&valid.client_config)
#define VALID_const_struct_percuss_local_config_p     (&valid.local_config)
#define VALID_const_struct_percuss_body_list_p        (&valid.bodies)
#define VALID_struct_percuss_body_list_p              (&made.bodies)
#define VALID_const_struct_percuss_body_p             valid.bodies.bodies
#define VALID_struct_percuss_server_list_p            (&made.servers)
#define VALID_struct_percuss_specimen_list_p          (&made.specimens)
#define VALID_const_struct_percuss_pair_p             (&valid.pair)
#define VALID_const_struct_percuss_request_p          (&valid.request)
#define VALID_struct_percuss_request_p                (&valid.filled)
#define VALID_struct_percuss_reply_p                  (&made.reply)
#define VALID_struct_percuss_trace_p                  (&made.trace)
#define VALID_const_struct_percuss_ensemble_request_p (&valid.ensemble)
#define VALID_struct_percuss_ensemble_reply_p         (&made.ensemble)
#define VALID_const_struct_percuss_ensemble_range_p   (&valid.range)
#define VALID_struct_percuss_ensemble_worker_p        valid.worker
#define VALID_struct_percuss_ensemble_worker_p_p      (&made.worker)
/* only one that is asked for could be given, in a callback */
#define VALID_struct_percuss_ensemble_sharing_p                                                    \
    ((struct percuss_ensemble_sharing *)(void *)valid.octets)
#define VALID_const_struct_percuss_measured_file_p     (&FILE_OF_IMPACTS)
#define VALID_const_struct_percuss_measured_impact_p   (&IMPACT)
#define VALID_const_struct_percuss_measured_p          valid.measured
#define VALID_struct_percuss_measured_p_p              (&made.measured)
#define VALID_const_struct_percuss_measured_question_p (&valid.question)
#define VALID_struct_percuss_comparison_p              (&made.comparison)
#define VALID_struct_percuss_calibration_p             (&made.calibration)
#define VALID_const_struct_percuss_slow_config_p       (&valid.slow_config)
#define VALID_const_struct_percuss_slow_contact_p      (&valid.contact)
#define VALID_const_struct_percuss_slow_inertia_p      valid.inertias
#define VALID_const_struct_percuss_body_motion_p       valid.motions
#define VALID_struct_percuss_body_motion_p             valid.motions
#define VALID_const_struct_percuss_slow_p              valid.slow
#define VALID_struct_percuss_slow_p                    valid.slow
#define VALID_struct_percuss_slow_p_p                  (&made.slow)
#define VALID_struct_percuss_slow_outcome_p            (&made.outcome)

static void begin(const char *name)
{
    argument = name;
    calls++;
    memset(&made, 0, sizeof made);
    made.outcome.impulse = made.impulse;
    /* a text that is of no NULL */
    const struct percuss_slow_config none = {0};
    if (find("percuss_body_find"))
        (void)FIND(percuss_body_find)(&valid.bodies, "nobody");
    if (find("percuss_slow_create"))
        (void)FIND(percuss_slow_create)(&none, &made.slow);
    if (find("percuss_measured_create"))
        (void)FIND(percuss_measured_create)(0, NULL, &made.measured);
}

/* The arrays that a call may have filled. */
static void tidy(void)
{
    if (find("percuss_reply_free")) {
        FIND(percuss_reply_free)(&made.reply);
        FIND(percuss_trace_free)(&made.trace);
        FIND(percuss_ensemble_reply_free)(&made.ensemble);
        FIND(percuss_body_list_free)(&made.bodies);
        FIND(percuss_server_list_free)(&made.servers);
        FIND(percuss_specimen_list_free)(&made.specimens);
        FIND(percuss_client_free)(made.client);
    }
    if (find("percuss_ensemble_worker_free"))
        FIND(percuss_ensemble_worker_free)(made.worker);
    if (find("percuss_slow_free"))
        FIND(percuss_slow_free)(made.slow);
    if (find("percuss_measured_free"))
        FIND(percuss_measured_free)(made.measured);
}

static void end(bool may_be_null, bool has_result, enum percuss_result returned)
{
    char expected[80];
    const char *text = error_text();
    snprintf(expected, sizeof expected, "%s: NULL: ", argument);
    if (!may_be_null && has_result && returned != PERCUSS_RESULT_INVALID_ARGUMENT)
        complain("is not INVALID_ARGUMENT", text);
    else if (!may_be_null && strncmp(text, expected, strlen(expected)) != 0)
        complain("is not named", text);
    else if (may_be_null && strncmp(text, expected, strlen(expected)) == 0)
        complain("is refused, and was said to be allowed", text);
    tidy();
}

#define FUNCTION(name)                                                                             \
    __typeof__(&(name)) function = (__typeof__(&(name)))find_own(#name);                           \
    enum percuss_result returned = PERCUSS_RESULT_OK;                                              \
    (void)function, (void)returned
#define BEGIN(name)                  begin(#name)
#define END(may_be_null, has_result) end(may_be_null, has_result, returned)

struct call {
    const char *name;
    void (*function)(void);
};

#include "nulls_calls.h"

static void demand(bool good, const char *what)
{
    if (good)
        return;
    fprintf(stderr, "%s: %s: %s\n", library, what, error_text ? error_text() : "");
    exit(EXIT_FAILURE);
}

/* Of a library that asks, or answers: a client, and what it is asked. */
static void make_client(const char *catalogue)
{
    if (find("percuss_local_open")) {
        valid.local_config = FIND(percuss_local_config_default)();
        valid.local_config.catalogue = catalogue;
        valid.local_config.threads = 1;
        demand(!FIND(percuss_local_open)(&valid.local_config, &valid.client), "opened");
        demand(!FIND(percuss_bodies)(valid.client, 1.0, &valid.bodies), "bodies");
    } else {
        valid.client_config = FIND(percuss_client_config_default)();
        demand(!FIND(percuss_client_create)(&valid.client_config, &valid.client), "created");
        valid.bodies.bodies = calloc(2, sizeof *valid.bodies.bodies);
        demand(valid.bodies.bodies, "memory");
        valid.bodies.count = 2;
        strcpy(valid.bodies.bodies[0].shape, "sphere");
        strcpy(valid.bodies.bodies[1].shape, "rod");
    }
    valid.pair = FIND(percuss_pair_default)(&valid.bodies.bodies[0], &valid.bodies.bodies[1]);
    valid.pair.speed = 0.3;
    FIND(percuss_ensemble_request_init)(&valid.ensemble);
    struct percuss_request *scene = &valid.ensemble.scene;
    FIND(percuss_request_add_body)(scene, "steel-sphere")->velocity[0] = -0.3;
    FIND(percuss_request_add_body)(scene, "al-rod")->position[0] = -0.515;
    *FIND(percuss_request_add_contact)(scene, 0, 1) =
        (struct percuss_contact){.a = 0, .b = 1, .point = {-0.015}, .normal = {1.0}};
    valid.request = *scene;
    valid.ensemble.samples = 16;
    valid.ensemble.input_count = 1;
    valid.ensemble.inputs[0] = (struct percuss_input){.name = "speed",
                                                      .distribution = PERCUSS_DISTRIBUTION_UNIFORM,
                                                      .first = 0.1,
                                                      .second = 0.3,
                                                      .lower = NAN,
                                                      .upper = NAN};
    valid.range = (struct percuss_ensemble_range){.count = 1};
    if (find("percuss_ensemble_worker_create"))
        demand(!FIND(percuss_ensemble_worker_create)(valid.client, &valid.ensemble, &valid.worker),
               "worker");
}

static void make_slow(void)
{
    valid.slow_config = FIND(percuss_slow_config_default)();
    valid.slow_config.body_count = 2;
    valid.slow_config.bodies = BODIES;
    valid.slow_config.engine =
        (struct percuss_slow_engine){.probe = probe, .apply = apply, .now = now};
    demand(!FIND(percuss_slow_create)(&valid.slow_config, &valid.slow), "slow scale");
}

static void make_all(const char *catalogue)
{
    memset(&valid, 0, sizeof valid);
    valid.contact = (struct percuss_slow_contact){.a = 0, .b = 1, .normal = {1.0}};
    for (int i = 0; i < 2; i++) {
        valid.motions[i].orientation[0] = 1.0;
        valid.inertias[i] = (struct percuss_slow_inertia){1.0, {1.0, 1.0, 1.0}};
    }
    for (size_t i = 0; i < sizeof valid.numbers / sizeof *valid.numbers; i++)
        valid.numbers[i] = 1.0;
    if (find("percuss_pair_default"))
        make_client(catalogue);
    if (find("percuss_slow_create"))
        make_slow();
    if (find("percuss_measured_create")) {
        demand(!FIND(percuss_measured_create)(1, &IMPACT, &valid.measured), "measured");
        valid.question = FIND(percuss_measured_question_default)(
            valid.client, &valid.bodies.bodies[0], &valid.bodies.bodies[1]);
    }
}

static void free_all(void)
{
    if (find("percuss_ensemble_worker_free"))
        FIND(percuss_ensemble_worker_free)(valid.worker);
    if (find("percuss_client_free")) {
        FIND(percuss_client_free)(valid.client);
        FIND(percuss_body_list_free)(&valid.bodies);
    }
    if (find("percuss_slow_free"))
        FIND(percuss_slow_free)(valid.slow);
    if (find("percuss_measured_free"))
        FIND(percuss_measured_free)(valid.measured);
}

/* Pointers within what is given, and arrays that are said to have elements. */
static void call_with_members(void)
{
    if (find_own("percuss_contact_pair")) {
        struct percuss_pair pair = valid.pair;
        struct percuss_body_list bodies = {.count = 1};
        called = "percuss_contact_pair";
        pair.b = NULL;
        begin("pair.b");
        end(false, true, FIND(percuss_contact_pair)(&pair, &valid.filled));
        called = "percuss_body_find";
        begin("list->bodies");
        (void)FIND(percuss_body_find)(&bodies, "al-rod");
        end(false, false, PERCUSS_RESULT_OK);
        called = "a function that frees";
        begin("an array");
        made.bodies.count = made.servers.count = made.specimens.count = 1;
        made.trace.contact_count = 1;
        tidy();
    }
    if (find_own("percuss_local_open")) {
        called = "percuss_solve_ensemble";
        begin("inputs[0].values");
        valid.ensemble.inputs[0].value_count = 2;
        end(false, true,
            FIND(percuss_solve_ensemble)(valid.client, &valid.ensemble, 1.0, NULL, NULL,
                                         &made.ensemble));
    }
    if (find_own("percuss_slow_poisson")) {
        called = "percuss_slow_poisson";
        begin("outcome->impulse");
        made.outcome.impulse = NULL;
        (void)FIND(percuss_slow_poisson)(1, valid.numbers, valid.numbers, valid.numbers,
                                         &made.outcome);
        end(false, false, PERCUSS_RESULT_OK);
    }
    if (find_own("percuss_measured_read")) {
        static const char *const none[] = {"speed=v", NULL};
        called = "percuss_measured_read";
        begin("columns[1]");
        end(false, true, FIND(percuss_measured_read)("nothing", 2, none, &made.measured));
        called = "percuss_measured_read_file";
        begin("uncertainties");
        const struct percuss_measured_file file = {.file = "nothing", .uncertainty_count = 1};
        end(false, true, FIND(percuss_measured_read_file)(&file, &made.measured));
        called = "percuss_measured_compare";
        begin("client");
        valid.question.client = NULL;
        end(false, true,
            FIND(percuss_measured_compare)(valid.measured, &valid.question, &made.comparison));
    }
}

static void call_all(const char *catalogue, bool *known)
{
    void *texts[] = {find_own("percuss_slow_error_text"), find_own("percuss_measured_error_text"),
                     find_own("percuss_error_text")};
    for (size_t i = 0; i < 3 && !error_text; i++)
        error_text = (const char *(*)(void))texts[i];
    demand(error_text, "no error text");
    make_all(catalogue);
    for (size_t i = 0; i < sizeof CALLS / sizeof *CALLS; i++) {
        if (!find_own(CALLS[i].name))
            continue;
        known[i] = true;
        called = CALLS[i].name;
        CALLS[i].function();
    }
    call_with_members();
    free_all();
    error_text = NULL;
}

int main(int argc, char **argv)
{
    static bool known[sizeof CALLS / sizeof *CALLS];
    const struct sigaction at_crash = {.sa_handler = crashed};
    char domain[16];
    sigaction(SIGSEGV, &at_crash, NULL);
    sigaction(SIGBUS, &at_crash, NULL);
    sigaction(SIGABRT, &at_crash, NULL);
    snprintf(domain, sizeof domain, "%u", domain_draw());
    setenv("PERCUSS_DOMAIN", domain, 1);
    alarm(120);
    for (int i = 2; i < argc; i++) {
        library = argv[i];
        handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
        demand(handle, "cannot be loaded");
        call_all(argv[1], known);
        dlclose(handle);
    }
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (!known[i]) {
            fprintf(stderr, "%s: in no library\n", CALLS[i].name);
            faults++;
        }
    printf("%d calls of %zu functions, %d faults\n", calls, sizeof known / sizeof *known, faults);
    return faults || calls < 200 ? EXIT_FAILURE : EXIT_SUCCESS;
}
