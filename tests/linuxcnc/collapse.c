/* collapse: a module for tests that ends the process of all modules when its pin says so.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <stdlib.h>
#include "rtapi.h"
#include "rtapi_app.h"
#include "hal.h"

MODULE_AUTHOR("the framepath authors");
MODULE_DESCRIPTION("Modules that come to an end");
MODULE_LICENSE("GPL");

static int component;
static hal_bit_t **now;

static void collapse(void *unused, long period)
{
    (void)unused;
    (void)period;
    if (**now)
        _Exit(1);
}

int rtapi_app_main(void)
{
    component = hal_init("collapse");
    if (component < 0)
        return component;
    now = hal_malloc(sizeof *now);
    if (!now || hal_pin_bit_new("collapse.now", HAL_IN, now, component)
        || hal_export_funct("collapse", collapse, 0, 0, 0, component)) {
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
