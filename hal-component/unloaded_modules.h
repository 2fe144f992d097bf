/* That a module was unloaded under motmod: no move is taken then. Part of blendtp.c.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */

/* framekins says whether it was; other kinematics do not have it. */
static int (*frames_unloaded)(void);

/* When motmod is loaded. */
static void find_frames(void)
{
    *(void **)&frames_unloaded = dlsym(RTLD_DEFAULT, "framekinsUnloaded");
}

/* -1, with the reason said, where nobody says any more what the limits are, or removes a frame. */
static int check_loaded(void)
{
    const char *module = is_unloaded() ? "blendtp" : frames_unloaded && frames_unloaded() ? "framekins" : NULL;
    if (!module)
        return 0;
    rtapi_print_msg(RTAPI_MSG_ERR, "blendtp: no move is taken, since %s was unloaded while LinuxCNC runs: end LinuxCNC and start it anew\n",
                    module);
    return -1;
}
