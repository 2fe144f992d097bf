/* What the canonical calls of LinuxCNC's versions do not have in common: the build script asks the headers.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#pragma once
#include "canon.hh"

#ifdef LINUXCNC_HAS_SCOPED_PLANES
const CANON_PLANE PLANE_XY = CANON_PLANE::XY, PLANE_YZ = CANON_PLANE::YZ, PLANE_XZ = CANON_PLANE::XZ;
typedef const EmcPose &GivenPose;
typedef const StateTag &GivenTag;
/* G64 R chooses among LinuxCNC's planners. */
#define PLANNER_OF_G64 , int, double
#define WAIT_AT_SPEED , int
#define TOOL_SLOT
#define TOOL_DATA extern "C"
#else
const CANON_PLANE PLANE_XY = CANON_PLANE_XY, PLANE_YZ = CANON_PLANE_YZ, PLANE_XZ = CANON_PLANE_XZ;
typedef EmcPose GivenPose;
typedef StateTag GivenTag;
#define PLANNER_OF_G64
#define WAIT_AT_SPEED
#define TOOL_SLOT int
#define TOOL_DATA
#endif
