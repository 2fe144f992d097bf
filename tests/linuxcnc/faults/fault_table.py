#!/usr/bin/python3
"""The table of faults, in Markdown: fault_table.py [--short] [ROW ...]. Exit code 1 if a row does not hold."""

import argparse
import concurrent.futures
import sys
import traceback

from fault import Broken, all_rows

#: LinuxCNCs at once, which mostly wait.
AT_A_TIME = 3


class Outcome:
    """Whether a row holds, and what was seen."""

    def __init__(self, holds, text):
        self.holds, self.text = holds, text


def outcome(kind, short):
    row = kind()
    row.short = short
    try:
        return Outcome(True, row.run() or "")
    except Broken as broken:
        return Outcome(False, str(broken))
    except Exception as error:  # LinuxCNC that does not come up, an answer that is not there: the row does not hold
        traceback.print_exc()
        return Outcome(False, f"cannot be judged: {str(error).splitlines()[0] if str(error) else error!r}")


def outcomes(names=None, short=False):
    """{row: Outcome}, a few side by side; each is told as it comes."""
    kinds = [row for row in all_rows() if not names or row.name() in names]
    found = {}
    with concurrent.futures.ThreadPoolExecutor(AT_A_TIME) as pool:
        running = {pool.submit(outcome, kind, short): kind for kind in kinds}
        for future in concurrent.futures.as_completed(running):
            kind = running[future]
            found[kind.name()] = future.result()
            print(f"{kind.name()}: {'holds' if found[kind.name()].holds else 'DOES NOT HOLD'}: {found[kind.name()].text}",
                  file=sys.stderr, flush=True)
    return found


def cell(text):
    return " ".join(text.replace("|", "\\|").split())


def markdown(found):
    yield "| what is done | what must hold | what was seen |\n|---|---|---|"
    section = None
    for row in all_rows():
        if row.name() not in found:
            continue
        if row.section != section:
            section = row.section
            yield f"| **{section}** | | |"
        seen = found[row.name()]
        yield f"| {cell(row.done)} | {cell(row.promise())} | {'' if seen.holds else '**does not hold**: '}{cell(seen.text)} |"


def main():
    parser = argparse.ArgumentParser(description="What LinuxCNC and both modules do when something goes wrong, as a table.")
    parser.add_argument("--short", action="store_true", help="less of what is done many times")
    parser.add_argument("rows", nargs="*", metavar="ROW", help="only these rows")
    arguments = parser.parse_args()
    unknown = set(arguments.rows) - {row.name() for row in all_rows()}
    if unknown:
        sys.exit(f"no such row: {', '.join(sorted(unknown))}")
    found = outcomes(arguments.rows, arguments.short)
    print("\n".join(markdown(found)))
    broken = [name for name, seen in found.items() if not seen.holds]
    print(f"\n{len(found)} rows, {len(broken)} do not hold{': ' if broken else ''}{', '.join(broken)}", file=sys.stderr)
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
