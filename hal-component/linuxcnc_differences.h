/* What LinuxCNC's versions do not have in common, as far as the planner's module is concerned: linuxcnc-has asks the headers.
 * Part of blendtp.c.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */

/* The limits of a move behind its velocities: its acceleration, which is limited axis by axis here, and since 2.10 the jerk
 * along its path, units per second cubed, 0: not limited. */
#ifdef LINUXCNC_HAS_MOVE_JERK
#define MOVE_LIMITS double acc, double path_jerk
#else
#define MOVE_LIMITS double acc
static const double path_jerk = 0;
#endif

/* The jerk limit of an axis whose pin nobody sets. LinuxCNC 2.10 knows the key in the INI; otherwise there is none, and as
 * long as the sign is there nobody has said so. */
static double jerk_without_pin(double in_the_ini)
{
#ifdef LINUXCNC_HAS_MOVE_JERK
    if (in_the_ini > 0)
        return in_the_ini;
#endif
    (void)in_the_ini;
    return -0.0;
}

/* Since 2.10 the status says how it goes along the path. */
static void report_path_motion(emcmot_status_t *status)
{
#ifdef LINUXCNC_HAS_PATH_MOTION
    double direction[3];
    if (!status || framepath_planner_path_motion(planner, &status->current_acc, &status->current_jerk, direction))
        return;
    status->current_dir.x = direction[0];
    status->current_dir.y = direction[1];
    status->current_dir.z = direction[2];
#endif
    (void)status;
}
