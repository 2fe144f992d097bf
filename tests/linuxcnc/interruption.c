/* interruption: a module for tests that stops the servo thread where it is called, as another process may do.
 *
 * Between the handler of commands and the motion controller it shows what a task sees that reads between the two.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <time.h>
#include "rtapi.h"
#include "rtapi_app.h"
#include "hal.h"

MODULE_AUTHOR("the framepath authors");
MODULE_DESCRIPTION("A servo thread that is interrupted");
MODULE_LICENSE("GPL");

static int component;

/* Half a period, so that one look of task in two falls into it. */
static void stop(void *unused, long period)
{
    (void)unused;
    const struct timespec half = {.tv_sec = 0, .tv_nsec = period / 2};
    nanosleep(&half, 0);
}

int rtapi_app_main(void)
{
    component = hal_init("interruption");
    if (component < 0)
        return component;
    if (hal_export_funct("interruption", stop, 0, 0, 0, component)) {
        hal_exit(component);
        return -1;
    }
    hal_ready(component);
    return 0;
}

void rtapi_app_exit(void)
{
    hal_exit(component);
}
