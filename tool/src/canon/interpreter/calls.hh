/* What the interpreter's calls leave behind for the main program.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#pragma once
#include <cstdio>

/* Where the calls are printed to. */
extern FILE *output;

/* The file of numbered parameters. */
void parameter_file(const char *name);

/* A code that is a program of the machine; false if none from M100 to M199 is meant. */
bool know_user_code(int code);

/* A line that is carried out: whether it looks at the answer of M66 (inputs.cc). */
void look_for_answer(const char *line);

/* Reads what an INI file says of the machine (settings.cc); false if it cannot be understood. */
bool read_settings(const char *file);

/* Name of the first call that cannot be printed, or a null pointer. */
const char *unsupported_call();

/* Names one that is none of the interpreter's calls. */
void refuse_call(const char *what);

/* From here on Python that stands in a program is refused (python.cc). */
void refuse_python();
