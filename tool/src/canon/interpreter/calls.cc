/* The canonical calls (canon.hh) that LinuxCNC's interpreter makes, printed.
 *
 * Positions leave here as those of the machine, in millimetres and degrees, with work offsets, G92, rotation and tool
 * offset applied, nine numbers in the order x y z a b c u v w. The first word of a line is the call:
 *
 *   TRAVERSE line end            FEED line end              PROBE line end            TAP line end
 *   ARC line end centre(3) normal(3) turns plane rotated    plane 0 XY, 1 YZ, 2 ZX; rotated 1: the plane's axes are not
 *                                                           those of the machine
 *   RATE per-minute              program units; FEEDMODE 1: per revolution
 *   UNIT mm                      length of the program's unit
 *   TERM mode tolerance          1 exact stop, 2 exact path, 3 continuous
 *   NAIVECAM tolerance
 *   TAG P Q feed speed flags fields(8) file                 of the moves that follow, in program units
 *   SYNC per-revolution velocity-mode                       0: ends
 *   SURFACE greatest centre      of the two below: their speed is mm a minute (G96), up to so many rpm; X in the middle of the work,
 *                                mm of the machine; greatest 0: their speed is rpm
 *   SPINDLE speed direction      direction 0: off           SPEED speed
 *   LENGTH mm                    of the tool along Z, from here on
 *   DWELL seconds                WAIT (motion comes to its end)     FLUSH (ends the merging of short lines)
 *   USER number                  a program of the machine, M100 to M199, when motion has come to its end
 *   INPUT analog number mode     M66 with a mode (L) that waits, or whose answer the program looks at
 *   SLASH                        once, where a block that begins with a slash is carried out
 *   END (the program came to its end)
 *
 * What the interpreter asks for is in answers.cc; M66 in inputs.cc.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <vector>
#include "canon.hh"
#include "calls.hh"
#include "state.hh"

FILE *output;

Where now;

static const char *refused;

const char *unsupported_call()
{
    return refused;
}

void refuse_call(const char *what)
{
    refused = what;
}

static void rotate(double &x, double &y, double degrees)
{
    if (degrees == 0)
        return;
    double angle = degrees * M_PI / 180, c = cos(angle), s = sin(angle), x0 = x;
    x = x0 * c - y * s;
    y = x0 * s + y * c;
}

static Pose pose(double x, double y, double z, double a, double b, double c, double u, double v, double w)
{
    Pose p;
    double values[AXES] = {x, y, z, a, b, c, u, v, w};
    memcpy(p.at, values, sizeof values);
    return p;
}

/* Program units to millimetres. */
static Pose metric(Pose p)
{
    for (int i = 0; i < AXES; i++)
        if (!rotary(i))
            p.at[i] *= now.unit;
    return p;
}

/* Coordinates of the program, in its units, to those of the machine. */
static Pose to_machine(Pose p)
{
    p = metric(p);
    for (int i = 0; i < AXES; i++)
        p.at[i] += now.shift.at[i];
    rotate(p.at[0], p.at[1], now.rotation);
    for (int i = 0; i < AXES; i++)
        p.at[i] += now.work.at[i] + now.tool.at[i];
    return p;
}

/* The other way round: where the program believes the machine is. */
double program_position(int axis)
{
    Pose p = now.here;
    for (int i = 0; i < AXES; i++)
        p.at[i] -= now.work.at[i] + now.tool.at[i];
    rotate(p.at[0], p.at[1], -now.rotation);
    for (int i = 0; i < AXES; i++)
        p.at[i] -= now.shift.at[i];
    return rotary(axis) ? p.at[axis] : p.at[axis] / now.unit;
}

static void numbers(const double *values, int count)
{
    for (int i = 0; i < count; i++)
        fprintf(output, " %.17g", values[i]);
}

/* A move with kinematics of another type than those of the plan. */
static void check_kinematics()
{
    static char text[160];
    static bool moved, any = machine.kinematics_type < 0;
    if (any && !moved)
        machine.kinematics_type = now.kinematics_type;
    if (now.kinematics_type == machine.kinematics_type) {
        moved = true;
        return;
    }
    if (moved)
        snprintf(text, sizeof text, "a move with kinematics of type %g behind moves with type %d (plan the part with each type by itself%s)",
                 now.kinematics_type, machine.kinematics_type, any ? "" : ", with --kinematics-type");
    else
        snprintf(text, sizeof text, "a move with kinematics of type %g in a plan with type %d (write --kinematics-type %g)",
                 now.kinematics_type, machine.kinematics_type, now.kinematics_type);
    refused = text;
}

