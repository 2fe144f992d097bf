/* Stands where RTAPI, HAL and the kinematics stand for a planner module: enough to load one into an ordinary process and to
 * drive it. The build script makes a shared object of it, which is loaded before everything else (LD_PRELOAD) in the
 * process that drives the module; so it also sees every call of the heap.
 *
 * What the driver uses begins with framepath_host_.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "rtapi.h"
#include "hal.h"
#include "emcpos.h"
#include "kinematics.h"

#define EXPORTED __attribute__((visibility("default")))

/* ------------------------------------------------------------------ heap */

#ifdef HOST_KEEPS_HEAP
/* Where a sanitizer or valgrind has the heap. */
#define memory calloc
EXPORTED void framepath_host_watch_heap(int on) { (void)on; }
EXPORTED unsigned long framepath_host_heap_calls(void) { return 0; }
#else
#define memory __libc_calloc

extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);
extern void __libc_free(void *);

static volatile int watching;
static volatile unsigned long heap_calls;

/* From here on calls of the heap are counted (1), or not any more (0). */
EXPORTED void framepath_host_watch_heap(int on)
{
    watching = on;
}

EXPORTED unsigned long framepath_host_heap_calls(void)
{
    return heap_calls;
}

static void seen(void)
{
    if (watching)
        heap_calls++;
}

EXPORTED void *malloc(size_t size)
{
    seen();
    return __libc_malloc(size);
}

EXPORTED void *calloc(size_t count, size_t size)
{
    seen();
    return __libc_calloc(count, size);
}

EXPORTED void *realloc(void *block, size_t size)
{
    seen();
    return __libc_realloc(block, size);
}

EXPORTED void free(void *block)
{
    if (block)
        seen();
    __libc_free(block);
}

EXPORTED void *memalign(size_t alignment, size_t size)
{
    seen();
    return __libc_memalign(alignment, size);
}

EXPORTED void *aligned_alloc(size_t alignment, size_t size)
{
    return memalign(alignment, size);
}

EXPORTED int posix_memalign(void **block, size_t alignment, size_t size)
{
    *block = memalign(alignment, size);
    return *block ? 0 : ENOMEM;
}
#endif

/* -------------------------------------------------------------- messages */

static int message_level = RTAPI_MSG_ERR;
static char first_error[512];
static unsigned long errors;

/* The first message of the kind that LinuxCNC shows the operator, and how many there were. */
EXPORTED const char *framepath_host_first_error(void)
{
    return first_error;
}

EXPORTED unsigned long framepath_host_errors(void)
{
    return errors;
}

/* As if nothing had been said yet. */
EXPORTED void framepath_host_forget_errors(void)
{
    first_error[0] = 0;
    errors = 0;
}

static void message(int level, const char *format, va_list values)
{
    if (level != RTAPI_MSG_ERR)
        return;
    if (!errors++)
        vsnprintf(first_error, sizeof first_error, format, values);
}

EXPORTED void rtapi_print(const char *format, ...)
{
    (void)format;
}

EXPORTED void rtapi_print_msg(msg_level_t level, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    message(level, format, values);
    va_end(values);
}

EXPORTED int rtapi_set_msg_level(int level) { message_level = level; return 0; }
EXPORTED int rtapi_get_msg_level(void) { return message_level; }
EXPORTED void rtapi_set_msg_handler(rtapi_msg_handler_t handler) { (void)handler; }
EXPORTED rtapi_msg_handler_t rtapi_get_msg_handler(void) { return NULL; }

EXPORTED int rtapi_vsnprintf(char *text, unsigned long size, const char *format, va_list values)
{
    return vsnprintf(text, size, format, values);
}

EXPORTED int rtapi_snprintf(char *text, unsigned long size, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    int length = vsnprintf(text, size, format, values);
    va_end(values);
    return length;
}

/* ------------------------------------------------------------ other RTAPI */

static long period_ns = 1000000;

EXPORTED void framepath_host_set_period(long ns) { period_ns = ns; }

