#!/usr/bin/python3
"""The outcome table: every promise, with LinuxCNC's own planner and with blendtp.

table.py [--verbose] [--markdown] [--framekins|--frame] [ROW ...]. With --framekins both run behind framekins, without a frame;
with --frame in a turned frame."""

import concurrent.futures
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import session
from row import all_rows

STOCK, OURS = "tpmod", "blendtp"
SECTIONS = ("Identity", "Status", "Path modes", "Feed", "Operator", "Outputs", "Probing", "Indexer", "Spindle", "Threads", "Frames")
#: LinuxCNCs of all planners
AT_A_TIME = 8
#: share of what stock leaves below which ours is better, not the same
BETTER = 0.8


def outcomes(names=None, verbose=False, behind="plain", planners=(STOCK, OURS)):
    """{planner: {row: Outcome}} for these planners, in some LinuxCNCs side by side, which mostly wait."""
    names = names or [row.name() for row in all_rows(behind)]
    found: dict = {planner: {} for planner in planners}
    parts = AT_A_TIME // len(planners)
    with concurrent.futures.ThreadPoolExecutor(AT_A_TIME) as pool:
        running = [(planner, pool.submit(session.run, planner, names[part::parts], verbose, behind))
                   for planner in found for part in range(parts) if names[part::parts]]
        for planner, future in running:
            found[planner].update(future.result())
    return found


def verdict(stock, ours):
    if not ours.works:
        return "FAILS"
    if not stock.works:
        return "works, stock fails"
    if stock.figure is not None and ours.figure < BETTER * stock.figure:
        return "works better"
    return "works"


def of(found):
    """The rows of the table that were operated, in its order."""
    return sorted((row for row in all_rows() if row.name() in found[STOCK]), key=lambda row: SECTIONS.index(row.section))


def lines(found):
    """The table as text: section, promise, outcome, and what was seen of each."""
    section = None
    for row in of(found):
        stock, ours = found[STOCK][row.name()], found[OURS][row.name()]
        if row.section != section:
            section = row.section
            yield f"\n{section}"
        yield f"  {verdict(stock, ours):19} {row.promise()} [{row.name()}]"
        for planner, outcome in ((STOCK, stock), (OURS, ours)):
            if outcome.text:
                yield f"{'':22}{planner}: {'' if outcome.works else 'fails: '}{outcome.text}"


def markdown(found):
    """The same for docs/promises.md."""
    yield "| | with blendtp | LinuxCNC's own planner |\n|---|---|---|"
    section = None
    for row in of(found):
        stock, ours = found[STOCK][row.name()], found[OURS][row.name()]
        if row.section != section:
            section = row.section
            yield f"| **{section}** | | |"
        cells = [verdict(stock, ours), "works" if stock.works else "fails"]
        cells[0] = cells[0].replace(", stock fails", "")
        for n, outcome in enumerate((ours, stock)):
            if outcome.text:
                cells[n] += f": {outcome.text}"
        yield f"| {row.promise()} | {cells[0]} | {cells[1]} |"


def main():
    options = {"--verbose", "--markdown", "--framekins", "--frame"}
    behind = next((name for name in session.SETTINGS if f"--{name}" in sys.argv), "plain")
    names = [argument for argument in sys.argv[1:] if argument not in options]
    unknown = set(names) - {row.name() for row in all_rows(behind)}
    if unknown:
        sys.exit(f"no such row of this table: {', '.join(sorted(unknown))}")
    found = outcomes(names, "--verbose" in sys.argv, behind)
    print("\n".join(markdown(found) if "--markdown" in sys.argv else lines(found)))


if __name__ == "__main__":
    main()
