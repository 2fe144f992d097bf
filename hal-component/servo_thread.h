/* The thread of motion-controller, as its calls show it. The library is not made for two threads: what belongs to it has
 * to be called from this one.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_SERVO_THREAD_H
#define FRAMEPATH_SERVO_THREAD_H

#include <pthread.h>

static struct {
    int seen;
    pthread_t id;
} servo_thread; /* looked at by other threads, and atomic for them */

/* To be called by what only motion-controller calls. */
static void this_is_the_servo_thread(void)
{
    __atomic_store_n(&servo_thread.id, pthread_self(), __ATOMIC_RELAXED);
    __atomic_store_n(&servo_thread.seen, 1, __ATOMIC_RELEASE);
}

static int is_servo_thread_seen(void)
{
    return __atomic_load_n(&servo_thread.seen, __ATOMIC_ACQUIRE);
}

/* Whether what calls now is in another thread; not before the servo thread has been seen. */
static int on_another_thread(void)
{
    return is_servo_thread_seen() && !pthread_equal(__atomic_load_n(&servo_thread.id, __ATOMIC_RELAXED), pthread_self());
}

#endif
