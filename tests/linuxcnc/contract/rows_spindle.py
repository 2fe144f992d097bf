"""Waiting for the spindle, and feeds that follow its speed."""

from itertools import pairwise

from row import PERIOD, Row, Seen

SECTION = "Spindle"


class AtSpeed(Row):
    """Feed moves wait until all spindles are at speed; rapids do not"""

    section = SECTION

    def operate(self, op):
        op.pin("at-speed-1.in1", 0)
        op.begin("M3 S300 $0", "M3 S300 $1", "G0 X5", "G1 X10", "G1 X12")
        op.sleep(0.6)
        op.keep("held", op.place()[0])
        op.pin("at-speed-1.in1", 1)
        op.finish(40)

    def check(self, seen):
        seen.near(seen.kept["held"], 5, 1e-6, "X while the second spindle is not at speed")
        seen.near(seen.column("x")[-1], 12, 1e-6, "end")


class AbortWhileWaitingForSpeed(Row):
    """An abort during the wait for the spindle ends it, and nothing of it is left"""

    section = SECTION

    def operate(self, op):
        op.pin("at-speed-0.in1", 0)
        op.begin("M3 S300", "G1 X10")
        op.sleep(0.3)
        op.abort()
        op.sleep(0.1)
        op.keep("aborted", op.place()[0])
        op.pin("at-speed-0.in1", 1)
        op.say("G1 F3000 X3")
        op.say("G0 X4")

    def check(self, seen):
        seen.require(seen.kept["aborted"] == 0, "moved without the spindle")
        seen.near(seen.column("x")[-1], 4, 1e-6, "end")


class PauseWhileWaitingForSpeed(Row):
    """A pause during the wait for the spindle holds the move also when the spindle is there"""

    section = SECTION

    def operate(self, op):
        op.pin("at-speed-0.in1", 0)
        op.begin("M3 S300", "G1 X10")
        op.sleep(0.3)
        op.pause()
        op.sleep(0.1)
        op.pin("at-speed-0.in1", 1)
        op.sleep(0.3)
        op.keep("held", op.place()[0])
        op.resume()
        op.finish(40)

    def check(self, seen):
        seen.require(seen.kept["held"] == 0, f"moved to {seen.kept['held']:.3f} in the pause")
        seen.near(seen.column("x")[-1], 10, 1e-6, "end")


def fed_per_turn(seen, low, high, turns="turns"):
    """Way in X for a turn of the spindle between two places."""
    rows = seen.columns("x", turns)
    rows = [row for before, row in pairwise(rows) if before[1] != row[1]]
    rows = [(x, turn) for x, turn in rows if low < x < high]
    seen.require(len(rows) > 20, f"not seen between {low} and {high}")
    return abs(rows[-1][0] - rows[0][0]) / abs(rows[-1][1] - rows[0][1])


class FeedPerTurn(Row):
    """G95: the feed follows the spindle and the override, and time again after G94"""

    section = SECTION

    def operate(self, op):
        op.begin("M3 S1200", "G4 P0.7", "G95 F0.5", "G1 X12", "G94 F1800", "G1 X18")
        op.until("half of the way", lambda: op.status.position[0] > 5)
        op.feed_override(0.5)
        op.finish(40)

    def check(self, seen):
        first, second = fed_per_turn(seen, 1.5, 4.5), fed_per_turn(seen, 7, 11)
        seen.near(first, 0.5, 0.005, "mm a turn")
        seen.near(second, 0.25, 0.0025, "mm a turn at 50 %")
        last = [speed for x, speed in zip(seen.column("x"), seen.speed("x"), strict=False) if 13.5 < x < 17]
        seen.near(sum(last) / len(last), 15, 0.2, "mm/s under G94 at 50 %")
        return f"{first:.4f} mm a turn for 0.5"


class FeedPerTurnBegins(Row):
    """G95: the feed of a turn is not exceeded where it begins, from rest, behind a rapid and at an override"""

    section = SECTION

    def operate(self, op):
        op.begin("M3 S600", "G4 P0.7", "G64 P0.1", "G95 F1", "G1 X10", "G0 X30", "G1 X40")
        op.until("the rapid", lambda: op.status.position[0] > 11)
        op.feed_override(0.5)
        op.finish(40)

    def check(self, seen):
        speeds = list(zip(seen.column("x"), seen.speed("x"), strict=False))
        first, second = (max(speed for x, speed in speeds if a < x < b) for a, b in ((0, 9.8), (30.2, 40)))
        seen.near(first, 10, 0.1, "mm/s from rest")
        seen.near(second, 5, 0.05, "mm/s behind a rapid, at 50 %")
        return f"fastest {first:.2f} of 10 and {second:.2f} of 5 mm/s"


