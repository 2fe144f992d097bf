/* What [AXIS_L]MAX_JERK in the INI says. A line of HAL takes it to the pin. LinuxCNC 2.9 does not know this key, and where
 * that line is forgotten the limit is not there; 2.10 does, and the pin begins with it. The script `linuxcnc` names the INI in INI_FILE_NAME.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_INI_JERK_H
#define FRAMEPATH_INI_JERK_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Reads the limits of `axes` axes with these letters; 0 where there is none. For the time of loading: it opens a file. */
static void read_ini_jerk(const char *letters, int axes, double *jerk)
{
    const char *path = getenv("INI_FILE_NAME");
    FILE *ini = path ? fopen(path, "re") : NULL;
    char line[1024], letter, bracket;
    int axis = -1;
    double value;
    for (int i = 0; i < axes; i++)
        jerk[i] = 0.0;
    while (ini && fgets(line, sizeof line, ini)) {
        if (strspn(line, " \t") == strcspn(line, "[")) {
            const char *place = sscanf(line, " [AXIS_%c%c", &letter, &bracket) == 2 && bracket == ']' ? strchr(letters, letter - 'A' + 'a') : NULL;
            axis = place && *place ? place - letters : -1;
        } else if (axis >= 0 && jerk[axis] == 0.0 && sscanf(line, " MAX_JERK = %lf", &value) == 1) {
            jerk[axis] = value;
        }
    }
    if (ini)
        fclose(ini);
}

#endif
