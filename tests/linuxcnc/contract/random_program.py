"""Random part programs of everything that a planner is asked for, on the machine of the outcome table."""

import math

#: Programs stay within this of the origin.
REACH = 90.0
#: Lengths of moves, mm or degrees.
SHORTEST, LONGEST = 0.005, 60.0


class RandomProgram:
    """Lines of a program from a random.Random, and where it ends: X Y Z A B."""

    def __init__(self, source, start):
        self.source = source
        self.place = list(start)
        self.lines = []
        self.threads = False
        self.mode()
        self.lines.append(f"F{self.feed():.1f}")
        if source.random() < 0.2:
            self.spindle()
        parts = (self.lines_of_it, self.zigzag, self.arc, self.dense, self.mode, self.event, self.rotary, self.indexer,
                 self.overrides)
        weights = (6, 3, 5, 2, 3, 3, 2, 0.5, 1)
        for _ in range(source.randrange(3, 12)):
            source.choices(parts, weights)[0]()
        if self.threads:
            for _ in range(source.randrange(1, 3)):
                source.choice((self.thread, self.tap, self.per_turn))()
            self.lines.append("M5")

    def feed(self):
        return math.exp(self.source.uniform(math.log(900), math.log(9000)))

    def length(self):
        return math.exp(self.source.uniform(math.log(SHORTEST), math.log(LONGEST)))

    def inside(self, axis, value):
        value = round(value, 4)
        return value if abs(value) < REACH else self.place[axis]

    def to(self, code, axes, step=None):
        """A line along some axes, each by a random part of a length."""
        length = step or self.length()
        words = []
        for axis in axes:
            self.place[axis] = self.inside(axis, self.place[axis] + length * self.source.uniform(-1, 1))
            words.append(f"{'XYZAB'[axis]}{self.place[axis]:.4f}")
        self.lines.append(f"{code} {' '.join(words)}")

    def lines_of_it(self):
        for _ in range(self.source.randrange(1, 6)):
            if self.source.random() < 0.3:
                self.lines.append(f"F{self.feed():.1f}")
            self.to(self.source.choices(("G0", "G1"), (1, 4))[0], self.source.sample((0, 1, 2), self.source.randrange(1, 4)))

    def zigzag(self):
        step = self.length() / 4
        for n in range(self.source.randrange(3, 15)):
            self.place[n % 2] = self.inside(n % 2, self.place[n % 2] + step)
            self.lines.append(f"G1 X{self.place[0]:.4f} Y{self.place[1]:.4f}")

    def arc(self):
        radius, angle = self.length() / 3 + 0.02, self.source.uniform(0, 2 * math.pi)
        sweep = self.source.choice((-1, 1)) * self.source.uniform(0.1, 6.0)
        centre = [self.place[n] - radius * direction for n, direction in enumerate((math.cos(angle), math.sin(angle)))]
        if max(abs(c) for c in centre) + radius > REACH:
            return
        offsets = [round(centre[n] - self.place[n], 6) for n in (0, 1)]
        end = [round(centre[0] + radius * math.cos(angle + sweep), 4), round(centre[1] + radius * math.sin(angle + sweep), 4)]
        if math.dist(end, self.place[:2]) < 0.01:
            return
        height = ""
        if self.source.random() < 0.3:
            self.place[2] = self.inside(2, self.place[2] + self.length() / 4)
            height = f" Z{self.place[2]:.4f}"
        self.place[:2] = end
        self.lines.append(f"{'G3' if sweep > 0 else 'G2'} X{end[0]:.4f} Y{end[1]:.4f}{height} "
                          f"I{offsets[0]:.6f} J{offsets[1]:.6f}")

    def dense(self):
        step, heading = self.source.uniform(0.01, 0.4), self.source.uniform(0, 2 * math.pi)
        for _ in range(self.source.randrange(20, 120)):
            heading += self.source.uniform(-0.1, 0.12)
            self.place[0] = self.inside(0, self.place[0] + step * math.cos(heading))
            self.place[1] = self.inside(1, self.place[1] + step * math.sin(heading))
            self.lines.append(f"G1 X{self.place[0]:.4f} Y{self.place[1]:.4f}")

    def rotary(self):
        for _ in range(self.source.randrange(1, 5)):
            self.to("G1", self.source.choice(((4,), (0, 4), (0, 1, 4))), self.source.uniform(0.1, 20))

    def indexer(self):
        self.place[3] = round(self.source.uniform(-40, 40), 3)
        self.lines.append(f"G0 A{self.place[3]:.3f}")

    def mode(self):
        tolerance = math.exp(self.source.uniform(math.log(0.002), math.log(2)))
        self.lines.append(self.source.choices(("G61", "G61.1", "G64", f"G64 P{tolerance:.4f}", f"G64 P{tolerance:.4f} Q0"),
                                              (1, 1, 2, 4, 4))[0])

    def event(self):
        self.lines.append(self.source.choice(("G4 P0.02", "M62 P0", "M63 P0", "M67 E0 Q1.5", "M66 P0 L0", "M64 P1", "G4 P0.1",
                                              "M8", "M9")))

    def overrides(self):
        self.lines.append(self.source.choice(("M48", "M49", "M50 P0", "M50 P1", "M52 P1", "M53 P1")))

    def spindle(self):
        self.threads = True
        self.lines += [f"{self.source.choice(('M3', 'M4'))} S{self.source.randrange(120, 1500)}", "G4 P0.6"]

    def thread(self):
        pitch = self.source.uniform(0.2, 2)
        for _ in range(self.source.randrange(1, 3)):
            self.place[2] = self.inside(2, self.place[2] - pitch * self.source.uniform(4, 10))
            self.lines.append(f"G33 Z{self.place[2]:.4f} K{pitch:.4f}")
        self.to("G0", (2,), 5)

    def tap(self):
        pitch = self.source.uniform(0.2, 1.5)
        self.lines.append(f"G33.1 Z{self.place[2] - pitch * self.source.uniform(3, 8):.4f} K{pitch:.4f}")

    def per_turn(self):
        self.lines.append(f"G95 F{self.source.uniform(0.1, 2):.3f}")
        self.lines_of_per_turn()
        self.lines.append(f"G94 F{self.feed():.1f}")

    def lines_of_per_turn(self):
        for _ in range(self.source.randrange(1, 4)):
            self.to("G1", (0, 1), self.source.uniform(0.5, 8))
