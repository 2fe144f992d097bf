/* Stands where HAL stands, so that a kinematics module can be loaded into an ordinary process and called at full speed:
 * keeps the pins and functions that a module makes under their names, and the messages it prints.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 256 };

/* pin: where the module has the address of the place, NULL where that is no pin. */
static struct { char name[64]; void *place, **pin; } entries[MOST];
static int count;
static char messages[65536];

/* A place of eight bytes under a name. */
static int keep(const char *name, void *place)
{
    if (count == MOST)
        return -12;
    snprintf(entries[count].name, sizeof entries[count].name, "%s", name);
    entries[count].pin = 0;
    entries[count++].place = place;
    return 0;
}

static int new_pin(void **pin, const char *format, va_list arguments)
{
    char name[64];
    vsnprintf(name, sizeof name, format, arguments);
    *pin = calloc(1, 8);
    int result = keep(name, *pin);
    if (!result)
        entries[count - 1].pin = pin;
    return result;
}

/* For the test: the pin or function of a name, and everything forgotten. */
void *host_find(const char *name)
{
    for (int i = 0; i < count; i++)
        if (!strcmp(entries[i].name, name))
            return entries[i].place;
    return 0;
}

/* Links a pin: its value is elsewhere then. */
void host_link(const char *name)
{
    for (int i = 0; i < count; i++)
        if (!strcmp(entries[i].name, name) && entries[i].pin)
            entries[i].place = *entries[i].pin = calloc(1, 8);
}

const char *host_messages(void)
{
    return messages;
}

void host_forget(void)
{
    count = 0;
    messages[0] = 0;
}

int hal_init(const char *name) { (void)name; return 1; }
int hal_exit(int component) { (void)component; return 0; }
int hal_ready(int component) { (void)component; return 0; }
int hal_set_unready(int component) { (void)component; return 0; }
void *hal_malloc(long size) { return calloc(1, size); }

int hal_export_funct(const char *name, void (*function)(void *, long), void *argument, int fp, int reentrant, int component)
{
    (void)argument; (void)fp; (void)reentrant; (void)component;
    char key[64];
    snprintf(key, sizeof key, "function %s", name);
    return keep(key, (void *)function);
}

#define NEW_PIN(kind) \
    int hal_pin_##kind##_newf(int direction, void **pin, int component, const char *format, ...) \
    { \
        (void)direction; (void)component; \
        va_list arguments; \
        va_start(arguments, format); \
        int result = new_pin(pin, format, arguments); \
        va_end(arguments); \
        return result; \
    } \
    int hal_pin_##kind##_new(const char *name, int direction, void **pin, int component) \
    { \
        return hal_pin_##kind##_newf(direction, pin, component, "%s", name); \
    }

NEW_PIN(bit)
NEW_PIN(float)
NEW_PIN(s32)
NEW_PIN(u32)

/* What modules of LinuxCNC 2.10 call: pins and parameters are both places of HAL's, which begin with a value. */
#define NEW_WITH_VALUE(what, kind, type) \
    int hal_##what##_new_##kind(int component, int direction, void **place, type value, const char *format, ...) \
    { \
        (void)direction; (void)component; \
        va_list arguments; \
        va_start(arguments, format); \
        int result = new_pin(place, format, arguments); \
        va_end(arguments); \
        memcpy(*place, &value, sizeof value); \
        return result; \
    }

NEW_WITH_VALUE(pin, bool, bool)
NEW_WITH_VALUE(pin, si32, int)
NEW_WITH_VALUE(pin, ui32, unsigned)
NEW_WITH_VALUE(pin, sint, long long)
NEW_WITH_VALUE(pin, uint, unsigned long long)
NEW_WITH_VALUE(pin, real, double)
NEW_WITH_VALUE(param, real, double)

int hal_param_float_newf(int direction, double *place, int component, const char *format, ...)
{
    (void)direction; (void)component;
    char name[64];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(name, sizeof name, format, arguments);
    va_end(arguments);
    return keep(name, place);
}

long long rtapi_get_time(void) { return 0; }

int rtapi_snprintf(char *text, unsigned long size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, size, format, arguments);
    va_end(arguments);
    return length;
}

static void note(const char *format, va_list arguments)
{
    size_t used = strlen(messages);
    vsnprintf(messages + used, sizeof messages - used, format, arguments);
}

void rtapi_print(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    note(format, arguments);
    va_end(arguments);
}

void rtapi_print_msg(int level, const char *format, ...)
{
    (void)level;
    va_list arguments;
    va_start(arguments, format);
    note(format, arguments);
    va_end(arguments);
}
