/* Pins of HAL as programs see them by #<_hal[..]>: those that tell the type of the kinematics, of which remaps make sure before
 * they switch them. Others are those of the HAL that runs, if one does.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#define ULAPI
#include <cstring>
#include <dlfcn.h>
#include <hal.h>
#include "calls.hh"
#include "state.hh"

static const char *const type_pins[] = {"motion.switchkins-type", "framekins.inner-type"};

static bool is_type(const char *name)
{
    for (const char *pin : type_pins)
        if (!strcmp(name, pin))
            return true;
    return false;
}

static int type_of_the_kinematics()
{
    /* Remaps that do not find it end the program there, and no move behind them would be planned. */
    if (machine.switch_output < 0)
        refuse_call("a program that asks for the type of the kinematics (no HAL file leads an analog output of motion to it)");
    return now.kinematics_type;
}

/* What follows is in the place of liblinuxcnchal's. */
extern "C" int hal_get_pin_value_by_name(const char *name, hal_type_t *type, hal_data_u **data, bool *connected)
{
    static hal_data_u value;
    if (is_type(name)) {
        value.s = type_of_the_kinematics();
        *type = HAL_S32;
        *data = &value;
        *connected = true;
        return 0;
    }
    auto others = reinterpret_cast<decltype(&hal_get_pin_value_by_name)>(dlsym(RTLD_NEXT, "hal_get_pin_value_by_name"));
    return others ? others(name, type, data, connected) : -1;
}

#ifdef LINUXCNC_HAS_HAL_QUERIES
/* The interpreter of 2.10 asks this before, and for no pin where there is no HAL. */
extern "C" int hal_is_init() { return 1; }

extern "C" int hal_get_p(hal_query_t *query, hal_query_cb found, void *argument)
{
    if (is_type(query->name)) {
        query->pp.type = HAL_S32;
        query->pp.value.s = type_of_the_kinematics();
        query->pp.signal = query->name;
        return 0;
    }
    auto others = reinterpret_cast<decltype(&hal_get_p)>(dlsym(RTLD_NEXT, "hal_get_p"));
    return others ? others(query, found, argument) : -1;
}
#endif
