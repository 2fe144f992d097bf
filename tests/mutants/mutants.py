#!/usr/bin/python3
"""Puts faults into the core, one at a time, and counts how many of them the Rust tests catch.

Faults (mutants) are drawn at random from those that cargo-mutants knows for the folders of FOLDERS; the seed is printed
and can be given. All of them are put into one copy of the source, each behind a switch (source.py), so that the tests
are built once. Each test is run once without a fault, which shows what it takes and which faults it comes to; then each
fault meets the tests that come to it, quick ones first, until one of them fails (runs.py). Caught and timed out count
as caught; what cannot be built, or is known to change nothing (equivalent.txt), counts for nothing.
"""

import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import re
import shutil
import sys
import threading
import time

import runs
from source import HERE, WORK, Copy, copy, listed

# Of src.
FOLDERS = ["planner", "cycle", "speed", "frame", "kinematics", "abi"]

RESULTS = os.path.join(WORK, "results.json")


def folder_of(mutant):
    return mutant["file"].split("/")[1]


def described(mutant):
    """What the mutant does, without its line, which changes with every edit above it."""
    description = re.sub(r"^[^:]*:\d+:\d+: ", "", mutant["name"])
    return mutant["file"] + ": " + description


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()


def identified(mutants):
    """The mutants by a name that stays the same when other lines of a file change."""
    counts: collections.Counter = collections.Counter()
    found = {}
    for mutant in sorted(mutants, key=lambda mutant: (mutant["file"], mutant["span"]["start"]["line"],
                                                      mutant["span"]["start"]["column"], mutant["name"])):
        changed = "\n".join(line for line in mutant["diff"].splitlines()[2:] if not line.startswith("@@"))
        name = described(mutant) + " #" + digest(changed)[:8]
        counts[name] += 1
        found[f"{name}.{counts[name]}"] = mutant
    return found


def drawn(found, seed, count):
    """So many of the mutants at random; an edit changes the draw by no more than what it edits."""
    return sorted(found, key=lambda name: digest(f"{seed} {name}"))[:count]


def equivalents():
    """Mutants that change nothing that can be seen, with the reason."""
    known = {}
    with open(os.path.join(HERE, "equivalent.txt"), encoding="utf-8") as lines:
        for line in lines:
            if line.strip() and not line.startswith("#"):
                mutant, _, reason = line.strip().partition(" -- ")
                known[mutant] = reason
    return known


class Results:
    """What is known of each mutant, in a file: what has been found stays when the run is cut."""

    def __init__(self, resumed):
        self.known = {}
        self.lock = threading.Lock()
        if resumed and os.path.isfile(RESULTS):
            with open(RESULTS, encoding="utf-8") as file:
                self.known = json.load(file)

    def word(self, name):
        return self.known.get(name, [None])[0]

    def note(self, name, word, by, seconds, shown):
        with self.lock:
            self.known[name] = [word, by]
            print(f"{word:9}{seconds:5.0f} s  {shown}  ({by})", flush=True)
            with open(RESULTS + ".new", "w", encoding="utf-8") as file:
                json.dump(self.known, file, indent=1)
            os.replace(RESULTS + ".new", RESULTS)


def together(source, mutants):
    """Puts in as many as can be built at once. Returns the numbers of the others."""
    left = dict(mutants)
    for _ in range(20):
        for number in source.put_in(left):
            del left[number]
        refused = set()
        for places in runs.errors():
            guilty = next((numbers for numbers in (source.at(*place) for place in places) if numbers), None)
            if guilty is None:
                sys.exit(f"a compiler error that no mutant makes, at {places}")
            refused.update(guilty)
        if not refused:
            return [number for number in mutants if number not in left]
        for number in refused:
            del left[number]
    sys.exit("the compiler refuses something each time")


def run_alone(source, name, mutant, results, wanted):
    """A mutant that cannot be built with others: most of them cannot be built at all."""
    begun = time.monotonic()
    source.put_in_alone(mutant)
    if runs.errors():
        word, by = "unviable", "the compiler"
    else:
        tests = [test for program, path in runs.programs(wanted).items() for test in runs.tests_of(program, path)]
        source.put_in({})
        runs.programs(wanted)
        tests = runs.all_probed(tests)
        source.put_in_alone(mutant)
        runs.programs(wanted)
        word, by = runs.outcome(tests)
    results.note(name, word, by, time.monotonic() - begun, mutant["name"])


