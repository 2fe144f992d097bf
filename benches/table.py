#!/usr/bin/python3
"""The tables of docs/figures.md from what `cargo bench` has measured: table.py FOLDER, where FOLDER is target/criterion.

Every time is criterion's mean. A benchmark that is missing is an error: the table would be taken for complete.
"""

import glob
import json
import os
import sys

KINDS = ["lines", "arcs", "dense"]
AXES = ["3 axes", "5 axes", "9 axes"]
QUEUES = ["10", "100", "1000", "2000"]
FILTER = "filter, plain motions/"

#: what is measured, ours, LinuxCNC's
KINEMATICS = [
    ("inverse, three axes", "inverse, identity", "inverse, LinuxCNC's trivkins"),
    ("forward, three axes", "forward, identity", "forward, LinuxCNC's trivkins"),
    ("inverse, three axes, with a frame", "inverse with frame, identity", "inverse, LinuxCNC's trivkins"),
    ("forward, three axes, with a frame", "forward with frame, identity", "forward, LinuxCNC's trivkins"),
    ("inverse, tilting table", "inverse, table tilting", "inverse, LinuxCNC's xyzac-trt-kins"),
    ("forward, tilting table", "forward, table tilting", "forward, LinuxCNC's xyzac-trt-kins"),
    ("inverse, tilting table, with a frame", "inverse with frame, table tilting",
     "inverse, LinuxCNC's xyzac-trt-kins"),
    ("forward, tilting table, with a frame", "forward with frame, table tilting",
     "forward, LinuxCNC's xyzac-trt-kins"),
]

#: what a jet is measured for, nanoseconds at most
JET = 900
EXACT_JETS = ["identity", "xyzac", "xyzbc"]
NUMERICAL_JETS = ["xyzac-trt-kins", "xyzbc-trt-kins", "5axiskins"]


def load(folder):
    """{name of the benchmark: (mean time in ns, bytes of one run or None)}"""
    found = {}
    for path in glob.glob(os.path.join(folder, "**", "new", "benchmark.json"), recursive=True):
        with open(path, encoding="utf-8") as file:
            benchmark = json.load(file)
        with open(os.path.join(os.path.dirname(path), "estimates.json"), encoding="utf-8") as file:
            mean = json.load(file)["mean"]["point_estimate"]
        throughput = benchmark.get("throughput") or {}
        found[benchmark["full_id"]] = (mean, throughput.get("Bytes"))
    return found


def time(nanoseconds):
    """Three digits, with a unit."""
    for unit, size in (("ns", 1), ("us", 1e3), ("ms", 1e6)):
        if nanoseconds < 999.5 * size or unit == "ms":
            value = nanoseconds / size
            return f"{value:.{0 if value >= 99.95 else 1 if value >= 9.995 else 2}f} {unit}"
    raise AssertionError


def row(*cells):
    return "| " + " | ".join(cells) + " |"


def planner(found, name):
    yield row(name, *(f"{queue} queued" for queue in QUEUES), f"{QUEUES[-1]} to {QUEUES[0]}")
    yield row("---", *["---:"] * (len(QUEUES) + 1))
    for kind in KINDS:
        for axes in AXES:
            times = [found[f"{name}, {kind}/{axes}/{queue}"][0] for queue in QUEUES]
            yield row(f"{kind}, {axes}", *map(time, times), f"{times[-1] / times[0]:.2f}")


def kinematics(found):
    yield row("kinematics", "framekins", "LinuxCNC's", "ratio")
    yield row("---", "---:", "---:", "---:")
    for name, ours, stock in KINEMATICS:
        a, b = found[ours][0], found[stock][0]
        yield row(name, time(a), time(b), f"{a / b:.2f}")


def jets(found):
    yield row("three derivatives of the joints at a place", "mean", f"over {JET} ns", "over one inverse")
    yield row("---", "---:", "---:", "---:")
    for name in EXACT_JETS:
        mean = found[f"jet, exact, {name}"][0]
        yield row(f"framekins, {name}, with a frame", time(mean), f"{mean / JET:.2f}", "")
    for name in NUMERICAL_JETS:
        mean, inverse = found[f"jet, by numbers, {name}"][0], found[f"jet, one inverse, {name}"][0]
        yield row(f"LinuxCNC's {name}, by numbers", time(mean), f"{mean / JET:.2f}", f"{mean / inverse:.2f}")


def others(found, prefixes):
    yield row("besides", "mean")
    yield row("---", "---:")
    for name in sorted(found):
        if name.startswith(prefixes):
            yield row(name.replace("/", ": "), time(found[name][0]))


def dialects(found):
    yield row("filter, plain motions, 100 MB", "MB/s")
    yield row("---", "---:")
    measured = [name for name in sorted(found) if name.startswith(FILTER)]
    if not measured:
        raise KeyError(FILTER)
    for name in measured:
        mean, length = found[name]
        yield row(name.removeprefix(FILTER), f"{length / mean * 1e3:.0f}")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = load(sys.argv[1])
    try:
        tables = [list(table) for table in (
            planner(found, "servo period"), planner(found, "move added"), kinematics(found), jets(found),
            others(found, ("cycle/", "cycle, ", "look-ahead/", "zigzag", "lines of")), dialects(found))]
    except KeyError as missing:
        sys.exit(f"table.py: {missing} has not been measured: run cargo bench --workspace first")
    print("\n\n".join("\n".join(table) for table in tables))


if __name__ == "__main__":
    main()
