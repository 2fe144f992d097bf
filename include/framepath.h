/* The C interface of framepath's real-time core. Written by `make header` from src/abi; do not edit.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */

#ifndef FRAMEPATH_H
#define FRAMEPATH_H

#include "motion.h"
#include "tp.h"
#include "kinematics.h"

/*
 Version of the library: major * 10000 + minor * 100 + patch.
 */
#define FRAMEPATH_VERSION 100

/*
 Alarm: the guard is late with a frame in force, and the machine is held.
 */
#define FRAMEPATH_GUARD_LATE 1

/*
 Alarm: the guard is lost with a frame in force, and the machine is switched off.
 */
#define FRAMEPATH_GUARD_LOST 2

/*
 What no length of a machine exceeds, machine units.
 */
#define FRAMEPATH_GREATEST_LENGTH 1e6

/*
 Errors of `framepath_kinematics_configure`: `coordinates=` names no axis.
 */
#define FRAMEPATH_NO_AXIS 1

/*
 `coordinates=` has a letter that is no axis.
 */
#define FRAMEPATH_UNKNOWN_AXIS 2

/*
 `coordinates=` has more letters than LinuxCNC has joints.
 */
#define FRAMEPATH_TOO_MANY_JOINTS 3

/*
 `coordinates=` leaves out an axis that the machine needs.
 */
#define FRAMEPATH_MISSING_AXIS 4

/*
 There is no such `machine=`.
 */
#define FRAMEPATH_UNKNOWN_MACHINE 5

/*
 There is no such `tool_length=`.
 */
#define FRAMEPATH_UNKNOWN_TOOL_LENGTH 6

/*
 `tool_types=` is no list of types.
 */
#define FRAMEPATH_UNKNOWN_TOOL_TYPES 7

/*
 `tool_axes=` names no axes that could turn a tool.
 */
#define FRAMEPATH_UNKNOWN_TOOL_AXES 8

/*
 The most moves that motmod may ask room for (it asks for 2000).
 */
#define FRAMEPATH_QUEUE_CAPACITY 2000

/*
 The limits are taken, or there are none.
 */
#define FRAMEPATH_JOINTS_TAKEN 0

/*
 The velocity of `joint` makes no sense.
 */
#define FRAMEPATH_JOINT_VELOCITY 1

/*
 Its acceleration makes no sense.
 */
#define FRAMEPATH_JOINT_ACCELERATION 2

/*
 Its jerk makes no sense: `value` is the smallest that would.
 */
#define FRAMEPATH_JOINT_JERK 3

/*
 There are more joints, `joint`, than can have limits.
 */
#define FRAMEPATH_JOINTS_TOO_MANY 4

/*
 The kinematics cannot be asked, or have no joints for where the machine is.
 */
#define FRAMEPATH_JOINTS_UNKNOWN 5

/*
 They take too long: `value` microseconds for the joints of a place.
 */
#define FRAMEPATH_JOINTS_SLOW 6

/*
 Their answers for `joint` are off by `value`.
 */
#define FRAMEPATH_JOINTS_ROUGH 7

/*
 The joints are the axes, whose limits hold.
 */
#define FRAMEPATH_JOINTS_TRIVIAL 8

/*
 The machine stands at a singular place, which joints with limits cannot leave smoothly.
 */
#define FRAMEPATH_JOINTS_SINGULAR 9

/*
 How many joints can have limits: 0 to 8.
 */
#define FRAMEPATH_LIMITED_JOINTS 9

/*
 Microseconds that the kinematics may take for the joints of a place. Some 20 places are asked for in a servo period.
 */
#define FRAMEPATH_MOST_MICROSECONDS 2.0

/*
 What [`framepath_planner_set_blending`] answers where the length of a millimetre makes no sense.
 */
#define FRAMEPATH_BAD_MILLIMETRE 1

/*
 The same for the tolerance of rotary axes.
 */
#define FRAMEPATH_BAD_ROTARY_TOLERANCE 2

/*
 The same for the tolerance of G64 without P.
 */
#define FRAMEPATH_BAD_DEFAULT_TOLERANCE 3

/*
 The run cannot be reversed here: no moves are remembered, or one that does not run backwards.
 */
#define FRAMEPATH_NOTHING_TO_REVERSE -2

