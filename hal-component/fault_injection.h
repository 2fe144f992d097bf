/* Only in builds for tests (-DFRAMEPATH_FAULT_INJECTION): the planner fails in a servo period of one's choice, as if it
 * had broken its own rules. Part of blendtp.c.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */

/* The library has it with its feature fault-injection; not in framepath.h, since no module that is used calls it. */
void framepath_planner_inject_fault(struct framepath_planner *handle);

static struct {
    /* In which servo period from the first move on the planner fails; 0: in none, and counted anew. */
    hal_s32_t *period;
    /* Whether it has. */
    hal_s32_t *injected;
} *fault_pins;

static int make_fault_pins(void)
{
    fault_pins = hal_malloc(sizeof *fault_pins);
    return !fault_pins || hal_pin_s32_newf(HAL_IN, &fault_pins->period, component, "blendtp.fault-period")
           || hal_pin_s32_newf(HAL_OUT, &fault_pins->injected, component, "blendtp.fault-injected");
}

static void inject_fault(TP_STRUCT const *tp)
{
    static int periods;
    if (!*fault_pins->period)
        periods = *fault_pins->injected = 0;
    else if (periods || !tp->done)
        periods++;
    if (periods && periods == *fault_pins->period) {
        *fault_pins->injected = 1;
        framepath_planner_inject_fault(planner);
    }
}
