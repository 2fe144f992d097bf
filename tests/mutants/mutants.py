#!/usr/bin/python3
"""Puts faults into the core, one at a time, and counts how many of them the Rust tests catch.

Faults (mutants) are drawn at random from those that cargo-mutants knows for the folders of TESTS; the seed is printed
and can be given. They are put in here, since cargo-mutants cannot be asked for just these: its option --re lets all of
one kind pass. Each is tested in a copy of the source with the tests of its folder only, in stages: what the first tests
do not catch meets the next ones. Caught and timed out count as caught; what cannot be built, or is known to change
nothing (equivalent.txt), counts for nothing.
"""

import argparse
import collections
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
WORK = os.path.join(os.environ.get("CARGO_TARGET_DIR", os.path.join(ROOT, "target")), "mutants")
TREE = os.path.join(WORK, "tree")

# The tests that belong to each folder of src, in stages: quick ones that catch most first.
TESTS = {
    "abi": [
        "--lib --test abi_found --test abi_answers --test abi_random",
    ],
    "frame": [
        "--lib --test frames_control --test frames_tool --test frames_sinumerik",
        "--test frames_properties --test machine_control --test abi_found --test abi_answers --test abi_random",
    ],
    "planner": [
        "--lib --test planner_operator --test planner_queue --test planner_spindle --test planner_spindle_events",
        "--test planner_moves --test planner_holds --test planner_reverse --test planner_behind_frame --test abi_answers",
        "--test planner_found_limits --test planner_found_rests --test planner_found_between --test planner_found_standstill"
        " --test planner_invariance --test planner_history --test planner_programs --test abi_random",
    ],
    "cycle": [
        "--lib --test executor_edges --test executor_demand --test executor_limits",
        "--test executor_holds --test executor_without_jerk_limit --test planner_operator --test planner_holds",
        "--test planner_found_limits --test planner_programs",
    ],
    "speed": [
        "--lib --test look_ahead_limits --test look_ahead_time --test look_ahead_jumps",
        "--test planner_found_limits --test planner_found_rests --test planner_found_between --test planner_invariance",
        "--test planner_programs --test planner_holds --test planner_behind_frame",
    ],
}

# Few cases of each property, the same each time; no names and lines of what panics, which take long to link.
ENVIRONMENT = {
    "FRAMEPATH_CASES": "8",
    "PROPTEST_CASES": "32",
    "PROPTEST_RNG_SEED": "1",
    "RUST_BACKTRACE": "0",
    "CARGO_INCREMENTAL": "1",
    "CARGO_PROFILE_DEV_DEBUG": "0",
}

# Tests that take so many times as long as without the fault, and so many seconds, do not end.
TIMEOUT_MULTIPLIER = 6
LEAST_TIMEOUT = 60


def folder_of(mutant):
    return mutant["file"].split("/")[1]


def described(mutant):
    """What the mutant does, without its line, which changes with every edit above it."""
    description = re.sub(r"^[^:]*:\d+:\d+: ", "", mutant["name"])
    return mutant["file"] + ": " + description


def equivalents():
    """Mutants that change nothing that can be seen, with the reason."""
    known = {}
    with open(os.path.join(HERE, "equivalent.txt"), encoding="utf-8") as lines:
        for line in lines:
            if line.strip() and not line.startswith("#"):
                mutant, _, reason = line.strip().partition(" -- ")
                known[mutant] = reason
    return known


