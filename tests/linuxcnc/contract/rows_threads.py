"""Motion in step with the angle of a spindle."""

from itertools import pairwise

from row import Row
from rows_spindle import fed_per_turn

SECTION = "Threads"
START = ("M3 S600", "G4 P0.5")


def groove(seen, top, bottom, pitch, turns="turns"):
    """How far apart Z and the angle of the spindle drift on the ways down between two heights, from the least to the
    greatest, mm; a whole number of turns does not count."""
    rows = seen.columns("joint_z", turns)
    phases: list[float] = []
    for (before, _), (z, turn) in pairwise(rows):
        if bottom < z < top and z < before:
            phase = -z / pitch - turn
            phases.append(phase - round(phase - (phases[0] if phases else 0.0)))
    seen.require(len(phases) > 40, "the thread was not cut")
    return (max(phases) - min(phases)) * pitch


class Index(Row):
    """G33 waits for the index and is in step with the angle from where the cut begins"""

    section = SECTION

    def operate(self, op):
        op.go(*START, "G33 Z-16 K2", "G0 X5", "G0 Z0", "G0 X0", "G33 Z-16 K2")

    def check(self, seen):
        steady = groove(seen, -4, -14, 2)
        seen.require(steady < 0.05, f"{steady * 1000:.1f} micrometres off")
        return f"{steady * 1000:.2f} micrometres off"


class EverySpeedTheSameGroove(Row):
    """Passes at different speeds run in the same groove"""

    section = SECTION

    def operate(self, op):
        op.go("M3 S300", "G4 P0.4", "G33 Z-16 K2", "G0 X5", "G0 Z0", "G0 X0", "M3 S900", "G4 P0.5", "G33 Z-16 K2")

    def check(self, seen):
        off = groove(seen, -5, -14, 2)
        seen.require(off < 0.02, f"{off * 1000:.1f} micrometres off")
        return f"{off * 1000:.2f} micrometres off", off


class Chained(Row):
    """Threads one behind the other run through, without a new wait"""

    section = SECTION

    def operate(self, op):
        op.pin("at-speed-0.in1", 0)
        op.begin("G64", *START, "G33 Z-12 K2", "G33 Z-24 K2", "G33 Z-32 X4 K2")
        op.until("three moves", lambda: op.status.queue >= 3)
        op.pin("at-speed-0.in1", 1)
        op.finish(40)

    def check(self, seen):
        down = [speed for z, speed in zip(seen.column("z"), seen.speed("z"), strict=False) if -28 < z < -6]
        seen.require(min(down) > 10, f"slows down to {min(down):.1f} mm/s between two threads")
        off = groove(seen, -4, -23, 2)
        seen.require(off < 0.05, f"{off * 1000:.0f} micrometres off")
        return f"slowest {min(down):.1f} of 20 mm/s"


class OverrideInThread(Row):
    """Feed override and pause do nothing in a thread; the pause holds at its end"""

    section = SECTION

    def operate(self, op):
        op.begin(*START, "G33 Z-40 K2", "G0 X5")
        op.until("the thread", lambda: op.status.position[2] < -6)
        op.feed_override(0.2)
        op.sleep(0.3)
        op.pause()
        op.sleep(2)
        op.keep("paused", [op.place()[0], op.place()[2]])
        op.feed_override(1)
        op.resume()
        op.finish(40)

    def check(self, seen):
        off = groove(seen, -5, -38, 2)
        seen.require(off < 0.05, f"{off:.2f} mm off")
        x, z = seen.kept["paused"]
        seen.near(z, -40, 1e-6, "Z in the pause")
        seen.near(x, 0, 1e-6, "X in the pause")
        return f"{off * 1000:.2f} micrometres off", off