static void move(const char *call, int line, const Pose &end)
{
    check_kinematics();
    fprintf(output, "%s %d", call, line);
    numbers(end.at, AXES);
    fputc('\n', output);
    now.here = end;
}

static void waits()
{
    fputs("WAIT\n", output);
}

static void flush()
{
    fputs("FLUSH\n", output);
}

/* ---------------------------------------------------------------- motion */

void STRAIGHT_TRAVERSE(int line, double x, double y, double z, double a, double b, double c, double u, double v, double w)
{
    move("TRAVERSE", line, to_machine(pose(x, y, z, a, b, c, u, v, w)));
}

void STRAIGHT_FEED(int line, double x, double y, double z, double a, double b, double c, double u, double v, double w)
{
    move("FEED", line, to_machine(pose(x, y, z, a, b, c, u, v, w)));
}

void STRAIGHT_PROBE(int line, double x, double y, double z, double a, double b, double c, double u, double v, double w,
                    unsigned char)
{
    move("PROBE", line, to_machine(pose(x, y, z, a, b, c, u, v, w)));
}

/* Down and back again: the position stays. */
void RIGID_TAP(int line, double x, double y, double z, double)
{
    Pose end = to_machine(pose(x, y, z, 0, 0, 0, 0, 0, 0)), before = now.here;
    for (int i = 3; i < AXES; i++)
        end.at[i] = before.at[i];
    move("TAP", line, end);
    now.here = before;
}

void ARC_FEED(int line, double first_end, double second_end, double first_axis, double second_axis, int rotation,
              double axis_end, double a, double b, double c, double u, double v, double w)
{
    /* Which machine axis the first, second and third axis of the plane is. */
    static const int order[3][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}};
    int plane = now.plane == PLANE_YZ ? 1 : now.plane == PLANE_XZ ? 2 : 0;
    if (now.plane > PLANE_XZ)
        refused = "an arc in a plane of U, V or W";
    const int *axis = order[plane];
    Pose end = pose(0, 0, 0, a, b, c, u, v, w), centre;
    double normal[3] = {};
    end.at[axis[0]] = first_end;
    end.at[axis[1]] = second_end;
    end.at[axis[2]] = axis_end;
    centre.at[axis[0]] = first_axis;
    centre.at[axis[1]] = second_axis;
    centre.at[axis[2]] = axis_end;
    normal[axis[2]] = 1;
    end = to_machine(end);
    centre = to_machine(centre);
    rotate(normal[0], normal[1], now.rotation);
    check_kinematics();
    fprintf(output, "ARC %d", line);
    numbers(end.at, AXES);
    numbers(centre.at, 3);
    numbers(normal, 3);
    fprintf(output, " %d %d %d\n", rotation, plane, now.rotation != 0);
    now.here = end;
}

#ifdef LINUXCNC_HAS_SCOPED_PLANES
void NURBS_G5_FEED(int, const std::vector<NURBS_CONTROL_POINT> &, unsigned int, CANON_PLANE)
{
    refused = "a spline (G5, G5.1, G5.2; write arcs or short lines in its place)";
}

void NURBS_G6_FEED(int, const std::vector<NURBS_G6_CONTROL_POINT> &, unsigned int, double, int, CANON_PLANE)
{
    refused = "a spline (G6.2; write arcs or short lines in its place)";
}
#else
void NURBS_FEED(int, std::vector<CONTROL_POINT>, unsigned int)
{
    refused = "a spline (G5, G5.1, G5.2; write arcs or short lines in its place)";
}
#endif

void SET_FEED_RATE(double rate)
{
    now.rate = rate;
    fprintf(output, "RATE %.17g\n", rate);
}

void SET_FEED_MODE(int, int mode)
{
    fprintf(output, "FEEDMODE %d\n", mode);
}

void SET_MOTION_CONTROL_MODE(CANON_MOTION_MODE mode, double tolerance PLANNER_OF_G64)
{
    now.mode = mode;
    now.tolerance = tolerance;
    fprintf(output, "TERM %d %.17g\n", (int)mode, tolerance * now.unit);
}

void SET_NAIVECAM_TOLERANCE(double tolerance)
{
    now.naive_cam = tolerance;
    fprintf(output, "NAIVECAM %.17g\n", tolerance * now.unit);
}

