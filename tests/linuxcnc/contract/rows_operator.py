"""What an operator does in the middle of it all."""

import math
from itertools import pairwise

from row import MICROMETRE, WITHOUT_A_FRAME, Broken, Row, difference, from_route

SECTION = "Operator"
ZIGZAG = [(0.0, 0.0)] + [(8.0 * n, 10.0 * (n % 2)) for n in range(1, 9)]
ZIGZAG_LINES = [f"G1 X{x} Y{y}" for x, y in ZIGZAG[1:]]


class AbortOnThePath(Row):
    """An abort, in a blend as well, comes to rest on the path; what follows goes on from there"""

    section = SECTION

    def operate(self, op):
        ends = []
        for wait in (0.12, 0.25, 0.33, 0.41):
            op.begin("G64 P1", *ZIGZAG_LINES)
            op.wait_moving()
            op.sleep(wait)
            op.abort()
            op.stopped()
            x, y = op.place()[:2]
            op.say("G91 G1 F3000 Z1")
            op.say("G90 Z0")
            ends.append([x, y, *op.place()[:2]])
            op.say("G0 X0 Y0")
        op.keep("ends", ends)

    def check(self, seen):
        away = 0.0
        for x, y, later_x, later_y in seen.kept["ends"]:
            seen.require(abs(x - later_x) + abs(y - later_y) < 1e-6, "the next move starts elsewhere")
            away = max(away, from_route([(x, y)], ZIGZAG))
        seen.require(away < 1.001, f"{away:.2f} mm from the path, P is 1")
        return f"within {away:.2f} mm of the program, P is 1"


class AbortIsSmooth(Row):
    """An abort brakes without a jump of the acceleration"""

    section = SECTION

    def operate(self, op):
        op.begin("G1 X60 F5400")
        op.until("speed", lambda: op.status.position[0] > 20)
        op.abort()
        op.stopped()

    def check(self, seen):
        acceleration = difference(difference(seen.column("x")))
        step = max(abs(b - a) for a, b in pairwise(acceleration))
        seen.require(step < 30, f"the acceleration jumps by {step:.0f} mm/s2 in a period")
        return f"steps of {step:.0f} mm/s2 a period", step


class PauseAndResume(Row):
    """Pauses and resumes in blends leave neither the path nor the limits"""

    section = SECTION

    def operate(self, op):
        op.begin("G64 P1", *ZIGZAG_LINES)
        op.wait_moving()
        paused = []
        for wait in (0.1, 0.17, 0.05, 0.21, 0.13):
            op.sleep(wait)
            op.pause()
            op.stopped()
            first = op.place()[:2]
            op.sleep(0.05)
            paused.append([op.place()[:2] == first, bool(op.status.paused)])
            op.resume()
        op.finish(40)
        op.keep("paused", paused)

    def check(self, seen):
        seen.require(all(stood and paused for stood, paused in seen.kept["paused"][:3]), f"{seen.kept['paused']}")
        away = from_route(seen.columns("x", "y"), ZIGZAG)
        seen.require(away < 1.001, f"{away:.2f} mm from the program")
        return f"within {away:.2f} mm of the program, P is 1"


class MachineOff(Row):
    """Machine off in motion, on again, and the next program is right"""

    section = SECTION
    interrupted = True

    def operate(self, op):
        for leave in (op.machine_off, op.estop):
            op.begin("G64 P1", *ZIGZAG_LINES)
            op.wait_moving()
            op.sleep(0.25)
            leave()
            op.sleep(0.1)
            op.on()
            op.sleep(0.05)
            op.keep("on", op.place()[:2])
            op.go("G64 P0.2", "G1 X0 Y0", "G1 X10", "G1 Y10")

    def check(self, seen):
        seen.near(seen.column("x")[-1], 10, 1e-6, "X")
        seen.near(seen.column("y")[-1], 10, 1e-6, "Y")


