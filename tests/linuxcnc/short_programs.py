#!/usr/bin/python3
"""Random short programs through `framepath plan`, in bulk: short_programs.py --help

Each is planned with every limit of jerk. Whatever is not a plan within the limits is printed with its program and the
seed that makes it again; at the end how many there were of each kind, for every limit of jerk. Exit code 1 if there
was any.
"""

import argparse
import collections
import concurrent.futures
import contextlib
import csv
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile

import harness

#: The limits of jerk that plans are made with, as --jerk takes them.
JERKS = ("unlimited", "1e6", "1e5", "2e4")
#: What velocity, acceleration and jerk may exceed their limits by, and the speed F.
SHARES = {"velocity": 1.001, "acceleration": 1.001, "jerk": 1.05, "feed": 1.001}
HEAD = "G21 G17 G40 G49 G54 G80 G90 G94"
#: mm (degrees): from a nanometre, the last digit that is written, up.
SHORTEST, LONGEST = 1e-6, 60.0
#: mm/min
SLOWEST, FASTEST = 0.01, 1e5
#: Seconds that a single move may take at its feed, so that a plan stays short.
PATIENCE = 1.5
MM_PER_INCH = 25.4
AT_A_TIME = 2
#: Seconds after which a plan counts as one without an end; most take a tenth of one.
LONGEST_PLAN = 120
#: Lines ahead and behind that a line may be blended or merged with.
NEIGHBOURS = 4
#: The last digit of a speed in the table of plan, mm/s.
SPEED_DIGIT = 1e-6
#: What plan says where nothing moves by as much as counts.
NOTHING = "nothing moves in this program"


def log_uniform(source, least, most):
    return math.exp(source.uniform(math.log(least), math.log(most)))