/*
 The run is turned at rest only, and the machine moves.
 */
#define FRAMEPATH_TURNED_AT_REST_ONLY -3

/*
 The tolerance of runs of short moves under G64 without P where the configuration says nothing, machine units.
 */
#define FRAMEPATH_DEFAULT_TOLERANCE 0.02

/*
 What a move was found to do to the joints, in the last servo period.
 */
#define FRAMEPATH_STAYS_IN_RANGE 0

/*
 It would take one beyond a soft limit: the motion is stopped before it.
 */
#define FRAMEPATH_LEAVES_RANGE 1

/*
 The kinematics gave no joints for a place on its way, so that it could not be looked at.
 */
#define FRAMEPATH_RANGE_UNKNOWN 2

/*
 A joint with limits of its own would jump: the motion is stopped before the move.
 */
#define FRAMEPATH_JOINT_JUMPS 3

/*
 No joints lead to a place on its way, and joints have limits of their own: the motion is stopped before the move.
 */
#define FRAMEPATH_OUT_OF_REACH 4

/*
 There is nothing to do.
 */
#define FRAMEPATH_LIMIT_NOTHING 0

/*
 The machine rests between moves.
 */
#define FRAMEPATH_LIMIT_REST 1

/*
 Pause, feed hold or an abort.
 */
#define FRAMEPATH_LIMIT_HOLD 2

/*
 It waits for a spindle, or follows its angle.
 */
#define FRAMEPATH_LIMIT_SPINDLE 3

/*
 The feed of the program.
 */
#define FRAMEPATH_LIMIT_FEED 4

/*
 An override below 100 %.
 */
#define FRAMEPATH_LIMIT_OVERRIDE 5

/*
 The greatest velocity along the path.
 */
#define FRAMEPATH_LIMIT_PATH_VELOCITY 6

/*
 The velocity of an axis, or of a joint where joints have limits.
 */
#define FRAMEPATH_LIMIT_AXIS_VELOCITY 7

/*
 The acceleration of one.
 */
#define FRAMEPATH_LIMIT_AXIS_ACCELERATION 8

/*
 The jerk of one.
 */
#define FRAMEPATH_LIMIT_AXIS_JERK 9

/*
 On the way between two limits.
 */
#define FRAMEPATH_LIMIT_BETWEEN 10

/*
 The planner of the module, with what LinuxCNC handed over for it.
 */
struct framepath_planner;

/*
 What is read from the pins in each servo period. Lengths in machine units, angles in degrees.
 */
struct framepath_frame_inputs {
  /*
   Number of the command times 1000, plus its code.
   */
  double command;
  /*
   Values of the command.
   */
  double value[3];
  /*
   Work offset in X Y Z.
   */
  double work_offset[3];
  /*
   Rotation of the work offset about Z.
   */
  double work_rotation;
  /*
   Tool offset in X Y Z.
   */
  double tool_offset[3];
  /*
   The tool's length stays along the machine's axes in a frame: 0 or 1.
   */
  int tool_length_machine;
  /*
   Table: where its rotary axis is.
   */
  double rotation_point[3];
  /*
   Table: from there to the tilting axis.
   */
  double offset[3];
  /*
   Table: length of the tool along Z.
   */
  double table_tool_offset;
  /*
   Table: positive angles turn the tool relative to the workpiece: 0 or 1.
   */
  int conventional_directions;
  /*
   Table: X Y Z are to be the tool centre point on the turning workpiece: 0 or 1.
   */
  int tool_centre_point;
  /*
   Smallest and greatest angle of the tilting axis.
   */
  double tilt_range[2];
  /*
   Smallest and greatest angle of the rotary axis.
   */
  double rotary_range[2];
  /*
   A ready frame: three rows of a 3x4 map.
   */
  double map[12];
  /*
   Which of A B C U V W are mirrored: 0 or 1.
   */
  int mirror[6];
  /*
   Motion stands still: 0 or 1.
   */
  int in_position;
  /*
   Motion is in teleop mode: 0 or 1.
   */
  int teleop;
  /*
   The sum over the command, its values and the work offset that was sent with them.
   */
  double check;
  /*
   The machine is switched on: 0 or 1.
   */
  int enabled;
  /*
   An abort and machine off remove the frame: 0 or 1.
   */
  int release_on_abort;
  /*
   The guard wants the frame removed: 0 or 1.
   */
  int release;
  /*
   How many of `releases` the guard has told the interpreter of.
   */
  int releases_seen;
  /*
   Changes while the guard lives; 0: it has never lived.
   */
  unsigned int heartbeat;
  /*
   The servo period, s.
   */
  double period;
  /*
   A clock that runs on, ns.
   */
  long long clock;
  /*
   The type that inner kinematics are to have.
   */
  double inner_type;
  /*
   A pin cannot be the external offset of its axis: 0 or 1.
   */
  int unknown_offset;
};

