/* Whether a module is loaded that nobody uses.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_LOADED_BESIDE_H
#define FRAMEPATH_LOADED_BESIDE_H

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

/* Whether a module of this name, in the same folder as this one, is loaded as well. */
static int is_loaded(const char *name, const void *here)
{
    Dl_info own;
    char path[4096];
    const char *slash = dladdr(here, &own) ? strrchr(own.dli_fname, '/') : NULL;
    void *module;
    if (!slash || snprintf(path, sizeof path, "%.*s/%s.so", (int)(slash - own.dli_fname), own.dli_fname, name) >= (int)sizeof path)
        return 0;
    module = dlopen(path, RTLD_LAZY | RTLD_NOLOAD);
    if (module)
        dlclose(module);
    return module != NULL;
}

#endif
