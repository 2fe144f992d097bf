"""Outputs that the program synchronises with its moves."""

from itertools import pairwise

from row import WITHOUT_A_FRAME, Row

SECTION = "Outputs"


def changes(seen, name, axis="x"):
    """(place, value) wherever an output changes."""
    pairs = seen.columns(axis, name)
    return [(pairs[n][0], pairs[n][1]) for n in range(1, len(pairs)) if pairs[n][1] != pairs[n - 1][1]]


class AtTheirMoves(Row):
    """M62, M63 and M67 fire once, at the start of the move they belong to"""

    section = SECTION

    def operate(self, op):
        op.go("G64 P0.05", "G1 X5", "M62 P0", "M67 E0 Q3", "G1 X10", "M63 P0", "M62 P1", "G1 X15", "M67 E0 Q7", "G1 Y5 F600",
              "M63 P1", "G1 X20 F3000")

    def check(self, seen):
        digital, second, analog = changes(seen, "output0"), changes(seen, "output1"), changes(seen, "analog")
        for got, wanted, what in ((digital, [(5, 1), (10, 0)], "P0"), (second, [(10, 1), (15, 0)], "P1"),
                                  (analog, [(5, 3), (15, 7)], "E0")):
            seen.require(len(got) == len(wanted), f"{what} changes {len(got)} times")
            for (place, value), (where, to) in zip(got, wanted, strict=True):
                seen.require(value == to and abs(place - where) < 0.2, f"{what} becomes {value} at {place:.2f}")
        return f"within {max(abs(p - w) for p, w in zip([p for p, _ in digital], (5, 10), strict=True)):.3f} mm"


class InDenseCode(Row):
    """The same in code that is merged or blended"""

    section = SECTION

    def operate(self, op):
        lines = []
        for n in range(1, 121):
            if n % 10 == 0:
                lines.append(f"M6{2 + n // 10 % 2} P0")
            lines.append(f"G1 X{0.1 * n:.2f} Y{0.02 * (n % 3):.3f} F1200")
        op.go("G64 P0.05 Q0", *lines)

    def check(self, seen):
        got = changes(seen, "output0")
        got = got if got and got[0][1] else got[1:]
        wanted = [0.1 * (n - 1) for n in range(10, 121, 10)]
        wanted = wanted[1:] if len(got) == 11 else wanted
        seen.require(len(got) in (11, 12), f"{len(got)} changes")
        off = max(abs(place - where) for (place, _), where in zip(got, wanted[-len(got):], strict=True))
        seen.require(off < 0.15, f"off by {off:.2f} mm")
        return f"within {off:.3f} mm"


class ClearedByAbort(Row):
    """An output that waits for its move is forgotten by an abort"""

    section = SECTION

    def operate(self, op):
        op.begin("G64", "G1 X20 F600", "M62 P0", "M67 E0 Q4", "G1 X30")
        op.wait_moving()
        op.sleep(0.3)
        op.abort()
        op.stopped()
        op.say("G1 F3000 X5")
        op.say("G1 X6")

    def check(self, seen):
        seen.require(not any(seen.column("output0")) and not any(seen.column("analog")), "it fires after the abort")


class Inputs(Row):
    """M66 reads an input at rest, and waits for it"""

    section = SECTION

    def operate(self, op):
        op.begin("G64", "G1 X5", "M66 P0 L3 Q5", "G1 X10")
        op.until("X 5", lambda: op.status.position[0] > 4.999)
        op.sleep(0.3)
        op.keep("waited", op.place()[0])
        op.pin("motion.digital-in-00", 1)
        op.finish(40)

    def check(self, seen):
        seen.near(seen.kept["waited"], 5, 1e-6, "while waiting")
        seen.near(seen.column("x")[-1], 10, 1e-6, "end")


class Indexer(Row):
    """A locking indexer: rest, unlock, wait, move, lock, wait; no blend into it or out of it"""

    section = "Indexer"
    behind = WITHOUT_A_FRAME

    def operate(self, op):
        op.go("G64 P1", "G1 X10", "G0 A30", "G1 X20", "G0 A10", "G0 A20", "G1 X10")

    def check(self, seen):
        rows = seen.columns("a", "x", "unlock", "unlocked")
        for before, now in pairwise(rows):
            if now[0] != before[0]:
                seen.require(now[3], "A moves while it is locked")
            if now[1] != before[1]:
                seen.require(not now[3], "X moves while A is unlocked")
        unlocks = sum(1 for before, now in pairwise(rows) if now[2] and not before[2])
        seen.require(unlocks in (2, 3), f"unlocked {unlocks} times")
        seen.near(rows[-1][0], 20, 1e-6, "A")
        return f"unlocked {unlocks} times for 3 moves"


class IndexerAborted(Row):
    """An abort while the indexer unlocks or moves leaves it locked, and the next move works"""

    section = "Indexer"
    behind = WITHOUT_A_FRAME

    def operate(self, op):
        places = []
        for wait in (0.02, 0.15):
            op.begin("G1 X1", "G0 A60", "G1 X20")
            op.until("the unlock", lambda: op.get("joint.3.unlock"))
            op.sleep(wait)
            op.abort()
            op.stopped()
            op.sleep(0.15)
            places.append([op.get("joint.3.is-unlocked"), op.place()[3]])
            op.say("G0 A0")
            op.say("G1 F3000 X0")
        op.keep("places", places)

    def check(self, seen):
        seen.require(not any(unlocked for unlocked, _ in seen.kept["places"]), "stays unlocked after an abort")
        seen.near(seen.column("a")[-1], 0, 1e-6, "A")