class FeedPerTurnAborted(Row):
    """After an abort under G95 a move under G94 keeps its own feed"""

    section = SECTION

    def operate(self, op):
        op.begin("M3 S1200", "G4 P0.7", "G95 F0.5", "G1 X60")
        op.until("motion", lambda: op.status.position[0] > 6)
        op.abort()
        op.stopped()
        op.say("M5")
        op.say("G94 G1 F1200 X0")

    def check(self, seen):
        back = [speed for (before, now), speed in zip(pairwise(seen.column("x")), seen.speed("x"), strict=True) if now < before]
        seen.near(max(back, default=0), 20, 0.1, "mm/s")
        seen.near(seen.column("x")[-1], 0, 1e-6, "end")


class ConstantSurfaceSpeed(Row):
    """G96: the spindle comes up as the diameter shrinks, and G95 follows"""

    section = SECTION

    def operate(self, op):
        op.go("G18 G7", "G0 X60", "G96 D1500 S60 M3", "G4 P0.8", "G95 F0.5", "G1 X20", "G97 S100")

    def check(self, seen):
        fed = fed_per_turn(seen, 12, 27)
        seen.near(fed, 0.5, 0.02, "mm a turn")
        return f"{fed:.3f} mm a turn for 0.5"


class SpindleStandsInG95(Row):
    """A spindle that stands still stops a G95 move, which goes on when it turns again"""

    section = SECTION

    def operate(self, op):
        op.begin("M3 S1200", "G4 P0.7", "G95 F0.5", "G1 X10")
        op.until("motion", lambda: op.status.position[0] > 2)
        op.pin("ramp.max", 0)
        op.sleep(1)
        op.stopped()
        op.keep("held", op.place()[0])
        op.pin("ramp.max", 1e20)
        op.finish(40)

    def check(self, seen):
        seen.require(2 < seen.kept["held"] < 9.5, f"stood at {seen.kept['held']:.2f}")
        seen.near(seen.column("x")[-1], 10, 1e-6, "end")


class ReverseInFeedPerTurn(Row):
    """A reverse run goes back over G95 moves with their feed for a turn, and on over the G94 move before them"""

    section = SECTION

    def operate(self, op):
        op.begin("M3 S1200", "G4 P0.7", "G64 P0.1", "G94 F600", "G1 X5", "G95 F1", "G1 X25", "G1 X70")
        op.until("the second move under G95", lambda: op.status.position[0] > 35)
        op.pause()
        op.stopped()
        op.reverse()
        op.sleep(0.05)
        op.resume()
        op.until("the first move", lambda: op.status.position[0] < 3)
        op.pause()
        op.stopped()
        op.keep("back", op.place()[0])
        op.forward()
        op.sleep(0.05)
        op.resume()
        op.finish(40)

    def check(self, seen):
        seen.require(seen.kept["back"] < 3, f"back at X {seen.kept['back']:.1f}")
        rows = seen.columns("x", "turns", "reverse")
        away = [row[:2] for before, row in pairwise(rows) if row[2] and row[0] < before[0]]
        fed = fed_per_turn(Seen(["x", "turns"], away[-2000:], {}, []), 8, 20)
        seen.near(fed, 1, 0.01, "mm a turn backwards")
        seen.near(seen.column("x")[-1], 70, 1e-6, "end")
        return f"{fed:.4f} mm a turn for 1"


class SpindleOrient(Row):
    """M19 is waited for, and a move behind it runs"""

    section = SECTION

    def operate(self, op):
        op.begin("G64", "G1 X5", "M19 R30 Q10", "G1 X10")
        op.until("orient", lambda: op.get("spindle.0.orient"))
        op.keep("at", op.place()[0])
        op.sleep(0.1)
        op.pin("spindle.0.is-oriented", 1)
        op.finish(40)

    def check(self, seen):
        seen.near(seen.column("x")[-1], 10, 1e-6, "end")
        seen.near(seen.kept["at"], 5, 1e-6, "X at M19")
        return f"{len(seen.rows) * PERIOD:.1f} s"