/*
 What is written to the pins after each servo period.
 */
struct framepath_frame_outputs {
  /*
   The kinematics type that motion is asked for.
   */
  double switchkins_type;
  /*
   Number of the last command that was carried out or refused.
   */
  double acknowledged;
  /*
   Whether a frame is active: 0 or 1.
   */
  int active;
  /*
   Kinematics type in effect.
   */
  int slot;
  /*
   How many operations make up the frame.
   */
  int operations;
  /*
   The tool centre point is on: 0 or 1.
   */
  int tool_centre_point;
  /*
   The dimensions of the table, or the tool centre point asked for, are not those in effect: 0 or 1.
   */
  int parameters_pending;
  /*
   The tool offset in X Y Z that the frame was made with.
   */
  double tool_offset[3];
  /*
   The work offset in X Y Z that the frame was made with.
   */
  double work_offset[3];
  /*
   Its rotation about Z.
   */
  double work_rotation;
  /*
   A tool offset that changes under the frame leads elsewhere than the program says: 0 or 1.
   */
  int tool_length_matters;
  /*
   Why the last command was refused; 0 if it was not.
   */
  int refusal;
  /*
   Why the tool cannot be put normal to the frame; 0 if it can.
   */
  int normal_refusal;
  /*
   Where the tilting axis has to go for that.
   */
  double normal_tilt;
  /*
   Where the rotary axis has to go for that.
   */
  double normal_rotary;
  /*
   Which axis that tilting axis is: 1, 2, 3 for A, B, C; 0 if there is none.
   */
  int normal_tilt_axis;
  /*
   Which axis that rotary axis is.
   */
  int normal_rotary_axis;
  /*
   The frame has to go and cannot yet: 0 or 1.
   */
  int releasing;
  /*
   How often a frame was removed without a command while a guard lived.
   */
  int releases;
  /*
   Nothing may be moved: 0 or 1.
   */
  int hold;
  /*
   The machine may be on: 0 or 1.
   */
  int guarded;
  /*
   How far a guard that is missed has brought it: 0, or one of the alarms above.
   */
  int alarm;
  /*
   Where the tip of the tool is with the frame, for where it would be without: three rows of a 3x4 map.
   */
  double frame[12];
  /*
   The machine's axes behind the frame. With the tool centre point on these are coordinates of the workpiece.
   */
  double position[9];
  /*
   From the tip of the tool to the position of the axes, X Y Z.
   */
  double turned_tool[3];
  /*
   The type of the inner kinematics in effect.
   */
  int inner_type;
  /*
   Why it is not the one that the pin says; 0 if it is.
   */
  int inner_refusal;
  /*
   The type of the inner kinematics for the tool centre point; -1 if none is known.
   */
  int tool_centre_type;
  /*
   Their type with the machine's own axes; -1 if there is none.
   */
  int axes_type;
  /*
   How the tool is drawn back: 0 by Z without the frame, 1 along `retract_way`, -1 its kinematics are not known, -2 it
   lies level or points up, -3 the kinematics of another module have not been asked yet.
   */
  int retract_kind;
  /*
   Where its tip goes, in LinuxCNC's coordinates X Y Z, while the machine's own Z rises by one.
   */
  double retract_way[3];
  /*
   Where the machine's own Z is.
   */
  double retract_z;
};

/*
 What the pins say, and what was found wrong with it.
 */
