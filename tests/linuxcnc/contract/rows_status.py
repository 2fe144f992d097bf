"""What the status says in every servo period."""

import math
from itertools import pairwise

from row import MICROMETRE, PERIOD, WITHOUT_A_FRAME, Row, from_route

SECTION = "Status"


class Velocity(Row):
    """current_vel is the speed of the machine, requested_vel the feed"""

    section = SECTION

    def operate(self, op):
        op.go("G64 P0.3", "G1 X20 Y5 F3000", "G1 X25 Y25 F1800", "G3 X10 Y25 R8", "G1 X0 F600")

    def check(self, seen):
        off = 0.0
        for velocity, speed in zip(seen.column("velocity")[1:], seen.speed("x", "y"), strict=True):
            off = max(off, abs(velocity - speed))
        feeds = [seen.during(line).column("feed") for line in (3, 4, 6)]
        for feed, wanted in zip(feeds, (50, 30, 10), strict=True):
            seen.near(sorted(feed)[len(feed) // 2], wanted, 0.01, "requested_vel")
        seen.require(off < 2.5, f"current_vel is off by {off:.2f} mm/s")
        return f"within {off:.2f} mm/s"


class DistanceToGo(Row):
    """distance_to_go and dtg are those of the running move, 0 at its end"""

    section = SECTION

    def operate(self, op):
        op.begin("G64 P0.2", "G1 X24", "G1 Y12", "G0 X0")
        op.wait_moving()
        op.sleep(0.15)
        op.poll()
        op.keep("dtg", list(op.status.dtg[:3]))
        op.keep("x", op.status.position[0])
        op.finish(40)
        op.poll()
        op.keep("end", [op.status.distance_to_go, *op.status.dtg[:3]])

    def check(self, seen):
        # the line is reported a period later than what is left of it
        off = max(abs(to_go - (24 - x)) for to_go, x in seen.during(3).columns("to_go", "x")[:-2])
        seen.require(off < 0.5, f"off by {off:.2f} mm")
        seen.near(seen.kept["dtg"][0] + seen.kept["x"], 24, 1, "dtg")
        seen.require(all(abs(value) < 1e-9 for value in seen.kept["end"]), f"{seen.kept['end']} at the end")
        return f"within {off:.2f} mm"


class InPosition(Row):
    """In position only when nothing is left and everything stands"""

    section = SECTION

    def operate(self, op):
        op.go("G61.1", "G1 X5", "G4 P0.1", "G1 X10", "G1 X15")

    def check(self, seen):
        seen.require(seen.column("in_position")[-1] == 1, "not in position at the end")
        xs, flags = seen.column("x"), seen.column("in_position")
        wrong = sum(1 for n in range(1, len(xs)) if flags[n] and abs(xs[n] - xs[n - 1]) > PERIOD)
        seen.require(wrong == 0, f"in position in {wrong} periods of motion")
        away = [n for n in range(len(xs)) if abs(xs[n] - 7) < 1.5]
        seen.require(not any(flags[n] for n in away), "in position in the middle of a move")


class EnablesQueued(Row):
    """The status shows the overrides of the move that runs"""

    section = SECTION

    def operate(self, op):
        op.begin("M48", "G1 X12 F1800", "M49", "G1 X24", "M48", "G1 X26")
        seen = []

        def over():
            seen.append((op.status.motion_line, bool(op.status.feed_override_enabled)))
            return (op.status.motion_line >= 7 or len(seen) > 50) and op.status.inpos

        op.until("the end", over)
        op.keep("seen", [pair for n, pair in enumerate(seen) if n == 0 or seen[n - 1] != pair])

    def check(self, seen):
        pairs = [tuple(pair) for pair in seen.kept["seen"]]
        seen.require((3, True) in pairs, f"{pairs}")
        seen.require((5, False) in pairs, f"{pairs}")
        seen.require((3, False) not in pairs, "M49 shows while the move before it runs")


class QueueDepth(Row):
    """The queue's length is counted, and empty at the end"""

    section = SECTION

    def operate(self, op):
        op.pin("motion.feed-hold", 1)
        op.begin("M53 P1", *[f"G1 X{n}" for n in range(1, 21)])
        op.sleep(0.4)
        op.poll()
        op.keep("held", op.status.queue)
        op.pin("motion.feed-hold", 0)
        op.finish(40)
        op.keep("end", op.status.queue)

    def check(self, seen):
        seen.require(seen.kept["held"] in (19, 20), f"{seen.kept['held']} of 20 moves counted")
        seen.require(seen.kept["end"] == 0, f"{seen.kept['end']} at the end")


class DrainsToTheEnd(Row):
    """When the queue drains the machine rests on the end point exactly"""

    section = SECTION

    def operate(self, op):
        ends = []
        for x, y in ((11.2345, 3.3), (0.7, -5.4321), (-12.3, 0.0)):
            op.go("G64 P0.5", f"G1 X{x} Y{y}", f"G1 X{x + 5} Y{y - 3}", f"G1 X{x} Y{y}")
            place = op.place()
            ends.append(max(abs(place[0] - x), abs(place[1] - y)))
        op.keep("off", max(ends))

    def check(self, seen):
        seen.require(seen.kept["off"] < 1e-9, f"{seen.kept['off']:.2g} mm off")
        return f"{seen.kept['off']:.1g} mm off"


class QueueBusters(Row):
    """M66, M6, G4, M0 and a changed offset end the look-ahead at rest, exactly; what follows goes on from there"""

    section = SECTION
    behind = WITHOUT_A_FRAME

    def operate(self, op):
        op.begin("G64 P1", "G1 X5", "G1 Y5", "M66 P0 L0", "G1 X10", "G1 Y10", "G4 P0.05", "G1 X15", "G1 Y15", "T1 M6",
                 "G1 X20", "G1 Y20", "G10 L2 P1 X5", "G1 X25", "G1 Y25", "M0", "G1 Y0")
        op.until("M0", lambda: op.status.task_paused or op.status.paused or op.status.interp_state == 3)
        op.stopped()
        op.keep("m0", op.place()[:2])
        op.resume()
        op.finish(40)

    def check(self, seen):
        points = seen.columns("x", "y")
        for corner in ((5, 5), (10, 10), (15, 15), (20, 20)):
            away = min(max(abs(x - corner[0]), abs(y - corner[1])) for x, y in points)
            seen.require(away < 1e-6, f"{corner} is missed by {away:.3g} mm")
        seen.near(seen.kept["m0"][0], 30, 1e-6, "X at M0")
        seen.near(seen.kept["m0"][1], 25, 1e-6, "Y at M0")
        seen.near(points[-1][1], 0, 1e-6, "end")


class Starvation(Row):
    """A program that comes slower than it could run is run without a jerk, and to its end"""

    section = SECTION

    def operate(self, op):
        # each of these lines costs the interpreter more than the machine
        lines = [f"#1=[{'+'.join(['SIN[#2]*COS[#2]'] * 9)}]" if n % 2 else f"G1 X{0.01 * n:.3f} Y[#1/1000]"
                 for n in range(1, 401)]
        op.go("G64 P0.02 Q0", "#2=3", *lines)

    def check(self, seen):
        seen.near(seen.column("x")[-1], 4, MICROMETRE, "end")
        return f"{seen.rests('x', 'y')} rests on the way, {len(seen.moving('x', 'y')) * PERIOD:.2f} s"


class LateMoves(Row):
    """A move that arrives while the last one brakes extends the plan or waits for the rest; nothing jumps"""

    section = SECTION

    def operate(self, op):
        for n in range(1, 13):
            op.mdi_start(f"G1 F3000 X{2 * n}")
            op.sleep(0.02 + 0.011 * n)
        op.finish(40)

    def check(self, seen):
        seen.near(seen.column("x")[-1], 24, 1e-6, "end")
        xs = seen.column("x")
        seen.require(all(b >= a - 1e-9 for a, b in pairwise(xs)), "goes back")
        return f"{seen.rests('x')} rests"


class OffsetsInProgram(Row):
    """Offsets that change in the program are met exactly, with G64 on both sides"""

    section = SECTION
    behind = WITHOUT_A_FRAME

    def operate(self, op):
        op.go("G64 P0.3", "G1 X5 Y5", "G92 X0 Y0", "G1 X5 Y0", "G92.1", "G1 X0 Y10", "G43.1 Z3", "G1 Z1", "G49",
              "G10 L2 P1 R90", "G1 X0 Y0", "G10 L2 P1 R0")
        op.keep("end", op.place()[:3])

    def check(self, seen):
        points = seen.columns("x", "y", "z")
        away = from_route(points, [(0, 0, 0), (5, 5, 0), (10, 5, 0), (0, 10, 0), (0, 10, 4), (0, 0, 4)])
        seen.require(away < 0.301, f"{away:.2f} mm from the program, P is 0.3")
        off = math.dist(seen.kept["end"], (0, 0, 4))
        seen.require(off < 1e-6, f"ends {off:.3g} mm off")
        seen.require(any(max(abs(x - 10), abs(y - 5)) < 0.3 for x, y, _ in points), "G92 missed")
        seen.require(any(abs(z - 4) < MICROMETRE for _, _, z in points), "G43.1 missed")
