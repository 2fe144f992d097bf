/* M66, whose answers are the machine's: what the program waits for comes at once, and what it only looks at is 0.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <cctype>
#include <cstdio>
#include <cstring>
#include <string>
#include "canon.hh"
#include "calls.hh"

static bool waited_for_on;

/* The call of an M66 that does not wait: it is told where the program looks at its answer. Many only want motion to end. */
static std::string not_looked_at;

int WAIT(int index, int kind, int mode, double)
{
    char call[80];
    fputs("WAIT\n", output);
    snprintf(call, sizeof call, "INPUT %d %d %d\n", kind == ANALOG_INPUT, index, mode);
    bool waits = mode != WAIT_MODE_IMMEDIATE;
    not_looked_at = waits ? "" : call;
    if (waits)
        fputs(call, output);
    waited_for_on = mode == WAIT_MODE_RISE || mode == WAIT_MODE_HIGH;
    return 0;
}

int GET_EXTERNAL_DIGITAL_INPUT(int, int) { return waited_for_on; }
double GET_EXTERNAL_ANALOG_INPUT(int, double) { return 0; }

/* Whether a line has #5399. */
static bool has_answer(const char *line)
{
    for (const char *at = strchr(line, '#'); at; at = strchr(at + 1, '#')) {
        const char *number = at + 1 + strspn(at + 1, " \t");
        if (!strncmp(number, "5399", 4) && !isdigit((unsigned char)number[4]))
            return true;
    }
    return false;
}

void look_for_answer(const char *line)
{
    if (not_looked_at.empty() || !has_answer(line))
        return;
    fputs(not_looked_at.c_str(), output);
    not_looked_at.clear();
}