struct framepath_joint_limits {
  /*
   Of joints 0 to 8, units per second; all of these 0: no limits of joints.
   */
  double velocity[9];
  /*
   Units per second squared.
   */
  double acceleration[9];
  /*
   Units per second cubed, 0: not limited.
   */
  double jerk[9];
  /*
   The joint that an answer is about.
   */
  int joint;
  /*
   What was measured, or would make sense.
   */
  double value;
  /*
   A bit for each joint whose jerk is more than can be used: it counts as not limited.
   */
  unsigned int unlimited;
};

/*
 What an operator sees, after a servo period.
 */
struct framepath_survey {
  /*
   What keeps the machine from being faster: one of `FRAMEPATH_LIMIT_..`.
   */
  int limit;
  /*
   The axis whose limit it is, 0 to 8 (X Y Z A B C U V W of the machine), or -1.
   */
  int axis;
  /*
   The joint whose limit it is, from 0, or -1.
   */
  int joint;
  /*
   Moves that are queued, the running one included.
   */
  int moves_queued;
  /*
   Those of them that are planned.
   */
  int moves_ahead;
  /*
   Moves that have left the queue since the start of the machine, modulo 2^32: the number of the running one.
   */
  uint32_t moves_done;
  /*
   LinuxCNC's number of the running or next move: its line in the program; 0 if there is none.
   */
  int line;
  /*
   Whether the machine stands still.
   */
  bool stands;
  /*
   What F counts until the end of that move, machine units or degrees.
   */
  double to_go;
  /*
   Seconds until the rest at the end of what is planned, at an override of 100 %.
   */
  double seconds_ahead;
  /*
   Seconds until the end of what is queued, at an override of 100 %.
   */
  double seconds_queued;
};

/*
 Where joints would jump behind a switch.
 */
struct framepath_place_jump {
  /*
   The first axis that does, in the order X Y Z A B C U V W, from 0.
   */
  int axis;
  /*
   Where that is, machine units or degrees.
   */
  double place;
  /*
   Where motion goes on from.
   */
  double goes_on;
};



/*
 Chooses the kinematics of another module in place of a machine: `tool_types` is a list of their types that turn the
 tool's length themselves, empty if none do; `tool_axes` says how they turn the tool, empty if they are to be asked. Returns
 0, or an error for `framepath_kinematics_configure_text`.

 # Safety
 The texts are strings or null.
 */
int framepath_kinematics_configure_inner(const char *tool_types,
                                         const char *tool_axes);

/*
 The functions of the other module, which has type 0 now; null for `switch` if it cannot be switched. 0, or -1 if it
 cannot and `tool_types` names another type: then nothing is taken.
 */
int framepath_kinematics_inner_functions(int (*inverse)(const EmcPose*, double*, const unsigned long*, unsigned long*),
                                         int (*forward)(const double*, EmcPose*, const unsigned long*, unsigned long*),
                                         int (*switch_)(int));

/*
 Before motion looks at `motion.switchkins-type`, where the type on the pin is another one than that in force: what to
 write to `framekins.switchkins-type`, so that motion switches in this very period, as it would without framekins.

 # Safety
 `pins` points to the values of the pins.
 */
int framepath_kinematics_take_inner_type(const struct framepath_frame_inputs *pins);

/*
 The pose for joint positions, from a guess at it, with the flags of `kinematicsForward`. What the other module returns;
 -1 if there is none.

 # Safety
 `joints` has 16 numbers, `world` is a pose, the flags are numbers.
 */
int framepath_kinematics_inner_forward(const double *joints,
                                       EmcPose *world,
                                       const unsigned long *forward_flags,
                                       unsigned long *inverse_flags);

/*
 The joint positions for a pose, from the joints of before, with the flags of `kinematicsInverse`. What the other module
 returns; -1 if there is none.

 # Safety
 `world` is a pose, `joints` has 16 numbers, the flags are numbers.
 */
int framepath_kinematics_inner_inverse(const EmcPose *world,
                                       double *joints,
                                       const unsigned long *inverse_flags,
                                       unsigned long *forward_flags);

/*
 Chooses the machine from the texts of `coordinates=`, `machine=` and `tool_length=`. Returns 0, or an error for
 `framepath_kinematics_configure_text`, one of the constants above. Where it is about the coordinates, `letter` says at
 which of them, counted from 1, 0 if at none.

 # Safety
 The texts are strings or null, `letter` points to a number.
 */
int framepath_kinematics_configure(const char *coordinates, const char *machine, const char *tool_length, int *letter);

