"""Overrides, holds and limits of the speed."""

from itertools import pairwise

from row import Row, from_route, to_segment

SECTION = "Feed"
SQUARE = [(0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0), (0.0, 0.0)]
SQUARE_LINES = [f"G1 X{x} Y{y}" for x, y in SQUARE[1:]]


class OverrideZero(Row):
    """Override 0 holds without being a pause, and the program goes on when it is raised"""

    section = SECTION

    def operate(self, op):
        op.begin("G1 X60")
        op.until("motion", lambda: op.status.position[0] > 5)
        op.feed_override(0)
        op.stopped()
        op.poll()
        op.keep("held", [op.place()[0], bool(op.status.paused), bool(op.status.inpos)])
        op.feed_override(1)
        op.finish(40)

    def check(self, seen):
        x, paused, done = seen.kept["held"]
        seen.require(not paused and not done, f"paused {paused}, in position {done}")
        # wherever the override came: a busy computer takes its time
        seen.require(5 < x < 50, f"stood at {x:.1f}")
        seen.near(seen.column("x")[-1], 60, 1e-6, "end")


class LoadedSlowly(Row):
    """Rapids that come late while an override of 0 holds the machine are run without a rest"""

    section = SECTION

    def operate(self, op):
        # the interpreter is busy for some task cycles; it keeps a G1 back until it knows the next line
        count = ["#1 = 0", "o100 while [#1 LT 20000]", "#1 = [#1 + 1]", "o100 endwhile"]
        taken = op.go_loaded(4, "G64 P0.5", "G0 X20", *count, "G0 X40 Y1", "G0 X60 Y0", "G0 X80")
        op.keep("taken", taken)

    def check(self, seen):
        taken = seen.kept["taken"]
        seen.require(taken > 30, f"the moves came within {taken} periods: none was late")
        speeds = seen.speed("x", "y")
        slowest = min(speed for x, speed in zip(seen.column("x"), speeds, strict=False) if 15 < x < 70)
        seen.require(slowest > 30, f"slows down to {slowest:.1f} mm/s of 100, {taken} periods for four moves")
        return f"slowest {slowest:.0f} mm/s"