def copy_source():
    """The files of the repository as they are now; what has not changed keeps its time, so that builds are incremental."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            cwd=ROOT, check=True, capture_output=True).stdout.decode().split("\0")
    wanted = {name for name in listed if name and os.path.isfile(os.path.join(ROOT, name))}
    for name in wanted:
        source, target = os.path.join(ROOT, name), os.path.join(TREE, name)
        with open(source, "rb") as file:
            content = file.read()
        if name == "Cargo.toml":
            # What a fault leaves unused is no error here.
            content = content.replace(b'"deny"', b'"allow"')
        if os.path.isfile(target):
            with open(target, "rb") as file:
                if file.read() == content:
                    continue
        os.makedirs(os.path.dirname(target), exist_ok=True)
        with open(target, "wb") as file:
            file.write(content)
    for folder, _, names in os.walk(os.path.join(TREE, "src")):
        for name in names:
            if os.path.relpath(os.path.join(folder, name), TREE) not in wanted:
                os.remove(os.path.join(folder, name))


def listed(folders):
    command = ["cargo", "mutants", "--list", "--json"]
    for folder in folders:
        command += ["--file", f"src/{folder}/**"]
    answer = subprocess.run(command, cwd=TREE, check=True, capture_output=True)
    return sorted(json.loads(answer.stdout), key=lambda mutant: mutant["name"])


def cargo(arguments, log, seconds=None):
    """Whether a cargo command succeeds; None where it takes longer than so many seconds.

    One test that fails is enough: others may go on for ever."""
    environment = dict(os.environ, CARGO_TARGET_DIR=os.path.join(WORK, "build"), **ENVIRONMENT)
    command = ["cargo", "test", "--locked", "--package", "framepath", *arguments]
    begun, read = time.monotonic(), os.path.getsize(log.name)
    with subprocess.Popen(command, cwd=TREE, env=environment, stdout=log, stderr=log, start_new_session=True) as process:
        while True:
            try:
                return process.wait(0.5) == 0
            except subprocess.TimeoutExpired:
                late = seconds is not None and time.monotonic() - begun > seconds
                with open(log.name, "rb") as written:
                    written.seek(read)
                    failed = b" ... FAILED\n" in written.read()
                if late or failed:
                    os.killpg(process.pid, signal.SIGKILL)
                    return False if failed else None


def patch(mutant, *options):
    """Puts the mutant into the copy, or takes it out again."""
    subprocess.run(["patch", "--quiet", "--no-backup-if-mismatch", *options, mutant["file"]], cwd=TREE, check=True,
                   input=mutant["diff"].encode())


def outcome(mutant, tests, seconds, log):
    """What becomes of a mutant with these tests."""
    patch(mutant)
    try:
        if not cargo(["--no-run", *tests], log):
            return "unviable"
        passed = cargo(tests, log, seconds)
        return {True: "missed", False: "caught", None: "timeout"}[passed]
    finally:
        patch(mutant, "--reverse")


def seconds_without_fault(tests, log):
    """How long these tests may take; they have to pass without a fault."""
    if not cargo(["--no-run", *tests], log):
        # A run that was killed while it compiled leaves halves behind.
        shutil.rmtree(os.path.join(WORK, "build", "debug", "incremental"), ignore_errors=True)
        subprocess.run(["touch", "src/lib.rs"], cwd=TREE, check=True)
    if not cargo(["--no-run", *tests], log):
        sys.exit(f"cannot be built: {tests}; see {log.name}")
    begun = time.monotonic()
    if not cargo(tests, log):
        sys.exit(f"fail without any fault: {tests}; see {log.name}")
    return LEAST_TIMEOUT + TIMEOUT_MULTIPLIER * (time.monotonic() - begun)


def run_folder(folder, mutants, results):
    left = mutants
    for stage, tests in enumerate(TESTS[folder], 1):
        if not left:
            return
        print(f"\n{folder}, stage {stage} of {len(TESTS[folder])}: {len(left)} mutants, cargo test {tests}", flush=True)
        with open(os.path.join(WORK, f"{folder}-{stage}.log"), "w", encoding="utf-8") as log:
            seconds = seconds_without_fault(tests.split(), log)
            for mutant in left:
                print(mutant["name"], file=log, flush=True)
                begun = time.monotonic()
                results[mutant["name"]] = outcome(mutant, tests.split(), seconds, log)
                print(f"{results[mutant['name']]:9}{time.monotonic() - begun:5.0f} s  {mutant['name']}", flush=True)
                keep(results)
        left = [mutant for mutant in left if results[mutant["name"]] == "missed"]


def keep(results):
    with open(os.path.join(WORK, "results.json"), "w", encoding="utf-8") as file:
        json.dump(results, file, indent=1)


def kept():
    with open(os.path.join(WORK, "results.json"), encoding="utf-8") as file:
        return json.load(file)


def report(drawn, results, known, seed):
    """The table, and each survivor. Returns the share that was caught."""
    counts = collections.defaultdict(collections.Counter)
    survivors, same = [], []
    for mutant in drawn:
        if mutant["name"] not in results:
            continue
        word = results[mutant["name"]]
        if word == "missed" and described(mutant) in known:
            word = "equivalent"
            same.append(mutant)
        elif word == "missed":
            survivors.append(mutant)
        for row in (folder_of(mutant), "all"):
            counts[row][word] += 1
    columns = ["caught", "timeout", "missed", "equivalent", "unviable"]
    print(f"\nseed {seed}, {len(drawn)} mutants drawn, {sum(counts['all'].values())} tested\n")
    print(f"{'':10}" + "".join(f"{column:>12}" for column in columns) + f"{'share':>12}")
    share = 0.0
    for row in [*TESTS, "all"]:
        count = counts[row]
        caught = count["caught"] + count["timeout"]
        total = caught + count["missed"]
        share = caught / total if total else 1.0
        if count:
            print(f"{row:10}" + "".join(f"{count[column]:12}" for column in columns) + f"{share:12.1%}")
    for mutant in survivors:
        print("missed:", mutant["name"])
    for mutant in same:
        print("equivalent:", mutant["name"], "--", known[described(mutant)])
    return share


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=120, help="how many mutants are drawn")
    parser.add_argument("--seed", type=int, default=int(time.time()), help="the same seed draws the same mutants")
    parser.add_argument("--folders", default=",".join(TESTS),
                        help="of src, with commas between them: what is drawn from others is left out")
    parser.add_argument("--least", type=float, default=0.85, help="the share that has to be caught")
    parser.add_argument("--resume", action="store_true", help="what the last run has found is not tested again")
    parser.add_argument("--match", help="instead of drawing, all mutants whose names have this")
    options = parser.parse_args()
    folders = options.folders.split(",")
    if not shutil.which("cargo-mutants"):
        sys.exit("cargo-mutants is missing: cargo install cargo-mutants --locked")
    print(f"seed {options.seed}", flush=True)
    copy_source()
    mutants = listed(TESTS)
    known = equivalents()
    if options.match:
        drawn = [mutant for mutant in mutants if options.match in mutant["name"]]
    else:
        drawn = random.Random(options.seed).sample(mutants, min(options.count, len(mutants)))
    print(f"{len(drawn)} of {len(mutants)} mutants", flush=True)
    results = kept() if options.resume else {}
    for folder in folders:
        in_folder = [mutant for mutant in drawn
                     if folder_of(mutant) == folder and results.get(mutant["name"], "missed") == "missed"]
        if in_folder:
            run_folder(folder, in_folder, results)
    share = report(drawn, results, known, options.seed)
    sys.exit(share < options.least)


if __name__ == "__main__":
    main()
