"""Builds the tests of the copy, finds what each of them reaches, and runs them with one fault at a time."""

import concurrent.futures
import dataclasses
import json
import os
import signal
import subprocess
import tempfile
import time

from source import ROOT, TREE, WORK

# These look at the whole from outside: documents, lengths of functions, the header, the layout of structures, symbols of
# the modules, folders.
NOT_OF_THE_CORE = {"documents", "function_length", "header", "layout", "modules", "order"}

# Few cases of each property, the same each time; no names and lines of what panics, which take long to link.
ENVIRONMENT = {
    "FRAMEPATH_CASES": "8",
    "PROPTEST_CASES": "32",
    "PROPTEST_RNG_SEED": "1",
    "RUST_BACKTRACE": "0",
    "CARGO_INCREMENTAL": "1",
    "CARGO_PROFILE_DEV_DEBUG": "0",
}

# Tests that take so many times the processor's time that they take without the fault, and so many seconds, do not end.
TIMEOUT_MULTIPLIER = 6
LEAST_TIMEOUT = 10
# Nor do those that wait for so long, in seconds of the clock, or take so much memory, in KiB.
LONGEST_WAIT = 900
MOST_MEMORY = 6 << 20

WORKERS = max(2, (os.cpu_count() or 2) // 2)


@dataclasses.dataclass
class Test:
    program: str
    path: str
    name: str
    # Seconds of the processor without a fault.
    seconds: float = 0.0
    # The numbers of the faults that it comes to.
    reached: frozenset = frozenset()

    def __str__(self):
        return f"{self.program}::{self.name}"


def environment(**more):
    return dict(os.environ, CARGO_TARGET_DIR=os.path.join(WORK, "build"), **ENVIRONMENT, **more)


def cargo(*arguments):
    """What cargo says of each file, and whether it succeeds."""
    command = ["cargo", *arguments, "--locked", "--package", "framepath", "--message-format=json"]
    answer = subprocess.run(command, cwd=TREE, env=environment(), capture_output=True, check=False)
    with open(os.path.join(WORK, "cargo.log"), "ab") as log:
        log.write(answer.stderr)
    lines = answer.stdout.decode().splitlines()
    return [json.loads(line) for line in lines if line.startswith("{")], answer.returncode == 0


def errors():
    """The places that the compiler refuses in the library: lists of file and line, the first of them the main one."""
    messages, built = cargo("check", "--lib")
    found = []
    for message in messages:
        told = message.get("message") or {}
        if message["reason"] == "compiler-message" and told["level"] == "error":
            spans = sorted(told["spans"], key=lambda span: not span["is_primary"])
            found.append([(span["file_name"], span["line_start"]) for span in spans])
    assert built or found, "cargo check fails without a word; see cargo.log"
    return found


def programs(wanted):
    """The test programs by name, built."""
    folder = os.path.join(ROOT, "tests")
    names = sorted(name.removesuffix(".rs") for name in os.listdir(folder)
                   if name.endswith(".rs") or os.path.exists(os.path.join(folder, name, "main.rs")))
    names = [name for name in names if name not in NOT_OF_THE_CORE and (not wanted or name in wanted)]
    arguments = [] if wanted and "lib" not in wanted else ["--lib"]
    for name in names:
        arguments += ["--test", name]
    messages, built = cargo("test", "--no-run", *arguments)
    if not built:
        told = [message["message"]["rendered"] for message in messages if message["reason"] == "compiler-message"]
        raise SystemExit("the tests cannot be built:\n" + "\n".join(told[-3:]))
    found = {}
    for message in messages:
        if message["reason"] == "compiler-artifact" and message["executable"]:
            inside = "lib" in message["target"]["kind"] or "staticlib" in message["target"]["kind"]
            found["lib" if inside else message["target"]["name"]] = message["executable"]
    return found


def tests_of(program, path):
    def listed(*options):
        answer = subprocess.run([path, "--list", "--format", "terse", *options], cwd=TREE, check=True,
                                capture_output=True)
        return {line[:-len(": test")] for line in answer.stdout.decode().splitlines() if line.endswith(": test")}

    return [Test(program, path, name) for name in sorted(listed() - listed("--ignored"))]


def run(test, seconds, **more):
    """Runs a test: whether it passes, None where it does not end, and the seconds of the processor that it took."""
    limits = f"ulimit -c 0 -t {int(seconds) + 1} -v {MOST_MEMORY}"
    command = ["sh", "-c", limits + '; exec "$0" "$@"', test.path, "--exact", test.name, "--test-threads=1"]
    with tempfile.TemporaryFile(dir=WORK) as output:
        process = subprocess.Popen(command, cwd=TREE, env=environment(**more), stdout=output, stderr=output)
        begun, pause = time.monotonic(), 0.005
        while True:
            ended, status, usage = os.wait4(process.pid, os.WNOHANG)
            if ended:
                break
            if time.monotonic() - begun > LONGEST_WAIT:
                process.kill()
            time.sleep(pause)
            pause = min(0.2, pause * 1.3)
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        said = output.read()
    taken = usage.ru_utime + usage.ru_stime
    if process.returncode == 0 and b"test result: ok. 1 passed" not in said:
        raise SystemExit(f"{test} was not run:\n{said.decode()}")
    if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return None, taken
    return process.returncode == 0, taken


def probed(test):
    """The test with what it takes and reaches."""
    with tempfile.NamedTemporaryFile(dir=WORK) as file:
        passed, seconds = run(test, 3600, FRAMEPATH_REACHED=file.name)
        if not passed:
            raise SystemExit(f"fails without any fault: {test}")
        numbers = frozenset(int(line) for line in file.read().split())
    return dataclasses.replace(test, seconds=seconds, reached=numbers)


def all_probed(tests):
    with concurrent.futures.ThreadPoolExecutor(WORKERS) as pool:
        return sorted(pool.map(probed, tests), key=lambda test: test.seconds)


def outcome(tests, **more):
    """What these tests, quick ones first, make of the fault that is switched on: a word, and the test that told."""
    for test in tests:
        passed, _ = run(test, LEAST_TIMEOUT + TIMEOUT_MULTIPLIER * test.seconds, **more)
        if passed is None:
            return "timeout", str(test)
        if not passed:
            return "caught", str(test)
    return "missed", f"{len(tests)} tests come to it"