EXPORTED int rtapi_init(const char *name) { (void)name; return 1; }
EXPORTED int rtapi_exit(int id) { (void)id; return 0; }
EXPORTED long rtapi_clock_set_period(long ns) { (void)ns; return period_ns; }
EXPORTED void rtapi_delay(long ns) { (void)ns; }
EXPORTED long rtapi_delay_max(void) { return 10000; }
EXPORTED int rtapi_is_kernelspace(void) { return 0; }
EXPORTED int rtapi_is_realtime(void) { return 0; }

EXPORTED long long rtapi_get_time(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000000000LL + now.tv_nsec;
}

EXPORTED long long rtapi_get_clocks(void) { return rtapi_get_time(); }

#define SHARED_BLOCKS 16
static struct { int key; void *block; } shared[SHARED_BLOCKS];

EXPORTED int rtapi_shmem_new(int key, int module, unsigned long size)
{
    (void)module;
    for (int i = 0; i < SHARED_BLOCKS; i++) {
        if (shared[i].block && shared[i].key == key)
            return i + 1;
        if (!shared[i].block) {
            shared[i].key = key;
            shared[i].block = memory(1, size);
            return shared[i].block ? i + 1 : -ENOMEM;
        }
    }
    return -ENOMEM;
}

EXPORTED int rtapi_shmem_getptr(int id, void **block)
{
    if (id < 1 || id > SHARED_BLOCKS || !shared[id - 1].block)
        return -EINVAL;
    *block = shared[id - 1].block;
    return 0;
}

EXPORTED int rtapi_shmem_delete(int id, int module) { (void)id; (void)module; return 0; }

/* ------------------------------------------------------------------- HAL */

#define ITEMS 1024
#define NAME_SIZE 128
static struct item { char name[NAME_SIZE]; hal_type_t type; hal_data_u *value; } items[ITEMS];
static int item_count;

#define FUNCTIONS 8
static struct { void (*call)(void *, long); void *argument; } functions[FUNCTIONS];
static int function_count;

static struct item *find(const char *name)
{
    for (int i = 0; i < item_count; i++)
        if (!strcmp(items[i].name, name))
            return &items[i];
    return NULL;
}

static int add(const char *name, hal_type_t type, void *value)
{
    if (item_count == ITEMS || find(name))
        return -EINVAL;
    snprintf(items[item_count].name, NAME_SIZE, "%s", name);
    items[item_count].type = type;
    items[item_count].value = value;
    item_count++;
    return 0;
}

static int add_pin(const char *name, hal_type_t type, void **pin)
{
    hal_data_u *value = memory(1, sizeof *value);
    if (!value)
        return -ENOMEM;
    *pin = value;
    return add(name, type, value);
}

static void put(struct item *item, double value)
{
    switch (item->type) {
    case HAL_BIT: item->value->b = value != 0; break;
    case HAL_FLOAT: item->value->f = value; break;
    case HAL_U32: item->value->u = (rtapi_u32)value; break;
    default: item->value->s = (rtapi_s32)value; break;
    }
}

static int put_named(const char *name, double value)
{
    struct item *item = find(name);
    if (!item)
        return -EINVAL;
    put(item, value);
    return 0;
}

/* Gives the pin or parameter of this name a value; -EINVAL if there is none. */
EXPORTED int framepath_host_put(const char *name, double value)
{
    return put_named(name, value);
}

/* Gives a value to every pin and parameter whose name, after that of the component, is `ending`; says how many there are. */
EXPORTED int framepath_host_set(const char *ending, double value)
{
    int found = 0;
    for (int i = 0; i < item_count; i++) {
        const char *dot = strchr(items[i].name, '.');
        if (dot && !strcmp(dot + 1, ending)) {
            put(&items[i], value);
            found++;
        }
    }
    return found;
}

/* Runs what the module exported to HAL threads. */
EXPORTED void framepath_host_run_functions(void)
{
    for (int i = 0; i < function_count; i++)
        functions[i].call(functions[i].argument, period_ns);
}