class ShortProgram:
    """A program from a random.Random: its text, and its moves as (line, mm/min), None where no F rules."""

    def __init__(self, source, axes="XYZB"):
        self.source, self.axes = source, axes
        self.place = dict.fromkeys(axes, 0.0)
        self.incremental = self.inch = False
        self.lines: list[str] = []
        self.moves: list[tuple] = []
        self.add(HEAD)
        self.add(self.mode())
        self.set_feed()
        parts = {self.line: 10, self.rapid: 3, self.arc: 4, self.rotary: 1.5, self.set_feed: 5, self.zigzag: 1, self.dense: 0.7,
                 lambda: self.add(self.mode()): 1.5, lambda: self.add(f"G4 P{source.choice((0, 0.01, 0.1))}"): 0.7,
                 lambda: self.add(source.choice(("M62 P0", "M63 P0", "M67 E0 Q1.5"))): 0.7,
                 self.distances: 0.6, self.units: 0.4}
        # the very first move is what a planner has nothing before: more often than others it is tiny
        self.line(SHORTEST, log_uniform(source, 10 * SHORTEST, 10) if source.random() < 0.5 else LONGEST)
        for _ in range(source.randrange(1, 12)):
            source.choices(list(parts), list(parts.values()))[0]()
        self.add("M2")
        self.text = "\n".join(self.lines) + "\n"

    def add(self, line):
        self.lines.append(line)

    def move(self, line, feed):
        self.lines.append(line)
        self.moves.append((len(self.lines), feed))

    def mode(self):
        tolerance = log_uniform(self.source, 1e-4, 2)
        unit = MM_PER_INCH if self.inch else 1.0
        return self.source.choice(("G61", "G61.1", "G64", f"G64 P{tolerance / unit:.7f}", f"G64 P{tolerance / unit:.7f}",
                                   f"G64 P{tolerance / unit:.7f} Q{tolerance / 2 / unit:.7f}",
                                   f"G64 P{tolerance / unit:.7f} Q0"))

    def set_feed(self):
        self.feed = log_uniform(self.source, SLOWEST, FASTEST)
        unit = MM_PER_INCH if self.inch else 1.0
        self.add(f"F{self.feed / unit:.5f}")

    def distances(self):
        self.incremental = not self.incremental
        self.add("G91" if self.incremental else "G90")

    def units(self):
        self.inch = not self.inch
        # F is what it says, in the unit of then
        self.add("G20" if self.inch else "G21")
        self.set_feed()

    def length(self, least=SHORTEST, most=LONGEST, feed=True):
        """Of a move, mm: at its feed it takes no longer than anybody waits."""
        most = min(most, self.feed / 60 * PATIENCE) if feed else most
        return log_uniform(self.source, min(least, most), max(least, most))

    def word(self, axis, place):
        """The word that leads an axis to a place, and is there afterwards."""
        unit = MM_PER_INCH if self.inch and axis in "XYZ" else 1.0
        value = (place - self.place[axis] if self.incremental else place) / unit
        text = f"{value:.8f}" if self.inch else f"{value:.6f}"
        self.place[axis] = float(text) * unit + (self.place[axis] if self.incremental else 0.0)
        return f"{axis}{text}"

    def to(self, code, axes, length):
        direction = [self.source.gauss(0, 1) for _ in axes]
        size = math.hypot(*direction) or 1.0
        words = [self.word(axis, self.place[axis] + length * d / size) for axis, d in zip(axes, direction, strict=True)]
        # F is that of X Y Z where one of them moves, however little: rotary axes take their time
        self.move(f"{code} {' '.join(words)}", None if code == "G0" or set(axes) & set("ABC") else self.feed)

    def line(self, least=SHORTEST, most=LONGEST):
        self.to("G1", self.source.sample("XYZ", self.source.randrange(1, 4)), self.length(least, most))

    def rapid(self):
        self.to("G0", self.source.sample("XYZ", self.source.randrange(1, 4)), self.length(feed=False))

    def rotary(self):
        rotary = [axis for axis in self.axes if axis in "ABC"]
        axes = rotary + self.source.sample("XYZ", self.source.randrange(0, 3))
        self.to(self.source.choice(("G0", "G1")), axes, self.length())

    def zigzag(self):
        step = self.length()
        for n in range(self.source.randrange(3, 10)):
            axis = "XY"[n % 2]
            self.move(f"G1 {self.word(axis, self.place[axis] + step)}", self.feed)

    def dense(self):
        step, heading = self.length(1e-4, 0.3), self.source.uniform(0, math.tau)
        for _ in range(self.source.randrange(10, 60)):
            heading += self.source.uniform(-0.1, 0.12)
            x, y = self.place["X"] + step * math.cos(heading), self.place["Y"] + step * math.sin(heading)
            self.move(f"G1 {self.word('X', x)} {self.word('Y', y)}", self.feed)

    def arc(self):
        """From some micrometres up: with shorter ones the interpreter finds that radii do not agree."""
        radius, sweep = self.length(0.01, 20), self.source.choice((-1, 1)) * self.source.uniform(0.05, 6.2)
        if radius * abs(sweep) > self.feed / 60 * PATIENCE or radius < 0.005:
            return
        start = self.source.uniform(0, math.tau)
        x, y = self.place["X"], self.place["Y"]
        centre = x - radius * math.cos(start), y - radius * math.sin(start)
        unit = MM_PER_INCH if self.inch else 1.0
        offsets = f"I{(centre[0] - x) / unit:.8f} J{(centre[1] - y) / unit:.8f}"
        words = [self.word("X", centre[0] + radius * math.cos(start + sweep)),
                 self.word("Y", centre[1] + radius * math.sin(start + sweep))]
        if self.source.random() < 0.3:
            words.append(self.word("Z", self.place["Z"] + self.length()))
        self.move(f"{'G3' if sweep > 0 else 'G2'} {' '.join(words)} {offsets}", self.feed)


def program(seed, axes="XYZB"):
    """The program of a seed."""
    return ShortProgram(random.Random(seed), axes)


def too_fast(table, moves):
    """How many times its F the machine runs at most. A line is blended or merged with its neighbours: theirs count. A speed is
    the mean of a cycle: of one that ends in another line than it began in, either line's F counts."""
    number = {line: n for n, (line, _) in enumerate(moves)}
    allowed = []
    for n in range(len(moves)):
        near = [feed for _, feed in moves[max(0, n - NEIGHBOURS):n + NEIGHBOURS + 1]]
        allowed.append(math.inf if None in near else max(near))
    worst = before = 0.0
    for row in csv.DictReader(table):
        if int(row["line"]) in number:
            here = allowed[number[int(row["line"])]]
            worst = max(worst, (float(row["speed"]) - SPEED_DIGIT) * 60 / max(before, here))
            before = here
    return worst


