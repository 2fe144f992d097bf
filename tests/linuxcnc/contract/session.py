"""Runs rows of the outcome table in a real LinuxCNC with one planner, and says what came of each."""

import dataclasses
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Callable

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
sys.path.insert(0, HERE)

import framed  # noqa: E402
import harness  # noqa: E402
from delays import DISTURBED  # noqa: E402
from row import ACCELERATION, JERK, PERIOD, VELOCITY, Broken, Seen, all_rows, peaks  # noqa: E402

#: name, pin, and how many of the unit are recorded for one
FLOATS = (("x", "axis.x.pos-cmd", 1e6), ("y", "axis.y.pos-cmd", 1e6), ("z", "axis.z.pos-cmd", 1e6),
          ("a", "axis.a.pos-cmd", 1e6), ("b", "axis.b.pos-cmd", 1e6), ("turns", "spindle.0.revs", 1e6),
          ("turns1", "spindle.1.revs", 1e6), ("velocity", "motion.current-vel", 1e3),
          ("feed", "motion.requested-vel", 1e3), ("to_go", "motion.distance-to-go", 1e3),
          ("analog", "motion.analog-out-00", 1), ("joint_z", "joint.2.motor-pos-cmd", 1e6))
INTEGERS = (("line", "motion.program-line"), ("type", "motion.motion-type"), ("row", None))
BITS = (("in_position", "motion.in-position"), ("output0", "motion.digital-out-00"),
        ("output1", "motion.digital-out-01"), ("unlock", "joint.3.unlock"), ("unlocked", "joint.3.is-unlocked"),
        ("reverse", "motion.tp-reverse"))

JERK_LIMITS = "".join(f"setp blendtp.axis.{axis}.max-jerk {JERK:.0f}\n" for axis in "xyzab")
#: What framekins without a frame needs.
FRAMEKINS = """
addf framekins servo-thread
net frame-switch framekins.switchkins-type => motion.switchkins-type
"""
#: Sessions after which rows that are still left count as not run.
MOST_SESSIONS = 8
#: How often a row is operated at most that fails while the computer is busy with something else, with each planner:
#: LinuxCNC's own fails in some rows however quiet the computer is.
ATTEMPTS = {"tpmod": 2, "blendtp": 3}


class Recorder:
    """What harness.run records in every servo period."""

    floats: tuple[tuple[str, str, float], ...] = FLOATS
    bits: tuple[tuple[str, str], ...] = BITS

    def __init__(self):
        self.signals = dict(SIGNALS)
        self.recorded = self.header = ("time", *(name for name, *_ in (*self.floats, *INTEGERS, *self.bits)))

    def hal(self):
        count = len(self.floats)
        lines = [f"loadrt scale count={count}",
                 f"loadrt sampler depth=16000 cfg={'f' * count}{'s' * len(INTEGERS)}{'b' * len(self.bits)}", "newsig row s32"]
        for n, (name, pin, gain) in enumerate(self.floats):
            lines += [f"setp scale.{n}.gain {gain:.0f}", f"net scaled-{name} scale.{n}.out => sampler.0.pin.{n}",
                      f"net {self.linked(name, pin)} => scale.{n}.in", f"addf scale.{n} servo-thread"]
        for n, (name, source) in enumerate(INTEGERS + self.bits, count):
            lines.append(f"net {self.linked(name, source) if source else name} => sampler.0.pin.{n}")
        return "\n".join([*lines, "addf sampler.0 servo-thread"]) + "\n"

    def linked(self, name, pin):
        """The signal of a pin, and the pin where it is on none yet."""
        return self.signals.get(pin) or f"recorded-{name} {pin}"

    def read(self, path, _ini):
        scales = [1 / gain for _, _, gain in self.floats]
        rows, first = [], None
        with open(path, encoding="utf-8") as file:
            for line in file:
                words = line.split()
                if "overrun" in words:
                    raise RuntimeError("the recorder lost samples")
                if len(words) != len(self.recorded):
                    continue  # cut off in the middle of a line
                first = int(words[0]) if first is None else first
                floats = [float(word) * scale for word, scale in zip(words[1:], scales, strict=False)]
                rows.append([(int(words[0]) - first) * PERIOD, *floats, *(int(word) for word in words[1 + len(floats):])])
        return rows


