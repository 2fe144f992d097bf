/* What framekins tells the planner, which looks these up by name; see framepath.h. Part of framekins.c.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */

int framekinsLinearMap(double map[9]);
int framekinsJet(const double *position, const double *derivatives, double *joints);
int framekinsAxisOfJoint(int joint);
int framekinsToolTiltAxis(void);
const char *framekinsInner(void);
int framekinsUnloaded(void);

/* The linear part of the frame, three rows of three, and whether one is in force. */
int framekinsLinearMap(double map[9])
{
    return framepath_kinematics_linear_map(map);
}

/* How the joints of a machine of ours move behind the frame. */
int framekinsJet(const double *position, const double *derivatives, double *joints)
{
    return framepath_kinematics_jet(position, derivatives, joints);
}

/* The axis of such a machine that a joint moves. */
int framekinsAxisOfJoint(int joint)
{
    return framepath_kinematics_axis_of_joint(joint);
}

/* The axis that tilts the tool while C turns it, with the tool centre point on; -1 if there is none. */
int framekinsToolTiltAxis(void)
{
    return framepath_kinematics_tool_tilt_axis();
}

/* The name of the kinematics behind the frame; NULL if they are ours. */
const char *framekinsInner(void)
{
    return *behind ? behind : NULL;
}

/* Whether the module was unloaded while motmod calls it. */
int framekinsUnloaded(void)
{
    return is_unloaded();
}

EXPORT_SYMBOL(framekinsLinearMap);
EXPORT_SYMBOL(framekinsJet);
EXPORT_SYMBOL(framekinsAxisOfJoint);
EXPORT_SYMBOL(framekinsToolTiltAxis);
EXPORT_SYMBOL(framekinsInner);
EXPORT_SYMBOL(framekinsUnloaded);