class Finding:
    """What is wrong with a plan: the kind, for counting, and the words."""

    def __init__(self, kind, words):
        self.kind, self.words = kind, words


def planned(part, jerk, options=()):
    """The Finding of a program that is planned with this limit of jerk, or None."""
    with tempfile.TemporaryDirectory() as folder:
        path, table = os.path.join(folder, "part.ngc"), os.path.join(folder, "part.csv")
        with open(path, "w", encoding="utf-8") as file:
            file.write(part.text)
        try:
            done = subprocess.run([harness.TOOL, "plan", path, "--jerk", jerk, "--json", "--csv", table, *options],
                                  capture_output=True, text=True, check=False, timeout=LONGEST_PLAN)
        except subprocess.TimeoutExpired:
            return Finding("no end", f"the plan has no end in {LONGEST_PLAN} s")
        if done.returncode:
            said = done.stderr.strip().replace(path, "part.ngc")
            if NOTHING in said:
                return None
            # the same fault in another line counts as the same
            return Finding(re.sub(r"^\S+:\d+: ", "", said).split(". This")[0], said)
        with open(table, encoding="utf-8") as file:
            shares = {"feed": too_fast(file, part.moves)}
    where = {"feed": ""}
    for axis in json.loads(done.stdout)["programs"][0]["axes"]:
        for peak in axis["peaks"]:
            quantity, share = peak["quantity"], peak["share"] or 0.0
            if share > shares.get(quantity, 0.0):
                shares[quantity], where[quantity] = share, f" of {axis['letter']} at {peak['time']:.3f} s, line {peak['line']}"
    for quantity, allowed in SHARES.items():
        if not shares.get(quantity, 0.0) <= allowed:
            return Finding(f"{quantity} exceeded", f"{quantity}{where[quantity]}: {shares[quantity]:.4f} of what it may be")
    return None


def bulk(seeds, jerks=JERKS, options=()):
    """{jerk: {kind: [seeds]}} of programs, planned side by side; findings are printed as they come."""
    found: dict = {jerk: collections.defaultdict(list) for jerk in jerks}

    def one(seed):
        part = program(seed)
        return seed, part, [(jerk, planned(part, jerk, options)) for jerk in jerks]

    with concurrent.futures.ThreadPoolExecutor(AT_A_TIME) as pool:
        for seed, part, findings in pool.map(one, seeds):
            for jerk, finding in findings:
                if finding:
                    found[jerk][finding.kind].append(seed)
                    print(f"seed {seed}, jerk {jerk}: {finding.words}", flush=True)
            if any(finding for _, finding in findings):
                print("  " + "\n  ".join(part.lines), flush=True)
    return found


def summary(found, count):
    """A line for each limit of jerk and each kind."""
    for jerk, kinds in found.items():
        total = sum(map(len, kinds.values()))
        yield f"jerk {jerk}: {total} of {count} programs, {1000 * total / count:.1f} in 1000"
        for kind, seeds in sorted(kinds.items(), key=lambda item: -len(item[1])):
            yield f"  {len(seeds):4} {kind} (seeds {', '.join(map(str, seeds[:8]))}{', ..' if len(seeds) > 8 else ''})"


def main():
    parser = argparse.ArgumentParser(description="Random short programs through framepath plan.")
    parser.add_argument("--count", type=int, default=1000, help="how many programs (default: 1000)")
    parser.add_argument("--seed", type=int, default=1, help="of the first program (default: 1)")
    parser.add_argument("--jerk", default=",".join(JERKS), help=f"limits of jerk (default: {','.join(JERKS)})")
    parser.add_argument("--quiet", action="store_true", help="only the counts, no programs")
    parser.add_argument("options", nargs="*", help="more options for framepath plan, behind --")
    arguments = parser.parse_args()
    seeds = range(arguments.seed, arguments.seed + arguments.count)
    with contextlib.redirect_stdout(None if arguments.quiet else sys.stdout):
        found = bulk(seeds, arguments.jerk.split(","), arguments.options)
    print("\n".join(summary(found, arguments.count)))
    return 1 if any(map(len, found.values())) else 0


if __name__ == "__main__":
    sys.exit(main())
