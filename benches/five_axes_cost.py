#!/usr/bin/python3
"""What a servo period costs on a table with the tool centre point, with exact jets and with those by numbers:

    five_axes_cost.py --exact ARGUMENTS --by-numbers ARGUMENTS TOOL PROGRAMS AND OPTIONS OF BOTH

runs `TOOL compare` some times in turn, without and with a restless operator, and keeps the least of each figure, so that
what else the computer does in between does not count. Numerical jets are priced by what they take, so that the plan differs a
little from run to run, and a call cannot be compared with the same one of another run.
"""

import argparse
import json
import shlex
import subprocess

RUNS = 3
OPERATORS: dict[str, list[str]] = {"": [], ", operator": ["--operator", "1"]}


def costs(command):
    """[(program, (calls, mean, 99.9th percentile))] of one run."""
    done = subprocess.run([*command, "--json"], capture_output=True, text=True, check=True)
    for program in json.loads(done.stdout)["programs"]:
        (run,) = program["runs"]
        yield program["program"], tuple(run["run"][figure] for figure in ("calls", "mean", "p999"))


def row(*cells):
    print("| " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--exact", required=True)
    parser.add_argument("--by-numbers", required=True)
    parser.add_argument("tool")
    parser.add_argument("both", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    cases = {
        kind + operator: [options.tool, "compare", *options.both, *shlex.split(arguments), *words]
        for operator, words in OPERATORS.items()
        for kind, arguments in (("exact", options.exact), ("by numbers", options.by_numbers))
    }
    least: dict[tuple[str, str], list[float]] = {}
    for _ in range(RUNS):
        for case, command in cases.items():
            for program, figures in costs(command):
                key = program, case
                least[key] = [min(pair) for pair in zip(figures, least.get(key, figures), strict=True)]
    programs = list(dict.fromkeys(program for program, _ in least))
    row("servo period: us in the mean, 99.9th percentile", *cases)
    row("---", *["---:"] * len(cases))
    for program in programs:
        row(program, *(f"{mean:.1f}, {p999:.0f}" for _, mean, p999 in (least[program, case] for case in cases)))
    means, greatest = [], []
    for case in cases:
        of_case = [least[program, case] for program in programs]
        total = sum(calls for calls, _, _ in of_case)
        means.append(sum(calls * mean for calls, mean, _ in of_case) / total)
        greatest.append(max(p999 for _, _, p999 in of_case))
    row("all", *(f"{mean:.1f}, {p999:.0f}" for mean, p999 in zip(means, greatest, strict=True)))


if __name__ == "__main__":
    main()