class SpeedChangesInThread(Row):
    """A change of speed in the thread leaves it in its groove"""

    section = SECTION

    def operate(self, op):
        op.begin(*START, "G33 Z-60 K2")
        op.until("the thread", lambda: op.status.position[2] < -10)
        op.pin("ramp.maxv", 10)
        op.pin("ramp.max", 5)
        op.sleep(1)
        op.pin("ramp.max", 1e20)
        op.finish(40)

    def check(self, seen):
        off = groove(seen, -5, -58, 2)
        seen.require(off < 0.05, f"{off * 1000:.0f} micrometres off")
        return f"{off * 1000:.1f} micrometres off", off


class SecondSpindle(Row):
    """G33 $1 and G95 $1 follow the second spindle"""

    section = SECTION

    def operate(self, op):
        # LinuxCNC 2.9's interpreter takes the $ of G95 only beside another word that has one
        op.go("M3 S500 $1", "G4 P0.6", "G33 Z-16 K2 $1", "G0 Z0", "G95 M3 S500 $1 F1", "G1 X10", "G94")

    def check(self, seen):
        off = groove(seen, -5, -14, 2, "turns1")
        seen.require(off < 0.05, f"{off * 1000:.0f} micrometres off")
        seen.near(fed_per_turn(seen, 1.5, 8.5, "turns1"), 1, 0.01, "mm a turn")
        return f"{off * 1000:.2f} micrometres off", off


class TooFastAPitch(Row):
    """A thread that the axis cannot follow is refused with an error, within the limits"""

    section = SECTION
    errors_expected = True

    def operate(self, op):
        op.begin("M3 S1800", "G4 P1", "G33 Z-60 K5", "G0 X5")
        op.sleep(3.5)
        op.keep("z", op.place()[2])

    def check(self, seen):
        speed = seen.top_speed("z")
        seen.require(speed < 100.2, f"Z at {speed:.0f} mm/s")
        seen.require(seen.errors, f"cut out of step to Z {seen.kept['z']:.1f} without a word")


class Stall(Row):
    """A spindle that stops in a thread stops the program with an error; nothing is left for the next move"""

    section = SECTION
    errors_expected = True

    def operate(self, op):
        op.begin(*START, "G33 Z-60 K2", "G0 X5")
        op.until("the thread", lambda: op.status.position[2] < -6)
        op.pin("ramp.max", 0)
        op.sleep(1.6)
        op.keep("idle", op.status.interp_state == 1)
        op.abort()
        op.stopped()
        op.say("G1 F1200 X10")

    def check(self, seen):
        seen.require(seen.kept["idle"] and seen.errors, "waits for the spindle for ever")
        seen.near(seen.column("x")[-1], 10, 1e-6, "X")
        seen.near(seen.top_speed("x"), 20, 0.1, "mm/s")


class AbortInThread(Row):
    """After an abort in a thread the next move is not synchronised"""

    section = SECTION

    def operate(self, op):
        op.begin(*START, "G33 Z-60 K2")
        op.until("the thread", lambda: op.status.position[2] < -6)
        op.abort()
        op.stopped()
        op.keep("z", op.place()[2])
        op.say("M5")
        op.say("G1 F1200 X10")
        op.say(f"G1 Z{-12}")

    def check(self, seen):
        seen.require(-30 < seen.kept["z"] < -6, f"stopped at Z {seen.kept['z']:.1f}")
        seen.near(seen.top_speed("x"), 20, 0.1, "mm/s in X")
        seen.near(seen.column("z")[-1], -12, 1e-6, "Z")


class EstopInThread(Row):
    """After an emergency stop in a thread the next program runs as if nothing had been"""

    section = SECTION
    interrupted = True

    def operate(self, op):
        op.begin(*START, "G33 Z-60 K2")
        op.until("the thread", lambda: op.status.position[2] < -6)
        op.estop()
        op.sleep(0.2)
        op.on()
        op.go("G0 Z0 X0", "G1 F1200 X10", *START, "G0 X0", "G33 Z-16 K2")

    def check(self, seen):
        rows = seen.columns("x", "z")
        speeds = [abs(b[0] - a[0]) * 1000 for a, b in pairwise(rows) if 1 < a[0] < 9 and b[0] > a[0]]
        seen.near(max(speeds), 20, 0.1, "mm/s in X")
        off = groove(seen, -9, -14, 2)
        seen.require(off < 0.05, f"{off * 1000:.0f} micrometres off")


