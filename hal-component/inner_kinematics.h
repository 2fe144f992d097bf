/* The kinematics module behind the frames (inner=). loadrt loads it behind framekins, which motmod finds first: of equal
 * names in modules the one that came first counts. framekins takes the other's functions by name when motmod, which comes
 * last, asks for the type of the kinematics; that is while modules are loaded, and never in the servo thread.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_INNER_KINEMATICS_H
#define FRAMEPATH_INNER_KINEMATICS_H

#include <dlfcn.h>
#include <unistd.h>
#include "rtapi.h"
#include "kinematics.h"

#include "framepath.h"
#include "loaded_beside.h"

/* LinuxCNC's functions of a kinematics module, as they are found. */
struct kinematics_functions {
    int (*forward)(const double *, struct EmcPose *, const KINEMATICS_FORWARD_FLAGS *, KINEMATICS_INVERSE_FLAGS *);
    int (*inverse)(const struct EmcPose *, double *, const KINEMATICS_INVERSE_FLAGS *, KINEMATICS_FORWARD_FLAGS *);
    KINEMATICS_TYPE (*type)(void);
    int (*switchable)(void);
    int (*change)(int);
};

static struct {
    void *module;
    KINEMATICS_TYPE type;
    int missed;
} inner_found;

static struct kinematics_functions functions_of(void *module)
{
    struct kinematics_functions found;
    *(void **)&found.forward = dlsym(module, "kinematicsForward");
    *(void **)&found.inverse = dlsym(module, "kinematicsInverse");
    *(void **)&found.type = dlsym(module, "kinematicsType");
    *(void **)&found.switchable = dlsym(module, "kinematicsSwitchable");
    *(void **)&found.change = dlsym(module, "kinematicsSwitch");
    return found;
}

/* 0, or -1 with the reason said, when there is no such module to be loaded behind this one. */
static int check_inner_file(const char *name, const void *here)
{
    struct module_file file = file_beside(name, here);
    if (!file.path[0] || access(file.path, R_OK) == 0)
        return 0;
    rtapi_print_msg(RTAPI_MSG_ERR, "framekins: inner=%s: there is no %s; write the module of [KINS]KINEMATICS without its "
                    "parameters, as in: loadrt framekins inner=xyzac-trt-kins\n", name, file.path);
    return -1;
}

/* Whether this address, from which a function was called, is in the module itself: while it is loaded it may ask for its
 * own type, and the call is led to the module that came first. */
static int is_in_inner(const char *name, const void *here, const void *caller)
{
    Dl_info from;
    return dladdr(caller, &from) && !strcmp(from.dli_fname, file_beside(name, here).path);
}

/* Says once why the module cannot be had. */
static void tell_missed(const char *name, const char *function)
{
    if (inner_found.missed)
        return;
    inner_found.missed = 1;
    if (function)
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: inner=%s has no %s, so that it is no kinematics module for a frame: write the "
                        "module of [KINS]KINEMATICS\n", name, function);
    else
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: inner=%s is not loaded: write loadrt framekins inner=%s, then loadrt %s with its "
                        "parameters (loadrt [KINS]KINEMATICS), then loadrt motmod in the HAL files\n", name, name, name);
}

/* Says once that there are no types to choose from. */
static void tell_one_type(const char *name, const char *tool_types)
{
    if (!inner_found.missed)
        rtapi_print_msg(RTAPI_MSG_ERR, "framekins: tool_types=%s: inner=%s has one type only, which is 0: write tool_types=0, or leave "
                        "it out if these kinematics do not turn the tool's length\n", tool_types, name);
    inner_found.missed = 1;
}

/* What the module answers when it asks for its own type; one that has none is no kinematics module, motmod for one. */
static KINEMATICS_TYPE own_type_of_inner(const char *name, const void *here)
{
    void *module = loaded_beside(name, here);
    KINEMATICS_TYPE (*type)(void) = module ? functions_of(module).type : NULL;
    KINEMATICS_TYPE answer = type ? type() : KINEMATICS_BOTH;
    if (!type)
        tell_missed(name, "kinematicsType");
    if (module)
        dlclose(module);
    return answer;
}

/* Finds the module. Its type is asked for once, before it is switched: some make their pins then. 0, or -1 with the reason
 * said. */
static int find_inner(const char *name, const char *tool_types, const void *here)
{
    void *module = loaded_beside(name, here);
    struct kinematics_functions found;
    const char *lacks;
    if (!module) {
        tell_missed(name, NULL);
        return -1;
    }
    found = functions_of(module);
    lacks = !found.inverse ? "kinematicsInverse" : !found.forward ? "kinematicsForward" : !found.type ? "kinematicsType" : NULL;
    if (lacks) {
        tell_missed(name, lacks);
        dlclose(module);
        return -1;
    }
    inner_found.type = found.type();
    if (!found.switchable || !found.switchable())
        found.change = NULL;
    if (framepath_kinematics_inner_functions(found.inverse, found.forward, found.change)) {
        tell_one_type(name, tool_types);
        dlclose(module);
        return -1;
    }
    inner_found.module = module;
    if (found.change)
        found.change(0);
    return 0;
}

/* When framekins is unloaded. */
static void forget_inner(void)
{
    if (inner_found.module)
        dlclose(inner_found.module);
    inner_found.module = NULL;
}

#endif
