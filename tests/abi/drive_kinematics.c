/* drive_kinematics COORDINATES MACHINE TOOL_LENGTH SEED PERIODS [fault]
 * Loads framekins with these parameters into a process without LinuxCNC and calls all of its functions with plausible and
 * hostile values. With PERIODS 0 it has to refuse the parameters.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "rtapi.h"
#include "hal.h"
#include "kinematics.h"
#include "emcmotcfg.h"
#include "host.h"
#include "random.h"

int framekinsLinearMap(double map[9]);
extern void *rtapi_info_address_coordinates, *rtapi_info_address_machine, *rtapi_info_address_tool_length;

static double joints[EMCMOT_MAX_JOINTS];

static void set_pins(void)
{
    static const char *const numbers[] = {"value.1", "value.2", "value.3", "work-offset.x", "work-offset.rotation",
                                          "tool-offset.z", "x-rot-point", "y-offset", "tool-offset", "tilt-min", "rotary-max",
                                          "map.xx", "map.xy", "map.z"};
    static const char *const bits[] = {"tool-length-machine", "mirror.a", "conventional-directions", "tool-centre-point"};
    static int command;
    framepath_host_set(numbers[pick(sizeof numbers / sizeof numbers[0])], number(-30, 30));
    framepath_host_set(bits[pick(sizeof bits / sizeof bits[0])], pick(2));
    framepath_host_set("in-position", pick(9) > 0);
    framepath_host_set("teleop", pick(9) == 0);
    if (!pick(3))
        framepath_host_set("command", pick(50) ? 1000.0 * ++command + pick(14) + 100 * pick(2) : number(-1e9, 1e9));
}

/* Where the joints are, as a pose, and back again; joints that share an axis need not be the same. */
static void there_and_back(void)
{
    EmcPose world, again;
    double back[EMCMOT_MAX_JOINTS] = {0};
    KINEMATICS_FORWARD_FLAGS forward = 0;
    KINEMATICS_INVERSE_FLAGS inverse = 0;
    int plausible = 1;
    for (int i = 0; i < EMCMOT_MAX_JOINTS; i++) {
        joints[i] = number(-100, 100);
        plausible = plausible && fabs(joints[i]) <= 100;
    }
    if (kinematicsForward(joints, &world, &forward, &inverse) || kinematicsInverse(&world, back, &inverse, &forward)) {
        REQUIRE(!plausible);
        return;
    }
    REQUIRE(!plausible || kinematicsForward(back, &again, &forward, &inverse) == 0);
    REQUIRE(!plausible || (fabs(again.tran.x - world.tran.x) < 1e-4 && fabs(again.tran.y - world.tran.y) < 1e-4
                           && fabs(again.tran.z - world.tran.z) < 1e-4));
}

int main(int argc, char **argv)
{
    double map[9];
    long periods = argc > 5 ? strtol(argv[5], NULL, 10) : -1;
    if (periods < 0)
        return 2;
    commit_fault(argc, argv);
    random_state += strtoull(argv[4], NULL, 10) * 0x9E3779B97F4A7C15ULL;
    *(char **)rtapi_info_address_coordinates = argv[1];
    *(char **)rtapi_info_address_machine = argv[2];
    *(char **)rtapi_info_address_tool_length = argv[3];
    if (!periods) {
        REQUIRE(rtapi_app_main() < 0);
        REQUIRE(framepath_host_errors() == 1);
        puts(framepath_host_first_error());
        return 0;
    }
    REQUIRE(rtapi_app_main() == 0);
    REQUIRE(kinematicsType() == KINEMATICS_BOTH && kinematicsSwitchable());
    for (long period = 0; period < periods; period++) {
        set_pins();
        framepath_host_run_functions();
        if (!pick(3))
            kinematicsSwitch(whole(3));
        there_and_back();
        framekinsLinearMap(map);
    }
    rtapi_app_exit();
    return 0;
}