class OverrideAboveHundred(Row):
    """An override above 100 % is honoured, on moves, arcs and in blends"""

    section = SECTION

    def operate(self, op):
        op.feed_override(1.5)
        op.go("G64 P0.5", "G1 X40 F2400", "G3 X40 Y40 R20", "G1 X0")

    def check(self, seen):
        for line in (3, 4, 5):
            speeds = sorted(seen.during(line).speed("x", "y"))
            seen.near(speeds[len(speeds) // 2], 60, 0.3, f"mm/s in line {line}")


class OverrideInBlends(Row):
    """The override acts in the middle of a blended program at once"""

    section = SECTION

    def operate(self, op):
        op.begin("G64 P0.5 F1800", *SQUARE_LINES)
        op.wait_moving()
        for scale in (0.3, 1.6, 0.1, 1.2, 0.0, 0.7, 1.0):
            op.sleep(0.12)
            op.feed_override(scale)
        op.finish(40)

    def check(self, seen):
        away = from_route(seen.columns("x", "y"), SQUARE)
        seen.require(away < 0.501, f"{away:.2f} mm from the program, P is 0.5")
        seen.require(seen.top_speed("x", "y") < 49, f"{seen.top_speed('x', 'y'):.1f} mm/s")


class ShapeWithoutOverride(Row):
    """The shape of a blend does not depend on the override"""

    section = SECTION

    def operate(self, op):
        for number, scale in enumerate((0.4, 1.6), 1):
            op.feed_override(scale)
            op.go(f"M68 E0 Q{number}", "G64 P1", *SQUARE_LINES)

    def check(self, seen):
        rows = seen.columns("x", "y", "analog")
        slow, fast = ([row[:2] for row in rows if row[2] == number] for number in (1, 2))
        off = max(min(to_segment(point, a, b) for a, b in pairwise(slow)) for point in fast[::3])
        seen.require(off < 0.005, f"{off * 1000:.0f} micrometres apart")
        return f"{off * 1000:.1f} micrometres apart"


class Slider(Row):
    """The slider for the greatest velocity holds for linear moves and for rotary ones, in motion as well"""

    section = SECTION

    def operate(self, op):
        op.max_velocity(30)
        op.begin("G0 X10", "G0 B20", "G1 X90 F6000", "G0 B40")
        op.until("line 4", lambda: op.status.position[0] > 15)
        op.max_velocity(12)
        op.finish(40)

    def check(self, seen):
        seen.near(seen.during(2).top_speed("x"), 30, 0.1, "mm/s of a rapid")
        seen.near(seen.during(3).top_speed("b"), 30, 0.1, "degrees/s of a rotary move")
        late = [speed for x, speed in zip(seen.column("x"), seen.speed("x"), strict=False) if 82 < x < 88]
        seen.near(max(late), 12, 0.1, "mm/s after the slider was moved")


class MaskedOverrides(Row):
    """M50, M51 and M52: overrides and adaptive feed only where the program allows them"""

    section = SECTION

    def operate(self, op):
        op.feed_override(0.5)
        op.pin("motion.adaptive-feed", 0.5)
        op.go("G64", "M50 P0", "G1 X10 F2400", "M50 P1", "G1 X20", "M52 P1", "G1 X26", "M52 P0")

    def check(self, seen):
        for line, wanted in ((4, 40), (6, 20), (8, 10)):
            speeds = sorted(seen.during(line).speed("x"))
            # gathering speed and braking take half of a line
            seen.near(speeds[3 * len(speeds) // 4], wanted, wanted * 0.01, f"mm/s in line {line}")


class FeedHold(Row):
    """M53: feed hold stops where it is allowed, and feed inhibit everywhere; both go on"""

    section = SECTION

    def operate(self, op):
        held = []
        op.begin("M53 P1", "G1 X60 F1200", "M53 P0", "G1 X80")
        for pin, place in (("motion.feed-hold", 5), ("motion.feed-inhibit", 30)):
            op.until("motion", lambda place=place: op.status.position[0] > place)
            op.pin(pin, 1)
            op.stopped()
            held.append(op.place()[0])
            op.pin(pin, 0)
        op.until("the second move", lambda: op.status.position[0] > 65)
        op.pin("motion.feed-hold", 1)
        op.sleep(0.4)
        held.append(op.place()[0])
        op.finish(40)
        op.keep("held", held)

    def check(self, seen):
        first, second, third = seen.kept["held"]
        seen.require(5 < first < 28 and 30 < second < 58, f"held at {seen.kept['held']}")
        seen.require(third > 70, f"held in spite of M53 P0, at {third:.1f}")


class NegativeAdaptiveFeed(Row):
    """A negative adaptive feed slows down, stops and runs back along the program, and forward again"""

    section = SECTION

    def operate(self, op):
        op.begin("M52 P1", "G64 P0.2", "G1 X10 F1800", "G1 Y10", "G1 X20", "G1 Y20", "G1 X40")
        op.until("the second half", lambda: op.status.position[0] > 16)
        op.pin("motion.adaptive-feed", -1)
        op.sleep(1.2)
        op.keep("back", [*op.place()[:2], op.get("motion.tp-reverse")])
        op.pin("motion.adaptive-feed", 1)
        op.finish(40)
        # A machine that has nothing to do has no way back, which is no error.
        op.say("M52 P1")
        op.pin("motion.adaptive-feed", -1)
        op.sleep(0.2)
        op.abort()
        op.sleep(0.2)
        op.pin("motion.adaptive-feed", 1)
        op.sleep(0.1)

    def check(self, seen):
        route = [(0, 0), (10, 0), (10, 10), (20, 10), (20, 20), (40, 20)]
        x, y, reverse = seen.kept["back"]
        seen.require(reverse and x + y < 20, f"at X {x:.1f} Y {y:.1f}, reverse {reverse}")
        away = from_route(seen.columns("x", "y"), route)
        seen.require(away < 0.201, f"{away:.2f} mm from the program, P is 0.2")
        seen.near(seen.column("x")[-1], 40, 1e-6, "end")
        return f"runs back to X {x:.1f} Y {y:.1f}"


class ReverseRun(Row):
    """A paused program runs back over its moves (AUTO_REVERSE), with look-ahead, and forward again"""

    section = SECTION

    def operate(self, op):
        op.begin("G64 P0.3", *[f"G1 X{0.5 * n} Y{0.2 * (n % 2)}" for n in range(1, 81)])
        op.until("the second half", lambda: op.status.position[0] > 25)
        op.pause()
        op.stopped()
        op.keep("paused", op.place()[0])
        op.reverse()
        op.sleep(0.05)
        op.resume()
        op.sleep(1.0)
        op.pause()
        op.stopped()
        op.keep("back", [op.place()[0], op.get("motion.tp-reverse")])
        op.forward()
        op.sleep(0.05)
        op.resume()
        op.finish(40)

    def check(self, seen):
        back, reverse = seen.kept["back"]
        paused = seen.kept["paused"]
        seen.require(reverse and back < paused - 5, f"at X {back:.1f} from {paused:.1f}, reverse {reverse}")
        seen.near(seen.column("x")[-1], 40, 1e-6, "end")
        return f"{seen.kept['paused'] - back:.1f} mm back in a second"


class AbortInReverse(Row):
    """An abort of a reverse run comes to rest on the path; what follows goes on from there, forward"""

    section = SECTION

    def operate(self, op):
        ends = []
        for phase in ("motion", "pause", "beginning"):
            op.begin("G64 P0.3", *SQUARE_LINES)
            op.until("the third side", lambda: op.status.position[1] > 15)
            op.pause()
            op.stopped()
            op.reverse()
            op.sleep(0.05)
            op.resume()
            if phase == "beginning":
                op.until("the beginning", lambda: op.status.position[0] + op.status.position[1] < 1e-6)
            else:
                op.until("the first side", lambda: op.status.position[0] < 18 and op.status.position[1] < 1)
            if phase == "pause":
                op.pause()
                op.stopped()
            reverse = bool(op.get("motion.tp-reverse"))
            op.abort()
            op.stopped()
            x, y = op.place()[:2]
            op.sleep(0.1)
            still = op.place()[:2] == [x, y]
            turned = not op.get("motion.tp-reverse")
            op.say("G91 G1 F3000 Z1")
            op.say("G90 Z0")
            ends.append([phase, reverse, still, turned, x, y, *op.place()[:2]])
            op.go("G64 P0.3", "G1 X0 Y0", *SQUARE_LINES)
        op.keep("ends", ends)

    def check(self, seen):
        away = 0.0
        for phase, reverse, still, turned, x, y, later_x, later_y in seen.kept["ends"]:
            seen.require(reverse, f"{phase}: did not run backwards")
            seen.require(still and turned, f"{phase}: still backwards, or in motion, after the abort")
            seen.require(abs(x - later_x) + abs(y - later_y) < 1e-6, f"{phase}: the next move starts elsewhere")
            away = max(away, from_route([(x, y)], SQUARE))
        seen.require(away < 0.301, f"{away:.2f} mm from the path, P is 0.3")
        seen.near(seen.column("x")[-1], 0, 1e-6, "end")
        seen.near(seen.column("y")[-1], 0, 1e-6, "end")
        return f"within {away:.2f} mm of the program, P is 0.3"
