/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Shared by the commands: options, exit codes, the connection. */
#ifndef PERCUSS_CLI_CLI_H
#define PERCUSS_CLI_CLI_H

#include <argp.h>
#include <percuss/percuss.h>

enum exit_code {
    EXIT_ANSWERED,
    EXIT_ANSWERED_WITH_WARNING,
    EXIT_USAGE,
    EXIT_NO_SERVER,
    EXIT_TIMEOUT,
    EXIT_REJECTED
};

/* As percuss_solve_ensemble. */
typedef enum percuss_result solve_ensemble_function(
    struct percuss_client *client, const struct percuss_ensemble_request *request, double timeout,
    percuss_progress_function *progress, void *context, struct percuss_ensemble_reply *reply);

/* Options of every command, and the solver of ensembles. */
struct common {
    uint32_t domain;
    double timeout; /* s for the answer; NAN: not given */
    bool json;
    bool units;                          /* in the head of comma-separated values */
    char server[PERCUSS_SERVER_ID_SIZE]; /* beginning of its id, or a choice; empty: any */
    const char *partition;               /* NULL: not given; empty: none */
    const char *security;                /* folder of the identity to use; NULL: not given */
    bool local;                          /* solve in this process; by these files, or NULL */
    const char *catalogue, *config;
    char *const *words; /* the whole command line, NULL at its end; NULL: not known */
    solve_ensemble_function *solve_ensemble; /* NULL: percuss_solve_ensemble */
};

/* Long options without a letter; each command goes on from OPTION_OWN. */
enum option_key {
    OPTION_DOMAIN = 256,
    OPTION_TIMEOUT,
    OPTION_JSON,
    OPTION_UNITS,
    OPTION_SERVER,
    OPTION_SECURITY,
    OPTION_PARTITION,
    OPTION_LOCAL,
    OPTION_CATALOGUE,
    OPTION_CONFIG,
    OPTION_SCENE,
    OPTION_PLOT = 290,
    OPTION_PLOT_DATA,
    OPTION_OWN = 300
};

/* Parses the options that all commands have into the `struct common` that is its input. */
extern const struct argp common_argp;

/* One command: argv[0] is "percuss <command>"; `common` holds the options before the command.
 * Returns an exit code. */
typedef int command_function(int argc, char **argv, struct common *common);
command_function command_query, command_sweep, command_ensemble, command_bodies, command_status,
    command_ping, command_compare, command_calibrate, command_export, command_dents, command_schema,
    command_doctor, command_complete;
/* The options of each. */
extern const struct argp query_argp, sweep_argp, ensemble_argp, bodies_argp, status_argp, ping_argp,
    compare_argp, calibrate_argp, export_argp, dents_argp, schema_argp, doctor_argp;

/* Parses a command line that has no options of its own. */
void parse_only_common(int argc, char **argv, const char *doc, struct common *common);

/* The whole of `text` as a finite number. On failure it ends the process through argp_error. */
double parse_number(const char *option, const char *text, struct argp_state *state);
unsigned parse_count(const char *option, const char *text, unsigned most, struct argp_state *state);

/* Seconds to wait for an answer, and for a server to appear. */
double common_timeout(const struct common *common);
double common_patience(const struct common *common);

/* Whether one server is to be asked and no other. */
bool common_names_server(const struct common *common);

/* Prints "percuss: ..." to stderr. */
void complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* That memory has run out; returns the exit code for it. */
int complain_memory(void);

/* That the user has ended it; returns the exit code for it. */
int complain_interrupted(void);

/* Prints the library's error of a call and returns its exit code. */
int complain_result(enum percuss_result result);

/* That there is no server, for the reason that the library gave last, in which domains there is
 * one, and how to start one here. */
void complain_no_server(const struct common *common);

/* The DDS domain that PERCUSS_DOMAIN names, 0 without; any other text ends the process. */
uint32_t environment_domain(void);

/* The server that PERCUSS_SERVER names; empty without. */
void environment_server(char server[PERCUSS_SERVER_ID_SIZE]);

/* A client; `id` NULL: random. EXIT_ANSWERED, or complains and leaves *client NULL. With --local it
 * solves in this process, and all is as if it had found a server. */
int make_client(const struct common *common, const uint8_t *id, struct percuss_client **client);

/* Connects it; EXIT_ANSWERED, or complains. */
int connect_client(const struct common *common, struct percuss_client *client);

/* Both. Warns of servers that answer beside the one it stays with. */
int open_client(const struct common *common, const uint8_t *id, struct percuss_client **client);

/* The same for what servers announce to everybody: not connected where its identity may see
 * announcements only. */
int open_onlooker(const struct common *common, struct percuss_client **client);

/* The exit code of a reply. */
int status_exit_code(enum percuss_status status);

/* Writes the octets as hexadecimal digits with a terminating zero. */
void format_hex(const uint8_t octets[16], char text[33]);

#endif
