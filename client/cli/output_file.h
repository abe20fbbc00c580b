/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Files that a command is told to write. */
#ifndef PERCUSS_CLI_OUTPUT_FILE_H
#define PERCUSS_CLI_OUTPUT_FILE_H

#include <argp.h>
#include <stddef.h>

/* Ends the process (exit code 2, the option, the file and why) unless the file can be written:
 * asked before there is an answer that could be lost. The file keeps its content. */
void output_file_check(const char *option, const char *file, struct argp_state *state);

/* Likewise of a folder, which may not be there yet. */
void output_folder_check(const char *option, const char *folder, struct argp_state *state);

/* Makes it unless it is there. Exit code; complains in the option's name. */
int output_folder_make(const char *option, const char *folder);

/* From now on no file is tried: another process of the same command line has done so, and writes.
 */
void output_file_trust(void);

/* Writes it all. Exit code; complains in the option's name. */
int output_file_write(const char *option, const char *file, const void *bytes, size_t size);

#endif