class EstopThenResume(Row):
    """A resume after an emergency stop, in motion or in a pause, moves nothing where the program had been read to its end; the
    next program is right"""

    section = SECTION
    interrupted = True

    def operate(self, op):
        moved = []
        # In a pause first: a resume without one takes up what task was doing at the last pause. Where it was reading, it
        # reads the program from its beginning, with either planner.
        for paused in (True, False):
            op.begin("G64 P1", *ZIGZAG_LINES)
            op.wait_read()
            op.wait_moving()
            op.sleep(0.25)
            if paused:
                op.pause()
                op.stopped()
            op.estop()
            op.sleep(0.1)
            op.on()
            op.switch_mode("auto")
            op.stopped()
            before = op.place()[:2]
            op.resume()
            op.until("the resume to be heard", op.was_heard)
            op.sleep(0.3)
            moved.append(math.dist(before, op.place()[:2]))
            op.go("G64 P0.2", "G1 X0 Y0", "G1 X10", "G1 Y10")
        op.keep("moved", moved)

    def check(self, seen):
        seen.require(max(seen.kept["moved"]) < 1e-6, f"moved by {max(seen.kept['moved']):.3g} mm")
        seen.near(seen.column("x")[-1], 10, 1e-6, "X")
        seen.near(seen.column("y")[-1], 10, 1e-6, "Y")


class ModesAndJogs(Row):
    """Manual mode, a jog of an axis, and the next program starts from where the jog ended"""

    section = SECTION
    behind = WITHOUT_A_FRAME
    unchecked = "y"

    def operate(self, op):
        op.go("G1 X5 Y5")
        op.jog_along(1, 20, 7)
        op.go("G64 P0.5", "G91 G1 X5", "G1 Y5", "G90")
        op.switch_mode("manual")
        op.switch_mode("auto")
        op.switch_mode("mdi")
        op.say("G91 G1 X1 F3000")
        op.say("G90")

    def check(self, seen):
        seen.near(seen.column("x")[-1], 11, 1e-3, "X")
        seen.near(seen.column("y")[-1], 17, 1e-3, "Y")


class RunFromLine(Row):
    """A program started from a line runs from there"""

    section = SECTION

    def operate(self, op):
        op.start(op.write(["G64 P0.1", *ZIGZAG_LINES]), 6)
        op.finish(40)

    def check(self, seen):
        lines = [line for line in seen.column("line") if line > 0]
        seen.require(lines and min(lines) >= 6, f"starts with line {min(lines, default=0)}")
        seen.near(seen.column("x")[-1], 64, 1e-6, "X")


class SoftLimitBetweenTheEnds(Row):
    """A move that leaves the soft limits between its ends is refused before it begins"""

    section = SECTION
    behind = WITHOUT_A_FRAME
    errors_expected = True

    def operate(self, op):
        op.say("G0 Y95")
        op.begin("G1 F6000 X1", "G2 X41 Y95 R20.2", "G1 Y80")
        op.sleep(1)
        op.stopped()

    def check(self, seen):
        greatest = max(seen.column("y"))
        seen.require(seen.errors, "nothing is said")
        seen.require(greatest <= 100.0, f"Y goes to {greatest:.2f}, the limit is 100")
        return f"Y goes to {greatest:.1f}"


class LimitsChangedLive(Row):
    """Limits of axes that are changed in motion (ini.* pins) hold from the next rest on, without a jump"""

    section = SECTION

    def operate(self, op):
        op.begin("G64 P0.2", "G1 X60 F6000", "G4 P0.02", "G1 X0")
        op.until("speed", lambda: op.status.position[0] > 15)
        op.pin("ini.x.max_velocity", 40)
        op.pin("ini.x.max_acceleration", 500)
        op.finish(40)

    def check(self, seen):
        # with a frame X of the machine
        back = seen.during(5).top_speed("machine_x" if "machine_x" in seen.header else "x")
        seen.require(back < 40.1, f"the move behind the change runs at {back:.0f} mm/s for 40")
        return f"{back:.1f} mm/s for 40"