/*
 What is wrong, and the remedy, for an error of `framepath_kinematics_configure`.
 */
const char *framepath_kinematics_configure_text(int error);

/*
 Which axis tilts the table: 1 is A, 2 is B, 0 is a machine without such a table.
 */
int framepath_kinematics_tilt_axis(void);

/*
 The pose for joint positions of a machine of ours. 0, or -1 if none is configured or a result is not finite.

 # Safety
 `joints` has 16 numbers, `world` is a pose.
 */
int framepath_kinematics_forward(const double *joints, EmcPose *world);

/*
 The joint positions for a pose, of a machine of ours. 0, or -1 if none is configured or a result is not finite.

 # Safety
 `world` is a pose, `joints` has room for 16 numbers.
 */
int framepath_kinematics_inverse(const EmcPose *world, double *joints);

/*
 The linear part of the frame in force, from the program's X Y Z to the machine's: three rows of three, the identity
 without a frame. What a tool centre point turns behind it is not part of it. Returns whether a frame is in force.

 # Safety
 `map` has room for nine numbers, or is null.
 */
int framepath_kinematics_linear_map(double *map);

/*
 Motion switches to a kinematics type; with inner kinematics it is 16 times the slot of the frame plus theirs. 0, or the number of a refusal: then nothing has changed.

 # Safety
 `pins` points to the values of the pins.
 */
int framepath_kinematics_switch(int slot,
                                const struct framepath_frame_inputs *pins);

/*
 One servo period of taking commands: what is to be written to the pins.

 # Safety
 Both point to structures of this header.
 */
void framepath_kinematics_update(const struct framepath_frame_inputs *pins, struct framepath_frame_outputs *out);

/*
 Three derivatives of the joints 0 to 8 for a position and its derivatives by the same parameter: nine numbers, three times
 nine, and room for three times nine. 0, or -1 where the kinematics behind the frame are another module's.

 # Safety
 The arguments point to as many numbers.
 */
int framepath_kinematics_jet(const double *position,
                             const double *derivatives,
                             double *joints);

/*
 The axis that tilts the tool against the workpiece while C turns it, 3 for A, 4 for B, where the coordinates of the program
 are those of its tip; -1 where they are not. Where the kinematics are another module's these are asked how they turn
 the tool when the machine stands next: -1 until then, and where they do not tell.
 */
int framepath_kinematics_tool_tilt_axis(void);

/*
 The axis of a machine of ours that a joint moves, 0 to 8, as its lamp on a panel says; -1 if there is none, or where the
 kinematics are another module's.
 */
int framepath_kinematics_axis_of_joint(int joint);

/*
 What the operator is told of an alarm.
 */
const char *framepath_kinematics_alarm_text(int alarm);

/*
 The words for a refusal, with the remedy.
 */
const char *framepath_kinematics_refusal_text(int refusal);

/*
 Makes the planner ready for a queue of `queue_size` moves. Null if that is more than there is room for.

 # Safety
 `tp` is motmod's planner structure, or null.
 */
struct framepath_planner *framepath_planner_create(TP_STRUCT *tp, int queue_size);

/*
 The functions of the motion controller: motmod hands them over before it creates the planner.
 */
void framepath_planner_motion_functions(void (*write_digital)(int, char),
                                        void (*write_analog)(int, double),
                                        void (*set_rotary_unlock)(int, int),
                                        int (*get_rotary_unlock)(int),
                                        double (*velocity_limit)(int),
                                        double (*acceleration_limit)(int));

/*
 The motion controller's status and configuration: motmod hands them over before it creates the planner.

 # Safety
 Both live as long as the module, or are null.
 */
void framepath_planner_motion_data(emcmot_status_t *status, emcmot_config_t *config);

/*
 Queues a line. `path_jerk`: what LinuxCNC lets the jerk along the path be, units per second cubed, 0: not limited. Returns LinuxCNC's code: 0, 5 for a move of length zero, -1 for a refusal.

 # Safety
 `handle` from `framepath_planner_create`; the others point to LinuxCNC's structures.
 */
