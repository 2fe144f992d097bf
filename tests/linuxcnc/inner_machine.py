"""Simulated machines of LinuxCNC's own kinematics, with framekins before these and without."""

import os
import shutil
import tempfile

import harness
import test_soft_limits as robots

#: the analog output with which LinuxCNC's samples choose a type; frames take those behind it
SELECT, FIRST = 3, 4

NGC = """\
SUBROUTINE_PATH = ../../subroutines:.
OWORD_NARGS = 1
REMAP = M428 modalgroup=10 ngc=to_type_1
REMAP = M429 modalgroup=10 ngc=to_type_0
"""

TOOL_CENTRE = "REMAP = G43.4 modalgroup=1 argspec=abcdehijklpqruvwxyz ngc=code_tool_centre\n"

#: lengths of 15 and 40 mm, and a tool of lathes
TOOLS = "T1 P1 Z15\nT2 P2 Z40\nT3 P3 Z15 D1 Q3\n"

ABORT = "ON_ABORT_COMMAND = o<frame_abort> call\n"

SETTINGS = f"[FRAMEPATH]\nANALOG_OUTPUT = {FIRST}\n"

#: as the remaps of LinuxCNC's samples do it, which look at motion's pin
SWITCH = """\
o<to_type_{number}> sub
  M68 E{output} Q{number}
  M66 E0 L0
  o1 if [[#<_task> EQ 1] AND [#<_hal[motion.switchkins-type]> NE {number}]]
    (ABORT, motion.switchkins-type is #<_hal[motion.switchkins-type]>)
  o1 endif
o<to_type_{number}> endsub
M2
"""

#: what carries a frame, in the order of the analog outputs
CARRIED = ["command", "value.1", "value.2", "value.3", "work-offset.x", "work-offset.y", "work-offset.z",
           "work-offset.rotation", "check"]

FRAMES = "".join(f"net frame-{n} motion.analog-out-{FIRST + n:02} => framekins.{pin}\n" for n, pin in enumerate(CARRIED)) + """\
addf framekins servo-thread
net tool-x motion.tooloffset.x => framekins.tool-offset.x
net tool-y motion.tooloffset.y => framekins.tool-offset.y
net tool-z motion.tooloffset.z => framekins.tool-offset.z
net motion-in-position motion.in-position => framekins.in-position
net motion-teleop motion.teleop-mode => framekins.teleop
net motion-on motion.motion-enabled => framekins.enabled
net frame-switch framekins.switchkins-type => motion.switchkins-type
net frame-hold framekins.hold => motion.feed-inhibit
net frame-guarded framekins.guarded => motion.enable
"""

GUARD = "loadusr -Wn frame-guard ../../subroutines/frame_guard.py\n"


class Machine:
    """KINEMATICS of the INI, joints at home, letters of the axes, lines of HAL that set its dimensions."""

    def __init__(self, kinematics, home, letters="XYZ", hal="", switches=False, **options):
        self.kinematics, self.home, self.letters, self.hal = kinematics, home, letters, hal
        self.switches = switches
        #: world_home, motion (parameters of motmod), and limits by joint: joint_1=(least, greatest)
        self.options = options

    def has_frames(self, inner):
        return self.kinematics.startswith("framekins") or inner is not None

    def ini(self, inner):
        text = robots.INI.format(kinematics=self.kinematics, joints=len(self.home), letters=self.letters, planner="blendtp",
                                 world_home=self.options.get("world_home", ""))
        text = text.replace("[RS274NGC]\n", "[RS274NGC]\n" + NGC + (ABORT + TOOL_CENTRE) * self.has_frames(inner)) + SETTINGS
        text += "".join(robots.AXIS.format(letter=letter) for letter in self.letters)
        for number, home in enumerate(self.home):
            least, greatest = self.options.get(f"joint_{number}", (-5000, 5000))
            text += robots.JOINT.format(number=number, home=home, least=least, greatest=greatest)
        return text

    def hal_text(self, inner):
        """inner: what stands behind `loadrt framekins`, None without it; framekins in the INI is there anyway."""
        motion = f"num_joints=[KINS]JOINTS num_aio=16 {self.options.get('motion', '')}".rstrip()
        text = robots.HAL.replace("num_joints=[KINS]JOINTS", motion) + self.hal
        if inner is not None:
            text = f"loadrt framekins {inner}\n" + text
        if self.has_frames(inner):
            text += FRAMES
        if self.switches:
            target = "motion.switchkins-type" if inner is None else "framekins.inner-type"
            text += f"net kinstype-select motion.analog-out-{SELECT:02} => {target}\n"
        text += "".join(f"net joint-{number} joint.{number}.motor-pos-cmd => joint.{number}.motor-pos-fb\n"
                        for number in range(len(self.home)))
        return text + GUARD * self.has_frames(inner)

    def run(self, steps, programs=None, inner=None, record=True, modules=None):
        folder = tempfile.mkdtemp(prefix="framepath-inner.")
        try:
            ini = self.ini(inner).replace("[EMCIO]\n", "[EMCIO]\nTOOL_TABLE = robot.tbl\n")
            files = {"robot.ini": ini, "robot.hal": self.hal_text(inner), "robot.tbl": TOOLS}
            for number in range(2):
                files[f"to_type_{number}.ngc"] = SWITCH.format(number=number, output=SELECT)
            for name, content in files.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(content)
            recorder = harness.Recorder(len(self.home), self.letters.lower())
            if not self.has_frames(inner):
                # without framekins there is no slot
                del recorder.integers["slot"]
                recorder.header.remove("slot")
            return harness.run(steps, programs, sample="robot", configuration=folder, recorder=recorder, record=record,
                               modules=modules)
        finally:
            shutil.rmtree(folder)

    def run_program(self, *lines, inner=None, modules=None):
        text = "\n".join(["G21 G61.1 G17 G90 G94 F3000", *lines, "M2"]) + "\n"
        return self.run([["run", "PROGRAMS/part.ngc"], ["note", "end"]], {"part.ngc": text}, inner, modules=modules)

    def joints(self, result, note="end"):
        return result.answers[note]["joints"][:len(self.home)]

    def way(self, result):
        """The joints in each period in which one of them moves: how long the machine stands is the computer's affair."""
        rows = result.columns(*(f"joint.{number}" for number in range(len(self.home))))
        return [row for row, before in zip(rows[1:], rows, strict=False) if row != before]