class FramedRecorder(Recorder):
    """The same in the coordinates of the frame, also where it is off: positions jump at no switch. The sampler takes 21
    pins: those of the joints stand in place of what is seen of the indexer."""

    floats = (*(row for row in FLOATS if row[0] not in ("a", "joint_z")), ("machine_x", "joint.0.motor-pos-cmd", 1e6),
              ("machine_y", "joint.1.motor-pos-cmd", 1e6), ("machine_z", "joint.2.motor-pos-cmd", 1e6))
    bits = (*(row for row in BITS if "unlock" not in row[0]), ("framed", "framekins.active"))
    #: Joints come some periods after the axes of the frame that is active, mm.
    LATE = 1.0
    #: Both agree so far where the machine stands, mm.
    ROUNDED = 5e-6

    def __init__(self):
        super().__init__()
        self.signals |= {f"joint.{n}.motor-pos-cmd": f"joint-{n}" for n in range(3)}
        self.signals["motion.in-position"] = "motion-in-position"
        self.header = (*self.recorded, "joint_z")

    def read(self, path, _ini):
        rows = super().read(path, _ini)
        at = self.recorded.index
        place, machine, active = slice(at("x"), at("z") + 1), slice(at("machine_x"), at("machine_z") + 1), at("framed")
        #: what is seen of joints and of axes at the last period in which the axes counted
        joints = axes = [0.0, 0.0, 0.0]
        for row in rows:
            behind = framed.in_frame(row[machine])
            row.append(behind[2])
            if row[active] and max_difference(row[place], behind) < self.LATE:
                row[place] = [round(value, 9) for value in row[place]]
                axes, joints = row[place], behind
            else:
                # from the joints, whose last digit is rounded: where these stand the place stays the same
                row[place] = [round(a + (b - j), 9) for a, b, j in zip(axes, behind, joints, strict=True)]
                if max_difference(row[place], behind) > self.ROUNDED:
                    row[place] = axes = joints = behind
        return rows


def max_difference(some, others):
    return max(abs(a - b) for a, b in zip(some, others, strict=True))


#: pins that are on a signal of the machine already
SIGNALS = {"joint.2.motor-pos-cmd": "joint-2", "spindle.0.revs": "turns", "spindle.1.revs": "second-turns",
           "joint.3.unlock": "unlock", "joint.3.is-unlocked": "unlocked"}


class Outcome:
    """Whether a promise held, and what was measured or what went wrong; `figure` is what of it should be small."""

    def __init__(self, works, text, figure=None):
        self.works, self.text, self.figure = works, text, figure


def behind_framekins(hal):
    """The HAL file of the machine with framekins before its kinematics, which stay."""
    return f"loadrt framekins inner=trivkins\n{hal}{FRAMEKINS}"


@dataclasses.dataclass(frozen=True)
class Setting:
    """What is between the planner and the joints, and who operates."""

    ini: dict = dataclasses.field(default_factory=dict)
    edit_hal: Callable[[str], str] | None = None
    recorder: type[Recorder] = Recorder
    display: str = "operate.py"
    #: subroutines beside those of the machine
    subroutines: dict = dataclasses.field(default_factory=dict)
    #: The axes whose limits hold; with a frame blendtp keeps those of the joints, LinuxCNC's planner those of the frame's axes.
    limited: dict = dataclasses.field(default_factory=lambda: dict.fromkeys(("tpmod", "blendtp"), ("x", "y", "z", "a", "b")))


SETTINGS = {
    "plain": Setting(),
    "framekins": Setting(edit_hal=behind_framekins),
    "frame": Setting(framed.INI, lambda hal: hal + framed.HAL, FramedRecorder, "framed_operate.py", framed.SUBROUTINES,
                     {"tpmod": ("x", "y", "z", "b"), "blendtp": ("machine_x", "machine_y", "machine_z", "b")}),
}