int framepath_planner_add_line(struct framepath_planner *handle,
                               TP_STRUCT *tp,
                               const EmcPose *end,
                               int motion_type,
                               double feed,
                               double max_velocity,
                               double path_jerk,
                               unsigned char enables,
                               char at_speed,
                               int indexer,
                               const struct state_tag_t *tag);

/*
 Queues an arc, helix or spiral, with `path_jerk` as for a line. Returns LinuxCNC's code: 0, 5 for a move of length zero, -1 for a refusal.

 # Safety
 `handle` from `framepath_planner_create`; the others point to LinuxCNC's structures.
 */
int framepath_planner_add_circle(struct framepath_planner *handle,
                                 TP_STRUCT *tp,
                                 const EmcPose *end,
                                 const PmCartesian *center,
                                 const PmCartesian *normal,
                                 int turn,
                                 int motion_type,
                                 double feed,
                                 double max_velocity,
                                 double path_jerk,
                                 unsigned char enables,
                                 char at_speed,
                                 const struct state_tag_t *tag);

/*
 Queues a rigid tap: to `end` with the spindle, back with it `reversal_scale` times as fast, with `path_jerk` as for a
 line. Returns LinuxCNC's code as
 for a line.

 # Safety
 `handle` from `framepath_planner_create`; the others point to LinuxCNC's structures.
 */
int framepath_planner_add_rigid_tap(struct framepath_planner *handle,
                                    TP_STRUCT *tp,
                                    const EmcPose *end,
                                    double max_velocity,
                                    double path_jerk,
                                    unsigned char enables,
                                    double reversal_scale,
                                    const struct state_tag_t *tag);

/*
 Why the last move was refused.

 # Safety
 `handle` from `framepath_planner_create`.
 */
const char *framepath_planner_error_text(const struct framepath_planner *handle);

/*
 Sets the limits of joints, from the next rest on: that of velocity, acceleration and jerk of each joint holds for all
 motion that is planned, and the limits of acceleration and jerk of the axes do not. Returns one of the codes above. With anything but
 `FRAMEPATH_JOINTS_TAKEN` and `FRAMEPATH_JOINTS_TRIVIAL` nothing changes, and no move may be added.

 # Safety
 `handle` from `framepath_planner_create`; `pins` points to one of these.
 */
int framepath_planner_set_joint_limits(struct framepath_planner *handle,
                                       struct framepath_joint_limits *pins);

/*
 Who says in closed form how joints move: `framekinsJet`, or null where there is none.
 */
void framepath_planner_joint_jet(int (*exact)(const double*, const double*, double*));

/*
 What went wrong inside the planner, null if nothing did. The motion was stopped for it; an abort ends that.

 # Safety
 `handle` from `framepath_planner_create`.
 */
const char *framepath_planner_fault_text(const struct framepath_planner *handle);

/*
 Why the motion with a spindle was stopped in the last servo period, null if it was not; with the numbers that belong to it: what the
 thread asks for and what the axes allow, units per second.

 # Safety
 `handle` from `framepath_planner_create`; the others point to numbers.
 */
const char *framepath_planner_spindle_error_text(const struct framepath_planner *handle,
                                                 double *asked,
                                                 double *greatest);

/*
 One servo period. Returns 0, or LinuxCNC's code 4 (waiting) while there is nothing to move.

 # Safety
 `handle` from `framepath_planner_create`; `tp` is motmod's planner structure.
 */
int framepath_planner_run_cycle(struct framepath_planner *handle, TP_STRUCT *tp);

/*
 The acceleration along the path, units per second squared, its jerk, units per second cubed, and where X Y Z go, a
 vector of length 1; all 0 without a move. Returns 0, or -1 without a planner.

 # Safety
 `handle` from `framepath_planner_create`; `direction` has three numbers, the others point to one each.
 */
int framepath_planner_path_motion(const struct framepath_planner *handle,
                                  double *acceleration,
                                  double *jerk,
                                  double *direction);

/*
 Drops all moves.

 # Safety
 `handle` from `framepath_planner_create`; `tp` is motmod's planner structure.
 */
int framepath_planner_clear(struct framepath_planner *handle, TP_STRUCT *tp);

/*
 Comes to rest on the path and stays there.

 # Safety
 `handle` from `framepath_planner_create`; `tp` is motmod's planner structure.
 */
int framepath_planner_pause(struct framepath_planner *handle, TP_STRUCT *tp);

