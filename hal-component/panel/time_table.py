"""When the machine is where in a program, as `framepath plan --times` has written it."""

import zlib
from bisect import bisect_left

#: what the first line begins with
HEAD = "framepath times,1,"

#: machine units or degrees: a way as long as this is none
ROUNDING = 1e-4


class TimesError(Exception):
    """A file of times that cannot be used, with what is to be done."""


def belongs_to(head, program):
    """Whether the first line of a file of times was written for a program as it is now."""
    with open(program, "rb") as file:
        content = file.read()
    return head == f"{HEAD}{len(content)},{zlib.adler32(content):08x}"


class TimeTable:
    """Rows: time, line, number of the move, what is left of it (None where the machine stands before it)."""

    def __init__(self, rows, total):
        self.times = [row[0] for row in rows]
        self.lines = [row[1] for row in rows]
        self.moves = [row[2] for row in rows]
        self.to_go = [row[3] for row in rows]
        #: s
        self.total = total
        #: {line: numbers of its moves}
        self.moves_of: dict[int, list[int]] = {}
        for row in rows:
            numbers = self.moves_of.setdefault(row[1], [])
            if row[3] is not None and row[2] not in numbers[-1:]:
                numbers.append(row[2])

    @classmethod
    def read(cls, path, program):
        """The table beside a program. FileNotFoundError, or TimesError where it is not that of the program."""
        with open(path, encoding="utf-8") as file:
            lines = file.read().splitlines()
        mend = f"write it anew: framepath plan {program} --ini MACHINE.ini --times {path}"
        if not lines or not belongs_to(lines[0], program):
            raise TimesError(f"{path} was written for another program, or for an older state of this one: {mend}")
        try:
            *rows, last = (line.split(",") for line in lines[2:])
            if last[1:] != ["", "", ""]:
                raise ValueError("its end is missing")
            return cls([(float(time), int(line), int(move), float(to_go) if to_go else None)
                        for time, line, move, to_go in rows], float(last[0]))
        except ValueError as error:
            raise TimesError(f"{path} is damaged ({error}): {mend}") from error

    def has(self, move, line):
        """Whether a move may be of a line. One that takes less than a servo period has no row."""
        rows = range(bisect_left(self.moves, move), bisect_left(self.moves, move + 1))
        lines = [self.lines[row] for row in rows if self.to_go[row] is not None]
        return line in lines if lines else move < self.moves[-1]

    def nearest(self, line, move):
        """The number of the move of a line that is nearest to the one expected; None if there is none of this line."""
        return min(self.moves_of.get(line) or [], key=lambda number: abs(number - move), default=None)

    def find(self, move, to_go, stands):
        """From when until when the machine is there, s; two times where it rests, else the same."""
        first = bisect_left(self.moves, move)
        behind = bisect_left(self.moves, move + 1)
        until = self.times[behind] if behind < len(self.times) else self.total
        moving = [row for row in range(first, behind) if self.to_go[row] is not None]
        if first < behind and self.to_go[first] is None:
            begins = not moving or to_go < ROUNDING or to_go > self.to_go[moving[0]] - ROUNDING
            if stands and begins:
                return self.times[first], self.times[moving[0]] if moving else until
        if not moving:
            return until, until
        before = (self.to_go[moving[0]], self.times[moving[0]])
        for place in [(self.to_go[row], self.times[row]) for row in moving[1:]] + [(0.0, until)]:
            if place[0] <= to_go:
                return (between(to_go, before, place),) * 2
            before = place
        return until, until


def between(to_go, before, after):
    """The time between two places, each what is left of the move and a time."""
    way = before[0] - after[0]
    share = min(max((before[0] - to_go) / way, 0.0), 1.0) if way > 0 else 0.0
    return before[1] + share * (after[1] - before[1])
