#!/usr/bin/python3
"""What each constant that tunes the planner does: measures the rows of docs/tuning.md and writes them there.

A row names a constant and its file. The constant is made less and more, in a copy of the sources, blendtp is built with
it and drives the same programs as the one without the change (`framepath compare`), by itself and with a restless
operator. In the row: the time over the time without the change, a geometric mean over the programs, with unlimited jerk
and with 20 accelerations a second, and what was amiss, if anything.

    tuning.py --tool FRAMEPATH --target FOLDER [--from N] [--to N] [--new] [--only NAME ...]
"""

import argparse
import collections
import json
import math
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE = os.path.join(ROOT, "docs", "tuning.md")
NCFILES = "/usr/share/linuxcnc/ncfiles"
FILES = [os.path.join(NCFILES, f"{name}.ngc") for name in ("tort", "arcspiral")]
GENERATED = ["arcs", "blade", "dense", "squares-p.5", "trochoidal", "zigzag-4-axis"]
OPERATORS: list[list[str]] = [[], ["--operator", "1", "--velocity-limit", "200"]]
#: what a limit may be exceeded by in a measured run, and more than that by a changed one
LIMITS = {"velocity": 1.001, "acceleration": 1.001, "jerk": 1.05}
CELLS = 8
#: Builds in a fifth of the time; what is calculated is the same.
FAST = {f"CARGO_PROFILE_REALTIME_{key}": value for key, value in (
    ("LTO", "off"), ("CODEGEN_UNITS", "16"), ("INCREMENTAL", "true"))}

Run = collections.namedtuple("Run", "times amiss")


def declaration(name):
    return re.compile(rf"^(\s*(?:pub(?:\([a-z]+\))? )?const {name}: (\w+) = )([^;]+);", re.MULTILINE)


def number(text):
    if not re.fullmatch(r"[0-9._e/* -]+", text):
        raise ValueError(f"no number: {text}")
    return eval(text.replace("_", ""))  # pylint: disable=eval-used