void START_SPEED_FEED_SYNCH(int, double per_revolution, bool velocity_mode)
{
    fprintf(output, "SYNC %.17g %d\n", per_revolution * now.unit, velocity_mode);
}

void STOP_SPEED_FEED_SYNCH()
{
    fputs("SYNC 0 0\n", output);
}

void UPDATE_TAG(GivenTag with_flags)
{
    state_tag_t tag = with_flags.get_state_tag();
    double values[4] = {tag.fields_float[GM_FIELD_FLOAT_PATH_TOLERANCE],
                        tag.fields_float[GM_FIELD_FLOAT_NAIVE_CAM_TOLERANCE],
                        tag.fields_float[GM_FIELD_FLOAT_FEED], tag.fields_float[GM_FIELD_FLOAT_SPEED]};
    fprintf(output, "TAG");
    numbers(values, 4);
    fprintf(output, " %lu", tag.packed_flags);
    for (int i = 0; i < GM_FIELD_MAX_FIELDS; i++)
        fprintf(output, " %d", tag.fields[i]);
    fprintf(output, " %d\n", now.file);
}

void DWELL(double seconds)
{
    fprintf(output, "DWELL %.17g\n", seconds);
}

void FINISH() { flush(); }
void ON_RESET() {}

/* ------------------------------------------------------- units, offsets */

void USE_LENGTH_UNITS(CANON_UNITS units)
{
    now.units = units;
    now.unit = units == CANON_UNITS_INCHES ? 25.4 : units == CANON_UNITS_CM ? 10 : 1;
    fprintf(output, "UNIT %.17g\n", now.unit);
}

void SELECT_PLANE(CANON_PLANE plane) { now.plane = plane; }

/* With an offset the diameter changes: under constant surface speed LinuxCNC commands the spindles anew. */
static void centre_moved()
{
    for (int spindle = 0; spindle < EMCMOT_MAX_SPINDLES; spindle++)
        if (now.greatest[spindle] != 0)
            SET_SPINDLE_SPEED(spindle, now.speed[spindle]);
}

void SET_G5X_OFFSET(int, double x, double y, double z, double a, double b, double c, double u, double v, double w)
{
    now.work = metric(pose(x, y, z, a, b, c, u, v, w));
    waits();
    centre_moved();
}

void SET_G92_OFFSET(double x, double y, double z, double a, double b, double c, double u, double v, double w)
{
    now.shift = metric(pose(x, y, z, a, b, c, u, v, w));
    waits();
    centre_moved();
}

void SET_XY_ROTATION(double degrees)
{
    now.rotation = degrees;
    waits();
}

void USE_TOOL_LENGTH_OFFSET(GivenPose o)
{
    now.tool_in_program_units = o;
    double length = now.tool.at[2];
    now.tool = metric(pose(o.tran.x, o.tran.y, o.tran.z, o.a, o.b, o.c, o.u, o.v, o.w));
    waits();
    if (now.tool.at[2] != length)
        fprintf(output, "LENGTH %.17g\n", now.tool.at[2]);
    centre_moved();
}

/* --------------------------------------------------------------- spindle */

/* S of the first spindle, said how it counts where that is not what goes without saying. */
static double speed_of_first()
{
    static bool said = false;
    bool surface = now.greatest[0] != 0;
    if (surface || said)
        fprintf(output, "SURFACE %.17g %.17g\n", now.greatest[0], now.work.at[0] + now.shift.at[0] + now.tool.at[0]);
    said = surface;
    if (!surface)
        return now.speed[0];
    /* feet or metres a minute */
    return now.speed[0] * (now.units == CANON_UNITS_INCHES ? 12 * 25.4 : 1000);
}

/* Only the first spindle is passed on: it is the one that motion waits for. */
static void turn(int spindle, int direction)
{
    if (!known(spindle))
        return;
    now.turning[spindle] = direction;
    if (spindle == 0) {
        double speed = speed_of_first();
        fprintf(output, "SPINDLE %.17g %d\n", speed, direction);
    }
}

void SET_SPINDLE_MODE(int spindle, double greatest)
{
    if (known(spindle))
        now.greatest[spindle] = fabs(greatest);
}

