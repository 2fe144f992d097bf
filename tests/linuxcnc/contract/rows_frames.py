"""What an operator does in the middle of a programmed frame, where the machine's own axes count."""

import math

import framed
from row import MICROMETRE, Row, peaks

SECTION = "Frames"
#: where the wall is that the probe touches, X of the machine
WALL = 20.0


class ProbingInFrame(Row):
    """G38.2 and G38.4 in a turned frame: the stop is on its line, the touch is told in its coordinates, no neighbour is
    blended"""

    section = SECTION
    behind = ("frame",)

    def operate(self, op):
        op.pin("wall.in0", WALL)
        op.begin("G64 P1", "G1 X5 Y5", "G38.2 X60 Y5 F600", "(DEBUG, #5061 #5062 #5063 #5070)", "G1 X10 Y5 F3000",
                 "G38.3 X60 Y5 F600", "G38.4 X10 F300", "(DEBUG, #5061 #5062 #5063 #5070)", "G1 X5")
        op.finish(40)
        op.keep("said", [[float(word) for word in text.split()] for kind, text in op.messages
                         if kind not in (11, 12, 1, 2) and text[:1].isdigit()][-2:])

    def check(self, seen):
        said = seen.kept["said"]
        seen.require(len(said) == 2, f"{said}")
        for x, y, z, touched in said:
            seen.near(framed.on_machine((x, y, z))[0], WALL, 0.05, "X of the machine at the touch")
            seen.require(touched == 1 and abs(y - 5) + abs(z) < 1e-4, f"told {said}")
        points = seen.columns("x", "y", "z")
        off = max(max(abs(y - 5), abs(z)) for x, y, z in points if x > 5.01)
        seen.require(off < MICROMETRE, f"{off:.4f} mm from the line")
        seen.require(any(abs(x - 5) + abs(y - 5) < 1e-5 for x, y, _ in points), "blended before the probe")
        return f"at X {framed.on_machine(said[0][:3])[0]:.3f} of the machine for {WALL:.0f}"


class TouchInFrame(Row):
    """A touch in a move of a turned frame that does not probe stops it, with LinuxCNC's error"""

    section = SECTION
    behind = ("frame",)
    errors_expected = True

    def operate(self, op):
        op.pin("wall.in0", 12)
        op.begin("G64 P1", "G1 X40 F3000", "G1 Y10")
        op.sleep(0.8)
        op.stopped()
        op.keep("place", op.place()[:3])
        op.pin("wall.in0", 1000)

    def check(self, seen):
        x = framed.on_machine(seen.kept["place"])[0]
        seen.require(any("Probe tripped" in error for error in seen.errors), f"{seen.errors}")
        seen.require(12 <= x < 15, f"stops at X {x:.2f} of the machine")
        seen.require(max(abs(value) for value in seen.kept["place"][1:]) < MICROMETRE, f"stops beside the line, at {seen.kept['place']}")
        return f"stops at X {x:.2f} of the machine"


class JogInFrame(Row):
    """A jog of an axis runs along that of the turned frame, also behind an abort, and MDI goes on from where it ended"""

    section = SECTION
    behind = ("frame",)

    def operate(self, op):
        places = []
        for aborts in (False, True):
            op.say("G1 F3000 X5 Y5")
            if aborts:
                op.begin("G1 X5 Y5", "G1 X60")
                op.until("motion", lambda: op.status.position[0] > 15)
                op.abort()
                op.stopped()
            op.say("G91 G1 F3000 X1")
            before = op.place()[:3]
            op.jog_along(1, 20, 7)
            op.say("X1")
            op.say("G90")
            places.append([before, op.place()[:3]])
        op.keep("places", places)

    def check(self, seen):
        for before, after in seen.kept["places"]:
            moved = [b - a for a, b in zip(before, after, strict=True)]
            off = math.dist(moved, (1, 7, 0))
            seen.require(off < 1e-3, f"moved by {moved}")