def configuration(setting, folder):
    """The machine in a folder of its own, with the subroutines of the setting."""
    shutil.copytree(os.path.join(HERE, "machine"), folder, dirs_exist_ok=True)
    for name, text in setting.subroutines.items():
        with open(os.path.join(folder, "subroutines", name), "w", encoding="utf-8") as file:
            file.write(text)
    return folder


def run(planner, names=None, verbose=False, behind="plain"):
    """{name of the row: Outcome} with this [TRAJ]TPMOD; `names` picks rows. behind: which of SETTINGS."""
    setting = SETTINGS[behind]
    rows = {row.name(): row for row in all_rows(behind) if not names or row.name() in names}
    left, outcomes, attempts = list(rows), {}, dict.fromkeys(rows, 0)
    files = ["contract/" + name for name in sorted(os.listdir(HERE))
             if re.fullmatch(r"(row|rows_\w+|operate|framed|framed_operate|delays)\.py", name)]
    for _ in range(MOST_SESSIONS):
        if not left:
            break
        with tempfile.TemporaryDirectory(prefix="framepath-contract.") as folder:
            result = harness.run([["rows", left]], sample="machine", configuration=configuration(setting, folder),
                                 ini={**setting.ini, ("TRAJ", "TPMOD"): planner},
                                 hal=JERK_LIMITS if planner == "blendtp" else "", recorder=setting.recorder(), files=files,
                                 edit_hal=setting.edit_hal, display=setting.display, timeout=60 + 30 * len(left))
        if verbose:
            print(result.log)
        if result.failure:
            raise RuntimeError(f"{planner}: {result.failure}\n{result.log}")
        for name, outcome in result.answers["rows"].items():
            outcomes[name] = judge(rows[name](), outcome, result, setting.limited[planner])
            attempts[name] += 1
            spoilt = outcome["delay"] > DISTURBED and not outcomes[name].works
            if not spoilt or attempts[name] >= ATTEMPTS.get(planner, 1):
                left.remove(name)
            else:
                print(f"{planner}: {name} is repeated: {outcomes[name].text}, while the computer was busy for "
                      f"{outcome['delay']:.2f} s", flush=True)
    outcomes.update({name: Outcome(False, "not run") for name in left})
    return outcomes


def judge(row, outcome, result, limited):
    index = result.header.index("row")
    rows = [line for line in result.rows if line[index] == outcome["number"]]
    seen = Seen(result.header, rows, outcome["kept"], outcome["errors"])
    try:
        if outcome["failure"]:
            raise Broken(outcome["failure"])
        if outcome["errors"] and not row.errors_expected:
            raise Broken(f"LinuxCNC says: {outcome['errors'][0]}")
        answer = row.check(seen) or ""
        if not row.interrupted:
            check_limits(seen, [axis for axis in limited if axis not in row.unchecked])
        text, figure = answer if isinstance(answer, tuple) else (answer, None)
        return Outcome(True, text, figure)
    except (ArithmeticError, LookupError, ValueError) as error:
        # nothing of what is looked for was seen
        return Outcome(False, "; ".join([f"cannot be judged ({error!r})", *outcome["errors"]]))
    except Broken as broken:
        said = "; ".join(text for text in outcome["errors"] if text not in str(broken))
        return Outcome(False, f"{broken} ({said})" if said else str(broken))


def check_limits(seen, limited):
    """Velocity and acceleration of each axis; jerk is what a planner may or may not limit."""
    for axis in limited:
        velocity, acceleration, jerk = peaks(seen.column(axis))
        share = 0.9 if axis == "y" else 1.0
        seen.require(velocity < share * VELOCITY * 1.002, f"{axis.upper()} at {velocity:.4g} units/s")
        seen.require(acceleration < share * ACCELERATION * 1.005, f"{axis.upper()} accelerates by {acceleration:.4g} units/s2")
        seen.jerk = max(getattr(seen, "jerk", 0.0), jerk)