EXPORTED int hal_init(const char *name) { (void)name; return 1; }
EXPORTED int hal_exit(int id) { (void)id; return 0; }
EXPORTED int hal_ready(int id) { (void)id; return 0; }
EXPORTED int hal_unready(int id) { (void)id; return 0; }
EXPORTED int hal_set_unready(int id) { (void)id; return 0; }
EXPORTED char *hal_comp_name(int id) { (void)id; return "framepath"; }
EXPORTED int hal_set_lock(unsigned char type) { (void)type; return 0; }
EXPORTED unsigned char hal_get_lock(void) { return 0; }
EXPORTED int hal_set_constructor(int id, constructor make) { (void)id; (void)make; return 0; }
EXPORTED int hal_pin_alias(const char *name, const char *alias) { (void)name; (void)alias; return 0; }
EXPORTED int hal_param_alias(const char *name, const char *alias) { (void)name; (void)alias; return 0; }
EXPORTED int hal_signal_new(const char *name, hal_type_t type) { (void)name; (void)type; return 0; }
EXPORTED int hal_signal_delete(const char *name) { (void)name; return 0; }
EXPORTED int hal_link(const char *pin, const char *signal) { (void)pin; (void)signal; return 0; }
EXPORTED int hal_unlink(const char *pin) { (void)pin; return 0; }
EXPORTED void *hal_malloc(long size) { return memory(1, size); }

EXPORTED int hal_export_funct(const char *name, void (*call)(void *, long), void *argument, int uses_fp, int reentrant, int id)
{
    (void)name;
    (void)uses_fp;
    (void)reentrant;
    (void)id;
    if (function_count == FUNCTIONS)
        return -ENOMEM;
    functions[function_count].call = call;
    functions[function_count].argument = argument;
    function_count++;
    return 0;
}

EXPORTED int hal_pin_new(const char *name, hal_type_t type, hal_pin_dir_t direction, void **pin, int id)
{
    (void)direction;
    (void)id;
    return add_pin(name, type, pin);
}

EXPORTED int hal_param_new(const char *name, hal_type_t type, hal_param_dir_t direction, void *value, int id)
{
    (void)direction;
    (void)id;
    return add(name, type, value);
}

#define FORMATTED(name, format) \
    char name[NAME_SIZE]; \
    va_list values; \
    va_start(values, format); \
    vsnprintf(name, sizeof name, format, values); \
    va_end(values)

#define PINS_OF_TYPE(type, TYPE) \
    EXPORTED int hal_pin_##type##_new(const char *name, hal_pin_dir_t direction, hal_##type##_t **pin, int id) \
    { \
        (void)direction; \
        (void)id; \
        return add_pin(name, TYPE, (void **)pin); \
    } \
    EXPORTED int hal_pin_##type##_newf(hal_pin_dir_t direction, hal_##type##_t **pin, int id, const char *format, ...) \
    { \
        FORMATTED(name, format); \
        (void)direction; \
        (void)id; \
        return add_pin(name, TYPE, (void **)pin); \
    }

#define PARAMETERS_OF_TYPE(type, TYPE) \
    EXPORTED int hal_param_##type##_new(const char *name, hal_param_dir_t direction, hal_##type##_t *value, int id) \
    { \
        (void)direction; \
        (void)id; \
        return add(name, TYPE, (void *)value); \
    } \
    EXPORTED int hal_param_##type##_newf(hal_param_dir_t direction, hal_##type##_t *value, int id, const char *format, ...) \
    { \
        FORMATTED(name, format); \
        (void)direction; \
        (void)id; \
        return add(name, TYPE, (void *)value); \
    }

PINS_OF_TYPE(bit, HAL_BIT)
PINS_OF_TYPE(float, HAL_FLOAT)
PINS_OF_TYPE(u32, HAL_U32)
PINS_OF_TYPE(s32, HAL_S32)
PARAMETERS_OF_TYPE(bit, HAL_BIT)
PARAMETERS_OF_TYPE(float, HAL_FLOAT)
PARAMETERS_OF_TYPE(u32, HAL_U32)
PARAMETERS_OF_TYPE(s32, HAL_S32)