def run_switched(numbers, mutants, names, results, tests):
    def one(number):
        begun = time.monotonic()
        reaching = [test for test in tests if number in test.reached]
        word, by = runs.outcome(reaching, FRAMEPATH_MUTANT=str(number))
        results.note(names[number], word, by, time.monotonic() - begun, mutants[number]["name"])

    with concurrent.futures.ThreadPoolExecutor(runs.WORKERS) as pool:
        for answer in [pool.submit(one, number) for number in numbers]:
            answer.result()


def run_all(source, names, found, results, wanted):
    """Tests the mutants with these names."""
    mutants = {number: found[name] for number, name in enumerate(names)}
    alone = together(source, mutants)
    switched = [number for number in mutants if number not in alone]
    print(f"{len(switched)} mutants are put in together; building the tests", flush=True)
    built = runs.programs(wanted)
    tests = [test for program, path in built.items() for test in runs.tests_of(program, path)]
    print(f"{len(tests)} tests of {len(built)} programs run without a fault", flush=True)
    tests = runs.all_probed(tests)
    print(f"they take {sum(test.seconds for test in tests):.0f} s of the processor", flush=True)
    run_switched(switched, mutants, names, results, tests)
    for number in alone:
        run_alone(source, names[number], mutants[number], results, wanted)


def report(names, found, results, known):
    """The table, and each survivor. Returns the share that was caught."""
    counts: dict = collections.defaultdict(collections.Counter)
    survivors, same = [], []
    for name in names:
        word, mutant = results.word(name), found[name]
        if word is None:
            continue
        if word == "missed" and described(mutant) in known:
            word = "equivalent"
            same.append(mutant)
        elif word == "missed":
            survivors.append(name)
        for row in (folder_of(mutant), "all"):
            counts[row][word] += 1
    columns = ["caught", "timeout", "missed", "equivalent", "unviable"]
    print(f"\n{len(names)} mutants drawn, {sum(counts['all'].values())} tested\n")
    print(f"{'':10}" + "".join(f"{column:>12}" for column in columns) + f"{'share':>12}")
    share = 0.0
    for row in [*FOLDERS, "all"]:
        count = counts[row]
        caught = count["caught"] + count["timeout"]
        total = caught + count["missed"]
        share = caught / total if total else 1.0
        if count:
            print(f"{row:10}" + "".join(f"{count[column]:12}" for column in columns) + f"{share:12.1%}")
    for name in survivors:
        print(f"missed: {found[name]['name']} ({results.known[name][1]})")
    for mutant in same:
        print("equivalent:", mutant["name"], "--", known[described(mutant)])
    return share


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=120, help="how many mutants are drawn")
    parser.add_argument("--seed", type=int, default=int(time.time()), help="the same seed draws the same mutants")
    parser.add_argument("--folders", default=",".join(FOLDERS),
                        help="of src, with commas between them: what is drawn from others is left out")
    parser.add_argument("--least", type=float, default=0.85, help="the share that has to be caught")
    parser.add_argument("--resume", action="store_true",
                        help="what an earlier run has found is not tested again, but for what it missed")
    parser.add_argument("--match", help="instead of drawing, all mutants whose names have this")
    parser.add_argument("--tests", help="only these test programs, with commas between them; lib: those in src")
    options = parser.parse_args()
    if not shutil.which("cargo-mutants"):
        sys.exit("cargo-mutants is missing: cargo install cargo-mutants --locked")
    print(f"seed {options.seed}", flush=True)
    found = identified(listed(FOLDERS))
    source = Copy(copy())
    if options.match:
        names = [name for name, mutant in found.items() if options.match in mutant["name"]]
    else:
        names = drawn(found, options.seed, options.count)
    names = [name for name in names if folder_of(found[name]) in options.folders.split(",")]
    print(f"{len(names)} of {len(found)} mutants", flush=True)
    results = Results(options.resume)
    known = equivalents()
    left = [name for name in names
            if results.word(name) is None
            or (results.word(name) == "missed" and described(found[name]) not in known)]
    if left:
        run_all(source, left, found, results, options.tests.split(",") if options.tests else [])
    share = report(names, found, results, known)
    sys.exit(share < options.least)


if __name__ == "__main__":
    main()