/*
 Goes on after a pause.

 # Safety
 `handle` from `framepath_planner_create`; `tp` is motmod's planner structure.
 */
int framepath_planner_resume(struct framepath_planner *handle, TP_STRUCT *tp);

/*
 Comes to rest on the path, then drops all moves. Where an error has stopped the motion, only an abort that task
 commands lifts that: motmod itself also calls this when it refuses a move.

 # Safety
 `handle` from `framepath_planner_create`; `tp` is motmod's planner structure.
 */
int framepath_planner_abort(struct framepath_planner *handle, TP_STRUCT *tp);

/*
 Where the machine is to be.

 # Safety
 `handle` from `framepath_planner_create`; `position` points to a pose.
 */
int framepath_planner_position(const struct framepath_planner *handle, EmcPose *position);

/*
 Whether no more moves should be sent. motmod asks when the rest of its status is complete, at the end of a servo
 period: from here on task may know that a move has been taken.

 # Safety
 `handle` from `framepath_planner_create`.
 */
int framepath_planner_queue_full(struct framepath_planner *handle);

/*
 Sets the greatest jerk of each of the nine axes, 0 = not limited. Returns -1, or the number of the first axis whose
 value makes no sense; then nothing changes, and `least` is the smallest one that would. In `unlimited` a bit is set for
 each axis, 1 for the first one, whose value is more than can be used: it counts as not limited.

 # Safety
 `handle` from `framepath_planner_create`; `jerk` has nine numbers; the others point to one each.
 */
int framepath_planner_set_jerk(struct framepath_planner *handle,
                               const double *jerk,
                               double *least,
                               unsigned int *unlimited);

/*
 Sets the length of a millimetre in machine units, how far rotary axes may leave the program (degrees, 0 = as many as
 P has millimetres), and the tolerance of runs of short moves under G64 without P (machine units). Holds from the next
 rest on. Returns 0, or one of the codes above; then nothing changes.

 # Safety
 `handle` from `framepath_planner_create`.
 */
int framepath_planner_set_blending(struct framepath_planner *handle,
                                   double millimetre,
                                   double rotary_tolerance,
                                   double default_tolerance);

/*
 Says whether corners are rounded on their inner side only: where not 0 none swings out. Holds from the next rest on.

 # Safety
 `handle` from `framepath_planner_create`.
 */
void framepath_planner_set_corners_inside(struct framepath_planner *handle, int inside);

/*
 Says which axis tilts the tool while C turns it, 3 for A, 4 for B, where the coordinates of the program are those of its
 tip: the tolerance of rotary axes is then one of the tool axis. Any other number: none does. Holds from the next rest on.

 # Safety
 `handle` from `framepath_planner_create`.
 */
void framepath_planner_set_tool_tilt_axis(struct framepath_planner *handle,
                                          int axis);

/*
 Says whether a frame is in force, and how the axes of the program lie to those of the machine behind it: three rows
 of a 3x3 map of X Y Z. The map is taken while nothing is queued, since a frame changes only at standstill; otherwise it is left as it is. Behind one with an element that is not a number or greater than 1e4 no move is taken.

 # Safety
 `handle` from `framepath_planner_create`; `map` has nine numbers.
 */
void framepath_planner_set_machine_map(struct framepath_planner *handle,
                                       int framed,
                                       const double *map);

/*
 Sets the duration of a servo period in seconds. -1 if that is not possible now, or not one from 10 microseconds to 0.1 s.

 # Safety
 `handle` from `framepath_planner_create`; `tp` is motmod's planner structure.
 */
int framepath_planner_set_cycle_time(struct framepath_planner *handle,
                                     TP_STRUCT *tp,
                                     double seconds);

/*
 Sets what no move may exceed along its path, machine units per second.

 # Safety
 `handle` from `framepath_planner_create`.
 */
int framepath_planner_set_velocity_limit(struct framepath_planner *handle, double velocity);

/*
 Sets LinuxCNC's number for the next move.

 # Safety
 `handle` from `framepath_planner_create`.
 */
int framepath_planner_set_id(struct framepath_planner *handle, int id);

/*
 Sets how the moves to come meet the next one (LinuxCNC's number, and P). -1 if the number or P makes no sense.

 # Safety
 `handle` from `framepath_planner_create`.
 */