class StepFromAPause(Row):
    """A step from a pause in motion ends at the end of its line"""

    section = SECTION
    behind = WITHOUT_A_FRAME

    def operate(self, op):
        op.begin("G61 F2400", "G1 X30", "G1 X50", "G3 X50 Y20 R10", "G1 X30")
        op.until("the first line", lambda: op.status.position[0] > 2)
        op.pause()
        op.stopped()
        rests = [op.place()[:2]]
        for _ in range(4):
            op.step()
            op.sleep(0.1)
            op.stopped(0.15)
            rests.append(op.place()[:2])
        op.keep("rests", rests)
        op.resume()
        op.finish(20)

    def check(self, seen):
        paused, *rests = seen.kept["rests"]
        seen.require(paused[0] < 29, f"paused at {paused}, behind the first line")
        ends = [(30, 0), (50, 0), (50, 20), (30, 20)]
        away = [math.dist(rest, end) for rest, end in zip(rests, ends, strict=True)]
        # LinuxCNC's planner may be a period beyond, at the end of its braking.
        seen.require(max(away) < 0.05, f"rests {max(away):.2f} mm from the end of a line")
        return f"rests {max(away):.2f} mm from the ends of lines"


class StepThroughOutputsAndDwells(Row):
    """Steps through a program with rapids, dwells and outputs end, and reach the end"""

    section = SECTION
    errors_expected = True

    def operate(self, op):
        op.open(op.write(["G64 P0.3", "G0 X5", "M62 P0", "G1 X10", "G4 P0.05", "G1 Y5", "M63 P0", "G1 X0 Y0"]))
        steps = 0
        while op.status.interp_state != 1 or steps == 0:
            op.step()
            steps += 1
            op.stopped(0.2)
            if steps > 30:
                raise Broken(f"after 30 steps at {op.place()}")
        op.keep("steps", steps)
        op.keep("place", op.place()[:2])

    def check(self, seen):
        seen.require(max(abs(value) for value in seen.kept["place"]) < 1e-6, f"stands at {seen.kept['place']}")
        return f"{seen.kept['steps']} steps"


class Probing(Row):
    """G38.2 to G38.5: the stop is on the line, the touch is kept, and no neighbour is blended"""

    section = "Probing"
    behind = WITHOUT_A_FRAME

    def operate(self, op):
        op.pin("wall.in0", 20)
        op.begin("G64 P1", "G1 X5 Y5", "G38.2 X40 Y5 F600", "(DEBUG, #5061 #5062 #5070)", "G1 X10 Y5 F3000",
                 "G38.3 X30 Y5 F600", "(DEBUG, #5061 #5062 #5070)", "G38.4 X10 F300", "(DEBUG, #5061 #5062 #5070)",
                 "G38.3 X12 Y5", "(DEBUG, #5061 #5062 #5070)", "G1 X5")
        op.finish(40)
        op.keep("said", [[float(word) for word in text.split()] for kind, text in op.messages
                         if kind not in (11, 12, 1, 2) and text[:1].isdigit()][-4:])

    def check(self, seen):
        said = seen.kept["said"]
        seen.require(len(said) == 4, f"{said}")
        seen.near(said[0][0], 20, 0.05, "G38.2")
        seen.near(said[1][0], 20, 0.05, "G38.3")
        seen.near(said[2][0], 20, 0.05, "G38.4")
        seen.require([row[2] for row in said] == [1, 1, 1, 0], f"touched: {said}")
        seen.require(max(abs(y - 5) for x, y in seen.columns("x", "y") if x > 5.01) < MICROMETRE, "leaves the line")
        seen.require(any(abs(x - 5) + abs(y - 5) < 1e-6 for x, y in seen.columns("x", "y")), "blended before the probe")
        return f"G38.2 at X {said[0][0]:.3f} for 20"


class ProbeInOtherMoves(Row):
    """A touch in a move that does not probe stops it, with LinuxCNC's error"""

    section = "Probing"
    behind = WITHOUT_A_FRAME
    errors_expected = True

    def operate(self, op):
        op.pin("wall.in0", 12)
        op.begin("G64 P1", "G1 X40 F3000", "G1 Y10")
        op.sleep(0.8)
        op.stopped()
        op.keep("x", op.place()[0])
        op.pin("wall.in0", 1000)

    def check(self, seen):
        seen.require(any("Probe tripped" in error for error in seen.errors), f"{seen.errors}")
        seen.require(12 <= seen.kept["x"] < 15, f"stops at X {seen.kept['x']:.2f}")
        return f"stops at X {seen.kept['x']:.2f}"


