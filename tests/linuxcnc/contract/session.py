"""Runs rows of the outcome table in a real LinuxCNC with one planner, and says what came of each."""

import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
sys.path.insert(0, HERE)

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

    header = ("time", *(name for name, _, _ in FLOATS), *(name for name, _ in INTEGERS), *(name for name, _ in BITS))

    def hal(self):
        count = len(FLOATS)
        lines = [f"loadrt scale count={count}",
                 f"loadrt sampler depth=16000 cfg={'f' * count}{'s' * len(INTEGERS)}{'b' * len(BITS)}", "newsig row s32"]
        for n, (name, pin, gain) in enumerate(FLOATS):
            lines += [f"setp scale.{n}.gain {gain:.0f}", f"net scaled-{name} scale.{n}.out => sampler.0.pin.{n}",
                      f"net {SIGNALS.get(pin, f'recorded-{name}')} {'' if pin in SIGNALS else pin} => scale.{n}.in",
                      f"addf scale.{n} servo-thread"]
        for n, (name, source) in enumerate(INTEGERS + BITS, count):
            signal = SIGNALS.get(source, f"recorded-{name}") if source else name
            lines.append(f"net {signal} {'' if source in SIGNALS else source or ''} => sampler.0.pin.{n}")
        return "\n".join([*lines, "addf sampler.0 servo-thread"]) + "\n"

    def read(self, path, _ini):
        scales = [1 / gain for _, _, gain in FLOATS]
        rows, first = [], None
        with open(path, encoding="utf-8") as file:
            for line in file:
                words = line.split()
                if "overrun" in words:
                    raise RuntimeError("the recorder lost samples")
                if len(words) != len(self.header):
                    continue  # cut off in the middle of a line
                first = int(words[0]) if first is None else first
                floats = [float(word) * scale for word, scale in zip(words[1:], scales, strict=False)]
                rows.append([(int(words[0]) - first) * PERIOD, *floats, *(int(word) for word in words[1 + len(floats):])])
        return rows


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


def run(planner, names=None, verbose=False, framekins=False):
    """{name of the row: Outcome} with this [TRAJ]TPMOD; `names` picks rows. framekins: before the kinematics of the machine."""
    rows = {row.name(): row for row in all_rows() if not names or row.name() in names}
    left, outcomes, attempts = list(rows), {}, dict.fromkeys(rows, 0)
    files = ["contract/" + name for name in sorted(os.listdir(HERE))
             if re.fullmatch(r"(row|rows_\w+|operate|delays)\.py", name)]
    for _ in range(MOST_SESSIONS):
        if not left:
            break
        result = harness.run([["rows", left]], sample="machine", configuration=os.path.join(HERE, "machine"),
                             ini={("TRAJ", "TPMOD"): planner}, hal=JERK_LIMITS if planner == "blendtp" else "",
                             recorder=Recorder(), files=files, edit_hal=behind_framekins if framekins else None,
                             display="operate.py", timeout=60 + 30 * len(left))
        if verbose:
            print(result.log)
        if result.failure:
            raise RuntimeError(f"{planner}: {result.failure}\n{result.log}")
        for name, outcome in result.answers["rows"].items():
            outcomes[name] = judge(rows[name](), outcome, result)
            attempts[name] += 1
            spoilt = outcome["delay"] > DISTURBED and not outcomes[name].works
            if not spoilt or attempts[name] >= ATTEMPTS.get(planner, 1):
                left.remove(name)
            else:
                print(f"{planner}: {name} is repeated: {outcomes[name].text}, while the computer was busy for "
                      f"{outcome['delay']:.2f} s", flush=True)
    outcomes.update({name: Outcome(False, "not run") for name in left})
    return outcomes


def judge(row, outcome, result):
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
            check_limits(seen, row.unchecked)
        text, figure = answer if isinstance(answer, tuple) else (answer, None)
        return Outcome(True, text, figure)
    except (ArithmeticError, LookupError, ValueError) as error:
        # nothing of what is looked for was seen
        return Outcome(False, "; ".join([f"cannot be judged ({error!r})", *outcome["errors"]]))
    except Broken as broken:
        said = "; ".join(text for text in outcome["errors"] if text not in str(broken))
        return Outcome(False, f"{broken} ({said})" if said else str(broken))


def check_limits(seen, unchecked):
    """Velocity and acceleration of each axis; jerk is what a planner may or may not limit."""
    for axis in "xyzab":
        if axis in unchecked:
            continue
        velocity, acceleration, jerk = peaks(seen.column(axis))
        share = 0.9 if axis == "y" else 1.0
        seen.require(velocity < share * VELOCITY * 1.002, f"{axis.upper()} at {velocity:.4g} units/s")
        seen.require(acceleration < share * ACCELERATION * 1.005, f"{axis.upper()} accelerates by {acceleration:.4g} units/s2")
        seen.jerk = max(getattr(seen, "jerk", 0.0), jerk)
