/* Which LinuxCNC the modules were built for, and which one runs: its layouts and functions change between 2.9 and 2.10,
 * and nothing in the loader looks at that. No header carries a version; the script `linuxcnc`, which is installed with
 * the rest of LinuxCNC, does: the Makefile reads it beside the headers (FRAMEPATH_BUILT_FOR), and the module reads it
 * beside the program that loads it.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_LINUXCNC_VERSION_H
#define FRAMEPATH_LINUXCNC_VERSION_H

#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include "rtapi.h"

/* The remedy is the same for all that is found. */
#define INSTALL_AGAIN "in framepath's sources: make install again"

struct linuxcnc_version {
    char text[64];
};

/* What a script says; an empty text if there is none, or if it says nothing. */
static struct linuxcnc_version version_in(const char *script)
{
    struct linuxcnc_version version = {""};
    char line[512];
    FILE *file = fopen(script, "re");
    if (!file)
        return version;
    while (!version.text[0] && fgets(line, sizeof line, file))
        if (sscanf(line, "LINUXCNCVERSION=\"%63[^\"]", version.text) != 1)
            version.text[0] = 0;
    fclose(file);
    return version;
}

/* What the module is built for, behind words by which framepath check finds it in the module's file. */
#define BUILT_FOR_MARK "framepath built for LinuxCNC "
static const char built_for_text[] = BUILT_FOR_MARK FRAMEPATH_BUILT_FOR;

static const char *built_for(void)
{
    return built_for_text + sizeof BUILT_FOR_MARK - 1;
}

/* The version of the LinuxCNC that this process belongs to, installed or run in place; empty if it cannot be seen. */
static struct linuxcnc_version running_version(void)
{
    static const char *const places[] = {"linuxcnc", "../scripts/linuxcnc"};
    struct linuxcnc_version version = {""};
    char path[4096 + 32];
    ssize_t length = readlink("/proc/self/exe", path, 4096);
    char *name = length > 0 ? memrchr(path, '/', length) : NULL;
    for (unsigned i = 0; name && !version.text[0] && i < sizeof places / sizeof places[0]; i++) {
        strcpy(name + 1, places[i]);
        version = version_in(path);
    }
    return version;
}

/* Whether both are known and of different series (2.9 and 2.10); within a series the interface does not change. */
static int other_series(const char *one, const char *other)
{
    int major[2], minor[2];
    if (sscanf(one, "%d.%d", &major[0], &minor[0]) != 2 || sscanf(other, "%d.%d", &major[1], &minor[1]) != 2)
        return 0;
    return major[0] != major[1] || minor[0] != minor[1];
}

static const char *or_unknown(const char *version)
{
    return version[0] ? version : "an unknown version";
}

/* Says that a module and this LinuxCNC do not fit; `found` names what was seen. */
static void say_built_for_another(const char *module, const char *found)
{
    rtapi_print_msg(RTAPI_MSG_ERR, "%s: built for LinuxCNC %s, running under LinuxCNC %s%s: %s\n", module,
                    or_unknown(built_for()), or_unknown(running_version().text), found, INSTALL_AGAIN);
}

/* 0, or -1 with the reason said, when a module is loaded by a LinuxCNC of another series than it was built for. */
static int check_version(const char *module)
{
    if (!other_series(built_for(), running_version().text))
        return 0;
    say_built_for_another(module, "");
    return -1;
}

#endif
