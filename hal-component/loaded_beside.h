/* Other modules that are loaded, from the same folder as this one.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_LOADED_BESIDE_H
#define FRAMEPATH_LOADED_BESIDE_H

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

/* The file of a module of this name in the folder of the module that `here` is an address in. */
struct module_file {
    char path[4096];
};

/* An empty path if it cannot be told. */
static struct module_file file_beside(const char *name, const void *here)
{
    struct module_file file = {""};
    Dl_info own;
    const char *slash = dladdr(here, &own) ? strrchr(own.dli_fname, '/') : NULL;
    int size = slash ? snprintf(file.path, sizeof file.path, "%.*s/%s.so", (int)(slash - own.dli_fname), own.dli_fname, name) : -1;
    if (size < 0 || size >= (int)sizeof file.path)
        file.path[0] = 0;
    return file;
}

/* The file of the module that `here` is an address in. */
static inline struct module_file own_file(const void *here)
{
    struct module_file file = {""};
    Dl_info own;
    if (dladdr(here, &own))
        snprintf(file.path, sizeof file.path, "%s", own.dli_fname);
    return file;
}

/* A module of this name if it is loaded, to be given back with dlclose, else NULL. */
static void *loaded_beside(const char *name, const void *here)
{
    struct module_file file = file_beside(name, here);
    return file.path[0] ? dlopen(file.path, RTLD_LAZY | RTLD_NOLOAD) : NULL;
}

/* Whether such a module is loaded. */
static inline int is_loaded(const char *name, const void *here)
{
    void *module = loaded_beside(name, here);
    if (module)
        dlclose(module);
    return module != NULL;
}

#endif