void SPINDLE_RETRACT_TRAVERSE() {}
void SPINDLE_RETRACT() {}
void USE_NO_SPINDLE_FORCE() {}
void START_SPINDLE_CLOCKWISE(int spindle, int) { turn(spindle, 1); }
void START_SPINDLE_COUNTERCLOCKWISE(int spindle, int) { turn(spindle, -1); }
void STOP_SPINDLE_TURNING(int spindle WAIT_AT_SPEED) { turn(spindle, 0); }

void SET_SPINDLE_SPEED(int spindle, double speed)
{
    if (!known(spindle))
        return;
    now.speed[spindle] = fabs(speed);
    if (spindle == 0) {
        double converted = speed_of_first();
        fprintf(output, "SPEED %.17g\n", converted);
    }
}

void ORIENT_SPINDLE(int, double, int) { waits(); }
void WAIT_SPINDLE_ORIENT_COMPLETE(int, double) { waits(); }

/* ------------------------------------------------- tools, coolant, others */

void CHANGE_TOOL(TOOL_SLOT) { now.tool_number = now.selected_tool; waits(); }
void SELECT_TOOL(int tool) { now.selected_tool = tool; }
void CHANGE_TOOL_NUMBER(int number) { now.tool_number = number; }
void START_CHANGE() { waits(); }
void RELOAD_TOOLDATA() { waits(); }
void SET_TOOL_TABLE_ENTRY(int, int, GivenPose, double, double, double, int) { waits(); }
void FLOOD_ON() { now.flood = 1; waits(); }
void FLOOD_OFF() { now.flood = 0; waits(); }
void MIST_ON() { now.mist = 1; waits(); }
void MIST_OFF() { now.mist = 0; waits(); }
void MESSAGE(char *) { waits(); }
void PROGRAM_STOP() { waits(); }
void OPTIONAL_PROGRAM_STOP() { waits(); }
void PROGRAM_END() { waits(); }
void PALLET_SHUTTLE() { waits(); }
void TURN_PROBE_ON() { waits(); }
void TURN_PROBE_OFF() { waits(); }
void SET_AUX_OUTPUT_BIT(int) { waits(); }
void CLEAR_AUX_OUTPUT_BIT(int) { waits(); }

static void note_output(int output, double value)
{
    if (output == machine.switch_output)
        now.kinematics_type = value;
}

void SET_AUX_OUTPUT_VALUE(int output, double value) { note_output(output, value); waits(); }
void ENABLE_ADAPTIVE_FEED() { waits(); }
void DISABLE_ADAPTIVE_FEED() { waits(); }

void SET_MOTION_OUTPUT_BIT(int) { flush(); }
void CLEAR_MOTION_OUTPUT_BIT(int) { flush(); }
void SET_MOTION_OUTPUT_VALUE(int output, double value) { note_output(output, value); flush(); }
void ENABLE_FEED_OVERRIDE() { now.feed_override = true; flush(); }
void DISABLE_FEED_OVERRIDE() { now.feed_override = false; flush(); }
void ENABLE_FEED_HOLD() { flush(); }
void DISABLE_FEED_HOLD() { flush(); }
void ENABLE_SPEED_OVERRIDE(int) { flush(); }
void DISABLE_SPEED_OVERRIDE(int) { flush(); }

void INIT_CANON() {}
void SET_TRAVERSE_RATE(double) {}
void SET_FEED_REFERENCE(CANON_FEED_REFERENCE) {}
void SET_CUTTER_RADIUS_COMPENSATION(double) {}
void START_CUTTER_RADIUS_COMPENSATION(int) {}
void STOP_CUTTER_RADIUS_COMPENSATION() {}
void CLAMP_AXIS(CANON_AXIS) {}
void UNCLAMP_AXIS(CANON_AXIS) {}
void COMMENT(const char *) {}
void LOG(char *) {}
void LOGOPEN(char *) {}
void LOGAPPEND(char *) {}
void LOGCLOSE() {}
int LOCK_ROTARY(int, int) { return 0; }
int UNLOCK_ROTARY(int, int) { refused = "an indexing axis"; return 0; }
void PLUGIN_CALL(int, const char *) {}
void IO_PLUGIN_CALL(int, const char *) {}
void SET_BLOCK_DELETE(bool on) { now.block_delete = on; }
bool GET_BLOCK_DELETE() { return now.block_delete; }
void SET_OPTIONAL_PROGRAM_STOP(bool on) { now.optional_stop = on; }
bool GET_OPTIONAL_PROGRAM_STOP() { return now.optional_stop; }

/* What the program itself reports, for example a named subroutine that ends in an error. */
void CANON_ERROR(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}