int framepath_planner_set_termination(struct framepath_planner *handle, int condition, double tolerance);

/*
 Starts from a position, with everything else dropped. -1 if it has a coordinate that is not finite.

 # Safety
 `handle` from `framepath_planner_create`; the others point to LinuxCNC's structures.
 */
int framepath_planner_set_position(struct framepath_planner *handle, TP_STRUCT *tp, const EmcPose *position);

/*
 Which spindle the moves to come follow, by how far in a turn of it (0: none), and whether by its speed only (feed per
 turn) or by its angle (threads and rigid taps).

 # Safety
 `handle` from `framepath_planner_create`.
 */
int framepath_planner_set_spindle_sync(struct framepath_planner *handle,
                                       int spindle,
                                       double distance_per_turn,
                                       int velocity_mode);

/*
 Gives the next move an analog output to write at its start. -1 if there is none of this number, which motion then tells
 the operator, as of M68.

 # Safety
 `handle` from `framepath_planner_create`.
 */
int framepath_planner_set_analog_output(struct framepath_planner *handle, unsigned char index, double value);

/*
 Gives the next move a digital output to write at its start. -1 if there is none of this number, which motion then tells
 the operator, as of M64 and M65.

 # Safety
 `handle` from `framepath_planner_create`.
 */
int framepath_planner_set_digital_output(struct framepath_planner *handle, int index, unsigned char value);

/*
 Chooses the direction of the run, see [`Planner::run_backwards`](crate::planner::Planner::run_backwards).
 [`FRAMEPATH_TURNED_AT_REST_ONLY`] in motion, [`FRAMEPATH_NOTHING_TO_REVERSE`] where there is no way back.

 # Safety
 `handle` from `framepath_planner_create`; `tp` motmod's planner structure.
 */
int framepath_planner_set_run_direction(struct framepath_planner *handle, TP_STRUCT *tp, int direction);

/*
 The kinematics, for the soft limits of the joints on the way of a move: moves wait until they have been looked at. With
 null for `inverse` they do not. `kinematics_type` is what `kinematicsType` says.
 */
void framepath_planner_kinematics(int (*inverse)(const EmcPose*, double*, const unsigned long*, unsigned long*),
                                  int (*forward)(const double*, EmcPose*, const unsigned long*, unsigned long*),
                                  unsigned int kinematics_type);

/*
 What the look along the queued moves came to in the last servo period: one of the codes above, with the program line,
 for a move that leaves the soft limits the joint, how far it would go, and the limit, and for one that makes a joint
 jump the joint, and by how much in `position`.

 # Safety
 `handle` from `framepath_planner_create`; the others point to numbers.
 */
int framepath_planner_range_finding(const struct framepath_planner *handle,
                                    int *line,
                                    int *joint,
                                    double *position,
                                    double *limit);

/*
 Where that is, nine numbers, for a joint that would jump and for what is out of reach. Returns 0, or -1 where there is no
 such place.

 # Safety
 `handle` from `framepath_planner_create`; `place` has room for nine numbers.
 */
int framepath_planner_finding_place(const struct framepath_planner *handle,
                                    double *place);

/*
 What an operator sees after the last servo period. Returns 0, or -1 without a planner.

 # Safety
 `handle` from `framepath_planner_create`; `survey` points to one.
 */
int framepath_planner_survey(const struct framepath_planner *handle, struct framepath_survey *survey);

/*
 Motion has switched and asked for the place of its joints: the external offsets are taken off what it is to give its
 planner.

 # Safety
 `place` is the pose that motion asked with, `offsets` has nine numbers; or they are null.
 */
void framepath_kinematics_take_offsets_off(EmcPose *place, const double *offsets);

/*
 Whether motion, which asks with this pose, goes on from another place than that of its joints behind a switch, and from
 which one. An answer that fails has motion switch the machine off where it stands.

 # Safety
 `asked` is a pose, `jump` points to a structure of this header; or they are null.
 */
int framepath_kinematics_jumps_behind_switch(const EmcPose *asked, struct framepath_place_jump *jump);

/*
 The period of a switch is over: from the next one on motion moves.
 */
void framepath_kinematics_forget_switch(void);

#endif  /* FRAMEPATH_H */
