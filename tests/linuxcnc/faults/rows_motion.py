"""A program is broken off in the middle of its motion."""

import concurrent.futures
import math
import os

from fault import HEAD, OFF, TOLERANCE, Fault, Peaks, from_route, harness, operated, require, trial_was_right, without_failure

SECTION = "Motion"
#: LinuxCNCs side by side for the aborts, and how many aborts there are.
SESSIONS, ABORTS, FEW = 4, 1000, 40


def lines(points, letters="XYZ"):
    return ["G1 " + " ".join(f"{letter}{value:.5f}" for letter, value in zip(letters, point, strict=True)) for point in points]


ZIGZAG = [(7.0 * n, 6.0 * (n % 2), 1.5 * (n % 3)) for n in range(13)]
DENSE = [(0.15 * n, 12 * math.sin(0.02 * n), 2 * math.cos(0.013 * n)) for n in range(500)]
#: Half circles, one behind the other, alternately to both sides.
ARCS = [f"G3 X{10 * n} Y0 I5" if n % 2 else f"G2 X{10 * n} Y0 I5" for n in range(1, 8)]
ARC_POINTS = [(5 + 10 * n - 5 * math.cos(a), (-1 if n % 2 == 0 else 1) * 5 * math.sin(a), 0.0)
              for n in range(7) for a in (math.pi * k / 90 for k in range(91))]
ROTARY = [(4.0 * n, 3.0 * (n % 2), 0.0, 0.0, 10.0 * (n % 4)) for n in range(1, 15)]


def turned(points):
    """Of a frame that is shifted by X 20 Y 5 and turned by 30 degrees about Z."""
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
    return [(20 + c * x - s * y, 5 + s * x + c * y, z) for x, y, z in points]


def text(start, *code):
    return "\n".join([HEAD, start, *code, "M2"]) + "\n"


#: {name: (program, where its joints go)}
SHAPES = {
    "blends": (text("G0 X0 Y0 Z0", *lines(ZIGZAG)), ZIGZAG),
    "arcs": (text("G0 X0 Y0 Z0", *ARCS), [(0.0, 0.0, 0.0), *ARC_POINTS]),
    "dense": (text("G0 X0 Y0 Z2", *lines(DENSE)), [(0.0, 0.0, 2.0), *DENSE]),
    "frame": (text("G0 X0 Y0 Z0", "o<trans> call [20] [5] [0]", "o<arot> call [0] [0] [30]", *lines(ZIGZAG)),
              [(0.0, 0.0, 0.0), *turned(ZIGZAG)]),
}
ROTARY_SHAPES = {"rotary": (text("G0 X0 Y0 Z0 B0", *lines([(*xyz, b) for *xyz, _, b in ROTARY], "XYZB")),
                            [(0.0,) * 5, *ROTARY])}
CONTRACT = os.path.join(harness.HERE, "contract", "machine")


def abort_session(shapes, count, seed, joints, **options):
    """Peaks, and the greatest distance of a rest from the route of its program, mm."""
    programs = {f"{name}.ngc": program for name, (program, _) in shapes.items()}
    result = operated([["aborts", sorted(shapes), count, seed, "PROGRAMS"], ["run", "PROGRAMS/trial.ngc"], ["note", "trial"]],
                      programs, timeout=120 + 6 * count, **options)
    without_failure(result)
    require(len(result.answers["stops"]) == count, "not all of them were done")
    trial_was_right(result)
    off = max(from_route([rest], [begin, *shapes[name][1]]) for name, begin, rest in result.answers["stops"])
    require(off <= TOLERANCE + OFF, f"a rest is {off:.3f} mm off the path")
    return Peaks(result, joints).require(), off


class Aborts(Fault):
    """Each time the machine rests on its path within 4 s, within all limits, without an error; the next program is right"""

    section = SECTION
    done = "1,000 aborts at random periods of programs of blends, arcs and dense code"
    shapes: tuple[str, ...] = ("arcs", "blends", "dense")
    parts = SESSIONS

    def sessions(self):
        shapes = {name: SHAPES[name] for name in self.shapes}
        if self.short:
            return [abort_session(shapes, FEW, 0, range(3))]
        with concurrent.futures.ThreadPoolExecutor(SESSIONS) as pool:
            return list(pool.map(lambda seed: abort_session(shapes, ABORTS // SESSIONS, seed, range(3)),
                                 range(self.parts)))

    def run(self):
        peaks, off = zip(*self.sessions(), strict=True)
        shares = [max(peak.shares[degree] for peak in peaks) for degree in range(3)]
        return "v {:.3f}, a {:.3f}, j {:.3f}, rests within {:.3f} mm of the program".format(*shares, max(off))


class FramedAborts(Aborts):
    __doc__ = Aborts.__doc__
    done = "250 aborts at random periods of a program in a frame"
    shapes = ("frame",)
    parts = 1


class RotaryAborts(Aborts):
    __doc__ = Aborts.__doc__
    done = "250 aborts at random periods of a program with a rotary axis"

    def sessions(self):
        recorder = harness.Recorder(5, "xyzab")
        del recorder.integers["slot"]
        recorder.header.remove("slot")
        jerk = "".join(f"setp blendtp.axis.{axis}.max-jerk 20000\n" for axis in "xyzab")
        return [abort_session(ROTARY_SHAPES, FEW if self.short else ABORTS // SESSIONS, 9, range(5), hal=jerk,
                              recorder=recorder, sample="machine", configuration=CONTRACT)]


class MachineOff(Fault):
    """LinuxCNC stops the joints where they are: none jumps, at most one step of its velocity; on again, the next program is
    right"""

    section = SECTION
    done = "machine off and emergency stop in blends, 20 times, also in a frame"

    def run(self):
        times = 3 if self.short else 10
        programs = {f"{name}.ngc": program for name, (program, _) in SHAPES.items()}
        result = operated([["off_and_on", times, "PROGRAMS", "blends", 1], ["off_and_on", times, "PROGRAMS", "frame", 2]],
                          programs)
        without_failure(result)
        for name in result.answers:
            if name.startswith("trial"):
                trial_was_right(result, name)
        peaks = Peaks(result).require((0,))
        return f"v {peaks.shares[0]:.3f}, {2 * times} times"


