"""Which move runs: numbers, kinds, steps, enables, the way moves meet."""

from row import Row, from_route

SECTION = "Identity"


def zigzag(legs, width=6.0, height=8.0):
    return [(width * n, height * (n % 2)) for n in range(1, legs + 1)]


def moves(points):
    return [f"G1 X{x:.4f} Y{y:.4f}" for x, y in points]


class NumbersInBlends(Row):
    """A blend has the number of the move before it; numbers do not go back"""

    section = SECTION

    def operate(self, op):
        op.go_loaded(8, "G64 P1", *moves(zigzag(8)))

    def check(self, seen):
        points = zigzag(8)
        last = 0
        for line in seen.column("line"):
            if line <= 0:
                seen.require(line == 0, f"number {line}")
                continue
            seen.require(line >= last, f"line {line} after {last}")
            last = line
        seen.require(last == 10, f"the last line is {last}")
        # each number but the first appears near the corner where its move begins
        off = [abs(next(x for x, line in seen.columns("x", "line") if line == n + 4) - points[n][0]) for n in range(6)]
        seen.require(max(off) < 1.5, f"a number changes {max(off):.2f} mm from its corner")
        return f"changes within {max(off):.2f} mm of the corner", max(off)


class KindOfMotion(Row):
    """The kind of motion on a blend is that of the move before it"""

    section = SECTION

    def operate(self, op):
        op.go("G64 P1", "G1 X10", "G1 Y10", "G2 X20 Y20 R10", "G1 X30")

    def check(self, seen):
        kinds = {(line, kind) for line, kind in seen.columns("line", "type") if line >= 3}
        seen.require(kinds == {(3, 2), (4, 2), (5, 3), (6, 2)}, f"(line, kind): {sorted(kinds)}")


class MergedMoves(Row):
    """Merged moves report the last number that they cover, in order"""

    section = SECTION

    def operate(self, op):
        op.go("G64 P0.1 Q0", *[f"G1 X{0.05 * n:.2f} F1200" for n in range(1, 301)])

    def check(self, seen):
        lines = [line for line in seen.column("line") if line > 0]
        seen.require(lines == sorted(lines), "numbers go back")
        seen.require(lines[-1] == 302, f"ends on line {lines[-1]}")
        behind = [line for line, x in seen.columns("line", "x") if 5 < x < 10 and line > 0]
        xs = [x for line, x in seen.columns("line", "x") if 5 < x < 10 and line > 0]
        # X of a line's end is (line - 2) * .05
        off = max(max(x - (line - 2) * 0.05, 0) for line, x in zip(behind, xs, strict=True))
        seen.require(off < 0.06, f"{off:.2f} mm beyond the move that is reported")
        return f"{len(set(lines))} of 300 numbers seen"


class Steps(Row):
    """A step runs to where the number changes"""

    section = SECTION
    errors_expected = True

    def operate(self, op):
        op.open(op.write(["G64 P0.5", *moves(zigzag(4))]))
        for _ in range(7):
            op.step()
            op.stopped(0.25)
        op.resume()
        op.finish(40)

    def check(self, seen):
        points = seen.columns("x", "y")
        places = [point for n, point in enumerate(points[:-60]) if points[n + 60] == point]
        corners = [(0.0, 0.0), *zigzag(4)]
        reached = sorted({min(range(5), key=lambda n: abs(place[0] - corners[n][0])) for place in places})
        off = max(min(max(abs(a - b) for a, b in zip(place, corner, strict=True)) for corner in corners) for place in places)
        seen.require(len(reached) >= 4, f"stood at corners {reached}")
        seen.require(off < 0.51, f"{off:.2f} mm from the corner")
        return f"rests {off:.3f} mm from corners"


class ZeroLength(Row):
    """A move without length is accepted, and does not use up the wait for the spindle"""

    section = SECTION

    def operate(self, op):
        op.pin("at-speed-0.in1", 0)
        op.begin("M3 S100", "G1 X0 Y0", "G1 X3")
        op.sleep(0.4)
        op.keep("held", op.place()[0])
        op.pin("at-speed-0.in1", 1)
        op.finish(40)

    def check(self, seen):
        seen.require(seen.kept["held"] == 0, "moved before the spindle was at speed")
        seen.near(seen.column("x")[-1], 3, 1e-6, "end")


class EnablesPerMove(Row):
    """M48 and M49 belong to the moves behind them, also when those wait in the queue"""

    section = SECTION

    def operate(self, op):
        op.feed_override(0.5)
        op.go("G64", "G1 X5", "M49", "G1 X15", "M48", "G1 X20")

    def check(self, seen):
        speeds = [seen.during(line).top_speed("x") for line in (3, 5, 7)]
        # the last one begins at the speed of the move before it
        last = sorted(seen.during(7).speed("x"))
        speeds[-1] = last[len(last) // 2]
        for line, speed, wanted in zip((3, 5, 7), speeds, (25, 50, 25), strict=True):
            seen.require(speed < wanted * 1.03 and speed > wanted * 0.8, f"line {line} at {speed:.1f} mm/s for {wanted}")
        return "25, 50, 25 mm/s"


class TerminationSurvives(Row):
    """The path mode outlives machine off and on (tpClear)"""

    section = SECTION
    interrupted = True

    def operate(self, op):
        op.say("G61.1")
        op.machine_off()
        op.on()
        op.say("o<corner> call")

    def check(self, seen):
        away = min(abs(x - 10) + abs(y) for x, y in seen.columns("x", "y"))
        rests = seen.rests("x", "y")
        seen.require(away < 1e-3, f"passes the corner by {away:.3f} mm, G61.1 forgotten")
        return f"{rests} rests"


class NoBlendOfKinds(Row):
    """A rapid and a feed meet within P, without a rest"""

    section = SECTION

    def operate(self, op):
        op.go_loaded(4, "G64 P0.5", "G0 X20", "G1 X40", "G0 X40 Y20", "G1 X20 Y20")

    def check(self, seen):
        away = from_route(seen.columns("x", "y"), [(0, 0), (40, 0), (40, 20), (20, 20)])
        seen.require(away < 0.501, f"{away:.2f} mm from the program, P is 0.5")
        slowest = min(speed for (x, y), speed in zip(seen.columns("x", "y"), seen.speed("x", "y"), strict=False)
                      if 15 < x < 39 and y == 0)
        seen.require(slowest > 10, f"slows down to {slowest:.1f} mm/s between G0 and G1 on one line")
        return f"slowest {slowest:.0f} mm/s"