class SoftLimitInFrame(Row):
    """An arc of a turned frame that leaves a joint's soft limits between its ends is refused before it begins"""

    section = SECTION
    behind = ("frame",)
    errors_expected = True

    def operate(self, op):
        # Y of the machine is at 95.2 at both ends of the arc, and would be at 107 in between
        op.say("G0 X120 Y40")
        op.begin("G1 F6000 X120 Y40", "G3 X90 Y63 R20", "G1 Y40")
        op.sleep(1)
        op.stopped()

    def check(self, seen):
        greatest = max(seen.column("machine_y"))
        seen.require(seen.errors, "nothing is said")
        seen.require(greatest <= 100.0, f"Y of the machine goes to {greatest:.2f}, its limit is 100")
        return f"Y of the machine goes to {greatest:.1f}"


class ThreadUnderScale(Row):
    """A thread along an axis that the frame scales is refused, since its pitch would be scaled as well"""

    section = SECTION
    behind = ("frame",)
    errors_expected = True

    def operate(self, op):
        op.begin("o<ascale> call [1] [1] [2]", "M3 S300", "G4 P0.4", "G33 Z-8 K2", "G0 X5")
        op.sleep(4)
        op.abort()
        op.stopped()
        op.say("o<frame_off> call")

    def check(self, seen):
        moving = [x != 0 or z != 0 for x, z in seen.columns("machine_x", "machine_z")]
        if any(moving):
            turned = [turns for turns, moves in zip(seen.column("turns"), moving, strict=True) if moves]
            seen.require(False, f"cut in {turned[-1] - turned[0]:.1f} turns without a word")
        seen.require(any("pitch" in error for error in seen.errors), f"{seen.errors}")


class ExternalOffsetInFrame(Row):
    """An external offset runs along an axis of the turned frame, no joint moves when the frame goes, and it is taken away
    again"""

    section = SECTION
    behind = ("frame",)
    unchecked = "machine_x machine_y machine_z"

    def operate(self, op):
        op.pin("axis.y.eoffset-enable", 1)
        op.sleep(0.05)
        op.begin("G64 P0.5", "G1 X20", "G1 Y10", "G1 X60", "G4 P0.4", "G1 X40")
        op.wait_moving()
        op.pin("axis.y.eoffset-counts", 200)
        op.until("the dwell", lambda: op.status.position[0] > 60 - 1e-6)
        op.sleep(0.2)
        op.keep("with", op.place()[:3])
        op.finish(40)
        op.keep("end", op.place()[:3])
        op.until("no frame", lambda: not op.get("framekins.active"))
        op.sleep(0.2)
        op.keep("without a frame", op.place()[:3])
        before = op.machine_place()
        op.pin("axis.y.eoffset-counts", 0)
        op.sleep(0.8)
        op.keep("taken away", [b - a for a, b in zip(before, op.machine_place(), strict=True)])

    def check(self, seen):
        for name, wanted in (("with", (60, 12, 0)), ("end", (40, 12, 0)), ("without a frame", (40, 12, 0)),
                             ("taken away", (0, -2, 0))):
            off = math.dist(seen.kept[name], wanted)
            seen.require(off < 2e-3, f"{name}: {', '.join(f'{value:.3f}' for value in seen.kept[name])} for {wanted}")


class LimitsInFrame(Row):
    """Each joint keeps its velocity and acceleration in corners of a turned frame, whose axes move all of them"""

    section = SECTION
    behind = ("frame",)

    def operate(self, op):
        op.go("G64 P1 F9000", "G1 X30 Y20", "G1 X0 Y30", "G1 X30 Y40", "G1 X0 Y0", "G2 X0 Y0 I10 J10", "G0 X30 Y30 Z10", "G0 X0 Y0 Z0")

    def check(self, seen):
        fastest = 0.0
        for axis in ("machine_x", "machine_y", "machine_z"):
            velocity, acceleration, _ = peaks(seen.column(axis))
            seen.require(velocity < 100.2 and acceleration < 1005,
                         f"{axis[-1].upper()} of the machine at {velocity:.0f} mm/s, {acceleration:.0f} mm/s2")
            fastest = max(fastest, velocity)
        return f"fastest {fastest:.0f} of 100 mm/s"