def less_and_more(value, integer):
    """Two values to try: half and double of a count, for what is near to 1 half and twice of what it differs by."""
    if integer:
        return max(1, value // 2), 2 * value
    if 0.5 < value < 1.0:
        return 1.0 - 2.0 * (1.0 - value), 1.0 - 0.5 * (1.0 - value)
    if 1.0 < value < 1.5:
        return 1.0 + 0.5 * (value - 1.0), 1.0 + 2.0 * (value - 1.0)
    return 0.7 * value, 1.4 * value


def written(value, integer):
    if integer:
        return str(value)
    text = repr(float(f"{value:.6g}"))
    return text if "." in text or "e" in text else text + ".0"


def copy_sources(folder):
    """The files that git knows, so that a build takes nothing else."""
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    shutil.rmtree(folder, ignore_errors=True)
    for name in listed.splitlines():
        if os.path.isfile(os.path.join(ROOT, name)):
            target = os.path.join(folder, name)
            os.makedirs(os.path.dirname(target), exist_ok=True)
            shutil.copy2(os.path.join(ROOT, name), target)
    # Without all optimisation a module holds calls that no machine is to make: none runs these.
    with open(os.path.join(folder, "hal-component", "check-module"), "w", encoding="utf-8") as file:
        file.write("#!/bin/sh\n")


def build(folder, target):
    """The module built there, or None if the compiler refuses it."""
    done = subprocess.run(["make", "modules", f"CARGO_TARGET_DIR={target}"], cwd=folder, capture_output=True, text=True,
                          check=False, env={**os.environ, **FAST, "CARGO_TARGET_DIR": target})
    return os.path.join(target, "modules", "blendtp.so") if done.returncode == 0 else None


def measure(tool, module):
    """Times of all programs, {jerk: [..]}, and what was amiss."""
    times = collections.defaultdict(list)
    amiss = set()
    generated = [word for name in GENERATED for word in ("--generated", name)]
    for operator in OPERATORS:
        done = subprocess.run([tool, "compare", *FILES, *generated, "--with", module, "--json", "--feed-at-least", "6000",
                               "--jerk", "unlimited,20A", *operator], capture_output=True, text=True, check=False)
        if done.returncode:
            return Run(None, {done.stderr.strip().splitlines()[-1]})
        for program in json.loads(done.stdout)["programs"]:
            for place, run in enumerate(program["runs"]):
                if run["state"] != "complete":
                    amiss.add(f"{program['program']} {run['state']}")
                times[place].append(run["motion"]["time"])
                for kind, most in LIMITS.items():
                    ratio = run["motion"][kind].get("ratio") if run["motion"].get(kind) else None
                    if ratio is not None and ratio > most and (kind != "jerk" or place):
                        amiss.add(f"{kind} {ratio:.2f}")
    return Run(times, amiss)


def ratio(times, base):
    return math.exp(sum(math.log(a / b) for a, b in zip(times, base, strict=True)) / len(base))


def told(changed, base):
    """What a changed constant does, for the page."""
    if changed is None:
        return "does not build"
    if changed.times is None:
        return "; ".join(changed.amiss)
    figures = " / ".join(f"{ratio(changed.times[jerk], base.times[jerk]):.4f}" for jerk in sorted(base.times))
    return ", ".join([figures, *sorted(changed.amiss - base.amiss)[:2]])


def tried(tool, sources, target, path, name, value, integer):
    """The run of a module with this value of a constant."""
    file = os.path.join(sources, path)
    with open(file, encoding="utf-8") as opened:
        before = opened.read()
    after = declaration(name).sub(lambda found: f"{found[1]}{written(value, integer)};", before, count=1)
    with open(file, "w", encoding="utf-8") as opened:
        opened.write(after)
    try:
        module = build(sources, target)
        return measure(tool, module) if module else None
    finally:
        with open(file, "w", encoding="utf-8") as opened:
            opened.write(before)


def rows():
    """(line number, cells) of the rows of the page."""
    with open(PAGE, encoding="utf-8") as file:
        for count, line in enumerate(file):
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if line.startswith("| `") and len(cells) == CELLS:
                yield count, cells


def write_row(count, cells):
    with open(PAGE, encoding="utf-8") as file:
        lines = file.readlines()
    lines[count] = f"| {' | '.join(cells)} |\n"
    with open(PAGE, "w", encoding="utf-8") as file:
        file.writelines(lines)


def main():
    parser = argparse.ArgumentParser(description="measures the rows of docs/tuning.md")
    parser.add_argument("--tool", required=True)
    parser.add_argument("--target", required=True)
    parser.add_argument("--from", type=int, default=0, dest="first", help="row to go on with")
    parser.add_argument("--to", type=int, default=sys.maxsize, dest="last", help="row to end before")
    parser.add_argument("--new", action="store_true", help="only rows without figures")
    parser.add_argument("--only", nargs="*", help="names of constants")
    options = parser.parse_args()
    target = os.path.join(os.path.abspath(options.target), "tuning")
    sources = os.path.join(target, "sources")
    copy_sources(sources)
    module = build(sources, target)
    if module is None:
        sys.exit("the module does not build")
    base = measure(options.tool, module)
    print("without a change:", base.amiss or "all limits kept", flush=True)
    # all of them before the page changes
    for place, (count, cells) in enumerate(list(rows())):
        name, path = cells[0].strip("`"), f"src/{cells[1].strip('`')}"
        if not options.first <= place < options.last or (options.only and name not in options.only):
            continue
        if options.new and cells[5]:
            continue
        with open(os.path.join(sources, path), encoding="utf-8") as file:
            found = declaration(name).search(file.read())
        if not found:
            sys.exit(f"{path} has no constant {name}")
        integer = found[2][0] != "f"
        cells[2] = found[3]
        for column, value in zip((4, 6), less_and_more(number(found[3]), integer), strict=True):
            changed = tried(options.tool, sources, target, path, name, value, integer)
            cells[column:column + 2] = [written(value, integer), told(changed, base)]
        write_row(count, cells)
        print(place, *cells[:1], *cells[4:], flush=True)


if __name__ == "__main__":
    main()
