/* What stubs.c, which stands where RTAPI and HAL stand, offers to the drivers of this folder, and how they say what is wrong.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_TEST_HOST_H
#define FRAMEPATH_TEST_HOST_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int framepath_host_set(const char *ending, double value);
const char *framepath_host_first_error(void);
unsigned long framepath_host_errors(void);
void framepath_host_forget_errors(void);
void framepath_host_run_functions(void);
int rtapi_app_main(void);
void rtapi_app_exit(void);

/* Ends the process where something is not as it has to be. */
#define REQUIRE(condition) \
    do { \
        if (!(condition)) { \
            fprintf(stderr, "%s:%d: not so: %s (first message: %s)\n", __FILE__, __LINE__, #condition, \
                    framepath_host_first_error()); \
            exit(1); \
        } \
    } while (0)

/* With "fault" as last argument a driver reads beyond what it has asked for: the tools have to see that. */
static inline void commit_fault(int argc, char **argv)
{
    volatile int place = 9;
    char *block = calloc(1, 8);
    if (!strcmp(argv[argc - 1], "fault"))
        printf("%s\n", block[place] ? "something" : "nothing");
    free(block);
}

#endif
