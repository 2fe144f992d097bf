"""What LinuxCNC does with one of its samples, and what it does behind framekins and with blendtp: all of it has to hold."""

import dataclasses

import sample_machines as samples

#: machine units: what the interpreter keeps of a position is read back through the kinematics
CLOSE = 1e-6
#: seconds
PERIOD = 1e-3
#: When moves come decides a little what a planner makes of them.
SAME_TIME = 0.01


class Broken(Exception):
    """What does not hold."""


@dataclasses.dataclass(frozen=True)
class Found:
    """Seconds in which the rounded program moves by itself, by planner; periods that were compared; how far the joints are
    off in the frame, machine units."""

    seconds: dict[str, float]
    periods: int
    off: float


def insist(condition, text):
    if not condition:
        raise Broken(text)


def good(machine, result):
    """The result, where nothing went wrong up to the very end, and the program came to its end."""
    insist(not result.failure, f"{result.failure}\n{result.log}")
    insist(not result.errors, f"{result.errors}\n{result.log}")
    insist(result.status == 0, f"exit status {result.status}\n{result.log}")
    for name in samples.PROGRAMS:
        position = dict(zip("XYZABCUVW", result.answers[name]["position"], strict=True))
        for letter, value in machine.end.items():
            there = position[letter] * (machine.unit if letter in "XYZUVW" else 1)
            insist(abs(there - value) < 1e-4, f"{letter} ends at {there}, and not at {value}")
    return result


def is_the_same(machine, planner, alone, behind):
    """In each period the joints are where they are without framekins. How many periods."""
    expected, found = (samples.way(machine, result, "exact") for result in (alone, behind))
    insist(len(expected) > 200, f"only {len(expected)} periods were recorded")
    insist(len(expected) == len(found), f"{planner}: {len(found)} periods behind framekins, {len(expected)} without")
    for number, (joints, others) in enumerate(zip(found, expected, strict=True)):
        insist(joints == others, f"{planner}: period {number} has {joints} instead of {others}")
    return len(found)


def seconds(machine, planner, alone, behind):
    """Of the rounded program."""
    expected, found = (len(samples.way(machine, result, "rounded")) * PERIOD for result in (alone, behind))
    insist(abs(found - expected) <= SAME_TIME * expected, f"{planner}: {found} s behind framekins, {expected} s without")
    return expected


def off_in_frame(machine, result):
    """How far the joints of a place in the frame are from those of the same place without one."""
    insist(result.answers["active"] == "TRUE", "no frame was on")
    framed, plain = (result.answers[name]["joints"][:machine.joints] for name in ("framed", "plain"))
    off = max(abs(a - b) for a, b in zip(framed, plain, strict=True))
    insist(off < CLOSE, f"in the frame the joints are {framed}, and {plain} without it")
    return off


def row(machine, planners=("tpmod", "blendtp")):
    """The whole row of the table. Broken where something does not hold."""
    found = Found({}, 0, 0.0)
    for planner in planners:
        alone = good(machine, samples.run(machine, samples.program_steps(), planner))
        steps = [*samples.program_steps(), *samples.frame_steps(machine)]
        behind = good(machine, samples.run(machine, steps, planner, framed=True))
        found = Found({**found.seconds, planner: seconds(machine, planner, alone, behind)},
                      found.periods + is_the_same(machine, planner, alone, behind),
                      max(found.off, off_in_frame(machine, behind)))
    return found
