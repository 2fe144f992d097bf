/* Who gives a function to motmod: the first module that was loaded with it. A second one of the same kind is loaded
 * without a word, makes its pins, and is never called.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_FIRST_LOADED_H
#define FRAMEPATH_FIRST_LOADED_H

#include <dlfcn.h>
#include <stddef.h>
#include "rtapi.h"

/* The file that motmod would take a function from instead of from this module; NULL if it is this module.
 * `here` is an address in this module: that of a function with an exported name may be the other module's. */
static const char *taken_from(const char *function, const void *here)
{
    Dl_info first, own;
    void *address = dlsym(RTLD_DEFAULT, function);
    if (!address || !dladdr(address, &first) || !dladdr(here, &own) || first.dli_fbase == own.dli_fbase)
        return NULL;
    return first.dli_fname;
}

/* 0, or -1 with the reason said, when this module would be loaded for nothing. */
static int check_first(const char *module, const char *function, const void *here, const char *remedy)
{
    const char *other = taken_from(function, here);
    if (!other)
        return 0;
    rtapi_print_msg(RTAPI_MSG_ERR, "%s: %s is loaded already and would be taken in its place: %s\n", module, other, remedy);
    return -1;
}

#endif
