/* Numbers for the drivers of this folder: the same for the same seed; plausible ones, and now and then none that a
 * function should be given.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_TEST_RANDOM_H
#define FRAMEPATH_TEST_RANDOM_H

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>

static uint64_t random_state = 88172645463325252ULL;

/* xorshift64 (Marsaglia 2003) */
static uint64_t random_bits(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return random_state;
}

/* 0 up to below `count`. */
static int pick(int count)
{
    return (int)(random_bits() % (uint64_t)count);
}

static double between(double least, double most)
{
    return least + (most - least) * (double)(random_bits() >> 11) / 9007199254740992.0;
}

/* A number of this range, or in one of fifty cases a hostile one. */
static double number(double least, double most)
{
    static const double hostile[] = {NAN, INFINITY, -INFINITY, 0.0, -0.0, -1.0, 1e-300, 1e300, DBL_MAX, 5e-324};
    return pick(50) ? between(least, most) : hostile[pick(sizeof hostile / sizeof hostile[0])];
}

/* A whole number of 0 up to below `count`, or in one of fifty cases a hostile one. */
static int whole(int count)
{
    static const int hostile[] = {-1, INT_MIN, INT_MAX, 64, 255, 256};
    return pick(50) ? pick(count) : hostile[pick(sizeof hostile / sizeof hostile[0])];
}

#endif