class RigidTap(Row):
    """G33.1 goes down, beyond the end while the spindle turns back, and up in step"""

    section = SECTION

    def operate(self, op):
        op.go(*START, "G0 Z2", "G33.1 Z-12 K1.25", "G1 X5")

    def check(self, seen):
        rows = [(z, turn) for z, turn in seen.columns("joint_z", "turns") if z < -6]
        seen.require(min(z for z, _ in rows) < -12, "does not go beyond the end")
        phases = [(2 - z) / 1.25 - turn for z, turn in rows]
        off = (max(phases) - min(phases)) * 1.25
        seen.require(off < 0.1, f"{off:.3f} mm out of step")
        seen.near(seen.column("z")[-1], 2, 1e-6, "Z")
        seen.near(seen.column("x")[-1], 5, 1e-6, "X")
        return f"in step within {off * 1000:.1f} micrometres", off


class TapAborted(Row):
    """A move after an aborted rigid tap runs with its own feed, in whatever phase the abort came"""

    section = SECTION

    def operate(self, op):
        speeds = []
        for phase in ("wait", "down", "turn", "up"):
            op.begin(*START, "G0 Z2", "G33.1 Z-12 K1.25", "G0 X50")
            op.until("Z 2", lambda: op.status.position[2] > 1.999)
            if phase != "wait":
                op.until("the way down", lambda depth=-4 if phase == "down" else -12: op.status.position[2] < depth)
            if phase == "up":
                op.until("the way up", lambda: op.status.position[2] > -9)
            op.abort()
            op.stopped()
            op.sleep(0.05)
            z = op.place()[2]
            op.say("G1 F1200 X10")
            speeds.append([phase, z, op.place()[2], op.place()[0]])
            op.say("M5")
            op.say("G1 X0")
            op.say("G0 Z0")
        op.keep("phases", speeds)

    def check(self, seen):
        for phase, before, after, x in seen.kept["phases"]:
            seen.near(after, before, 1e-6, f"Z after the abort in phase {phase}")
            seen.near(x, 10, 1e-6, f"X after the abort in phase {phase}")
        speed = seen.top_speed("x")
        seen.near(speed, 20, 0.1, "mm/s in X")


class TapWithoutReversal(Row):
    """A spindle that does not turn back at the end of a tap stops the machine with an error"""

    section = SECTION
    errors_expected = True

    def operate(self, op):
        op.begin(*START, "G0 Z2", "G33.1 Z-12 K1.25", "G1 X5")
        op.until("the tap", lambda: op.status.position[2] < -6)
        op.pin("ramp.min", 9)
        op.sleep(3)
        op.keep("z", op.place()[2])
        op.keep("idle", op.status.interp_state == 1)

    def check(self, seen):
        seen.require(seen.errors and seen.kept["idle"], f"runs on to Z {seen.kept['z']:.0f} without a word")
        return f"stopped at Z {seen.kept['z']:.1f}"


class PauseBeforeThread(Row):
    """A pause while a thread waits for its index holds it"""

    section = SECTION

    def operate(self, op):
        op.pin("near-0.difference", 1e9)
        op.begin("M3 S20", "G4 P0.2", "G33 Z-6 K2")
        op.sleep(0.6)
        op.pause()
        op.pin("ramp.min", 8)
        op.sleep(0.8)
        op.keep("held", op.place()[2])
        op.resume()
        op.finish(40)

    def check(self, seen):
        seen.require(seen.kept["held"] == 0, f"cuts to Z {seen.kept['held']:.1f} in the pause")
        seen.near(seen.column("z")[-1], -6, 1e-6, "Z")