class ExternalOffsets(Row):
    """External offsets add to a blended program and are taken away again"""

    section = SECTION
    behind = WITHOUT_A_FRAME

    def operate(self, op):
        op.pin("axis.y.eoffset-enable", 1)
        op.sleep(0.05)
        op.begin("G64 P0.5", *ZIGZAG_LINES)
        op.wait_moving()
        op.sleep(0.1)
        op.pin("axis.y.eoffset-counts", 200)
        op.finish(40)
        op.sleep(0.5)
        op.keep("offset", op.get("axis.y.eoffset"))
        op.keep("with", op.get("joint.1.pos-cmd"))
        op.pin("axis.y.eoffset-counts", 0)
        op.sleep(0.8)
        op.keep("without", op.get("joint.1.pos-cmd"))

    def check(self, seen):
        seen.near(seen.kept["offset"], 2, 1e-3, "offset")
        seen.near(seen.kept["with"], 2, 2e-3, "Y with the offset")
        seen.near(seen.kept["without"], 0, 2e-3, "Y without")
        seen.near(seen.column("x")[-1], 64, 1e-6, "X")


class MdiInOrder(Row):
    """Lines of MDI that are given faster than they run, one of them waiting for an input, are done in order"""

    section = SECTION

    def operate(self, op):
        op.switch_mode("mdi")
        for line in ("G61.1", "G1 F3000 X10", "G1 Y10", "M66 P1 L3 Q4", "G1 X0", "G1 Y0"):
            op.command.mdi(line)
        op.sleep(1)
        op.keep("waiting", op.place()[:2])
        op.pin("motion.digital-in-01", 1)
        op.finish(40)

    def check(self, seen):
        seen.require(max(abs(value - 10) for value in seen.kept["waiting"]) < 1e-6, f"waits at {seen.kept['waiting']}")
        off = from_route(seen.columns("x", "y"), [(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)])
        seen.require(off < MICROMETRE, f"{off:.3f} mm from the lines")


class QueueFull(Row):
    """More moves than the queue takes wait for their turn, and none is lost"""

    section = SECTION

    def operate(self, op):
        op.pin("motion.feed-inhibit", 1)
        op.begin("G64 P0.01 Q0", *[f"G1 X{0.01 * (n % 2)} Y{0.02 * n:.2f}" for n in range(1, 2601)])
        op.until("a full queue", lambda: op.status.queue_full or op.status.queue >= 2000, 60)
        op.sleep(0.2)
        op.keep("held", [op.place()[1], op.status.queue])
        op.abort()
        op.pin("motion.feed-inhibit", 0)
        op.begin("G64 P0.2 Q0", *[f"G1 X{0.2 * n:.1f} Y{0.5 * (n % 2)} F6000" for n in range(1, 101)])
        op.finish(40)

    def check(self, seen):
        place, queue = seen.kept["held"]
        seen.require(place < 0.1, f"at Y {place:.2f} although feed is inhibited")
        seen.near(seen.column("x")[-1], 20, 1e-6, "end")
        return f"{queue} moves queued", 1 / queue


class LimitSwitch(Row):
    """A limit switch in motion stops the machine with an error; after it is left, programs run"""

    section = SECTION
    errors_expected = True
    interrupted = True

    def operate(self, op):
        op.begin("G1 X40 F3000", "G1 X0")
        op.until("motion", lambda: op.status.position[0] > 10)
        op.pin("joint.0.pos-lim-sw-in", 1)
        op.sleep(0.3)
        op.keep("x", op.place()[0])
        op.pin("joint.0.pos-lim-sw-in", 0)
        op.on()
        op.go("G64 P0.1", "G1 X5", "G1 Y5", "G1 X0 Y0")

    def check(self, seen):
        seen.require(seen.errors, "nothing is said")
        seen.require(9 < seen.kept["x"] < 16, f"stood at X {seen.kept['x']:.1f}")
        seen.near(seen.column("x")[-1], 0, 1e-6, "X")
