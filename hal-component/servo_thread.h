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
} servo_thread;

/* To be called by what only motion-controller calls. */
static void this_is_the_servo_thread(void)
{
    servo_thread.seen = 1;
    servo_thread.id = pthread_self();
}

/* Whether what calls now is in another thread; not before the servo thread has been seen. */
static int on_another_thread(void)
{
    return servo_thread.seen && !pthread_equal(servo_thread.id, pthread_self());
}

#endif