/* What modules of LinuxCNC 2.10 call, by their names in the object alone: headers of 2.9 have no such types. Pins and
 * parameters are alike there. */
#define WITH_VALUE(what, kind, TYPE, type) \
    EXPORTED int what##_##kind(int id, int direction, void **place, type value, const char *format, ...) \
        __asm__("hal_" #what "_new_" #kind); \
    EXPORTED int what##_##kind(int id, int direction, void **place, type value, const char *format, ...) \
    { \
        FORMATTED(name, format); \
        (void)direction; \
        (void)id; \
        int result = add_pin(name, TYPE, place); \
        return result ? result : put_named(name, value); \
    }

WITH_VALUE(pin, bool, HAL_BIT, int)
WITH_VALUE(pin, si32, HAL_S32, int)
WITH_VALUE(pin, ui32, HAL_U32, unsigned)
WITH_VALUE(pin, real, HAL_FLOAT, double)
WITH_VALUE(param, bool, HAL_BIT, int)
WITH_VALUE(param, si32, HAL_S32, int)
WITH_VALUE(param, ui32, HAL_U32, unsigned)
WITH_VALUE(param, real, HAL_FLOAT, double)

EXPORTED int hal_param_bit_set(const char *name, int value) { return put_named(name, value); }
EXPORTED int hal_param_float_set(const char *name, double value) { return put_named(name, value); }
EXPORTED int hal_param_u32_set(const char *name, unsigned long value) { return put_named(name, value); }
EXPORTED int hal_param_s32_set(const char *name, signed long value) { return put_named(name, value); }

/* ------------- kinematics: the joints are the axes, unless the driver says otherwise */
#ifndef HOST_WITHOUT_KINEMATICS

/* A machine of framekins: what its kinematics functions answer, and what it tells blendtp besides. */
struct framepath_host_kinematics {
    int (*forward)(const double *joint, struct EmcPose *world);
    int (*inverse)(const struct EmcPose *world, double *joint);
    int (*jet)(const double *position, const double *derivatives, double *joints);
    int (*axis_of_joint)(int joint);
    int (*tool_tilt_axis)(void);
};

static const struct framepath_host_kinematics *machine;

/* From here on these are the kinematics; NULL for none but the axes. */
EXPORTED void framepath_host_set_kinematics(const struct framepath_host_kinematics *kinematics)
{
    machine = kinematics;
}

EXPORTED int framekinsJet(const double *position, const double *derivatives, double *joints)
{
    return machine ? machine->jet(position, derivatives, joints) : -1;
}

EXPORTED int framekinsAxisOfJoint(int joint)
{
    return machine ? machine->axis_of_joint(joint) : -1;
}

EXPORTED int framekinsToolTiltAxis(void)
{
    return machine ? machine->tool_tilt_axis() : -1;
}

EXPORTED int kinematicsForward(const double *joint, struct EmcPose *world, const KINEMATICS_FORWARD_FLAGS *forward,
                               KINEMATICS_INVERSE_FLAGS *inverse)
{
    (void)forward;
    (void)inverse;
    if (machine)
        return machine->forward(joint, world);
    memcpy(world, joint, sizeof *world);
    return 0;
}

EXPORTED int kinematicsInverse(const struct EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *inverse,
                               KINEMATICS_FORWARD_FLAGS *forward)
{
    (void)inverse;
    (void)forward;
    if (machine)
        return machine->inverse(world, joint);
    memcpy(joint, world, sizeof *world);
    return 0;
}

EXPORTED int kinematicsHome(struct EmcPose *world, double *joint, KINEMATICS_FORWARD_FLAGS *forward,
                            KINEMATICS_INVERSE_FLAGS *inverse)
{
    return kinematicsForward(joint, world, forward, inverse);
}

EXPORTED KINEMATICS_TYPE kinematicsType(void) { return machine ? KINEMATICS_BOTH : KINEMATICS_IDENTITY; }
EXPORTED int kinematicsSwitchable(void) { return 0; }
EXPORTED int kinematicsSwitch(int type) { return type ? -1 : 0; }
#endif
