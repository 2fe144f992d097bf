#!/usr/bin/python3
"""LinuxCNC's own suites with its own planner and with blendtp, beside each other: a table in Markdown.

suites.py SOURCE [SUITE ...]: SOURCE is a folder of LinuxCNC's source. Where LinuxCNC was built in it, that one is run in place;
otherwise the one that is installed runs the suites. Each suite is copied, and the copy for blendtp gets [TRAJ]TPMOD = blendtp.
Exit code 1 if blendtp fails one that LinuxCNC's planner passes, other than as KNOWN says.
"""

import argparse
import concurrent.futures
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap

import harness

#: Tests of HAL alone, with no planner in them; the others are found by their INI files.
THREADS = ("threads.0", "threads.1")

#: Tests that blendtp is known to fail: what they say then, and why in a few words. docs/suites.md says more.
KNOWN = {
    "abort/g64": (r"(?s)ERROR max X4\.[58]\d* != expected X3\.700.*Exiting with 2 errors",
                  "of a corner under G64 without P less is cut off than LinuxCNC's planner cuts off"),
    "motion/g0": (r"detected accel 0\.000(0[5-9]\d|100) i/c\^2 .*\n *error: max accel 100\.0",
                  "a move alone takes all of the acceleration, LinuxCNC 2.9's planner half"),
}

#: Suites at once: a test and its twin. They wait most of the time, and mind when LinuxCNC comes up late.
AT_A_TIME = 2

#: Seconds after which a test is stopped.
TIMEOUT = 300

#: A file of these names makes a folder a test, as LinuxCNC's own script has it.
SCRIPTS = ("test.hal", "test.sh", "test")

STOCK, OURS = PLANNERS = ("tpmod", "blendtp")


class LinuxCNC:
    """The LinuxCNC that runs the suites of a source tree."""

    def __init__(self, source, scratch):
        self.source = os.path.realpath(source)
        self.in_place = os.path.exists(os.path.join(self.source, "scripts", "runtests"))
        if not os.path.isdir(os.path.join(self.source, "tests")):
            raise SystemExit(f"suites.py: {source} has no folder tests: it is to be the folder of LinuxCNC's source")
        version, installed = text_of(os.path.join(self.source, "VERSION")).strip(), installed_version()
        if not self.in_place and series(version) != series(installed):
            raise SystemExit(f"suites.py: {source} is LinuxCNC {version} and not built, {installed or 'none'} is installed: "
                             "build it to be run in place, or name the source of the one that is installed")
        self.runtests = os.path.join(self.source, "scripts", "runtests") if self.in_place else runtests_of_installed(
            os.path.join(self.source, "scripts", "runtests.in"), os.path.join(scratch, "runtests"))

    def environment(self, keep):
        """What `isolated` wants to know: where the test may write, and which LinuxCNC it is for."""
        path = "/usr/sbin:/usr/bin:/sbin:/bin"  # LinuxCNC's scripts take the first python3
        return dict(os.environ, PATH=path, KEEP=keep, LINUXCNC_IN_PLACE=self.source if self.in_place else "")

    def tests(self, suite=""):
        """The tests of a suite, a folder of `tests` or one further in, each by its folder."""
        top = os.path.join(self.source, "tests")
        folders = (folder for folder, _, files in os.walk(os.path.join(top, suite)) if any(name in files for name in SCRIPTS))
        return sorted(os.path.relpath(folder, top) for folder in folders)

    def tests_with_motion(self):
        """All tests that move a machine, and those of threads: an INI with motmod lies in their folder or in one around it."""
        return [test for test in self.tests() if test in THREADS or self.has_planner(test)]

    def has_planner(self, test):
        return any(map(has_motion, self.inis_of(test)))

    def inis_of(self, test):
        parts = test.split(os.sep)
        for depth in range(1, len(parts) + 1):
            yield from glob.glob(os.path.join(self.source, "tests", *parts[:depth], "*.ini"))


def installed_version():
    found = re.search(r'^LINUXCNCVERSION="([^"]*)"', text_of("/usr/bin/linuxcnc"), re.MULTILINE)
    return found[1] if found else ""


def series(version):
    """The first two numbers of a version: tests belong to these."""
    return version.split(".")[:2]


def has_motion(ini):
    return re.search(r"^\s*EMCMOT\s*=\s*motmod", text_of(ini), re.MULTILINE)


def runtests_of_installed(template, path):
    """LinuxCNC's script that runs tests, for the installed LinuxCNC: the packages lack it."""
    words = {"RUN_IN_PLACE": "no", "EMC2_HOME": "/usr", "prefix": "/usr", "includedir": "/usr/include",
             "REALTIME": "/usr/lib/linuxcnc/realtime", "WISH": "/usr/bin/wish"}
    with open(path, "w", encoding="utf-8") as file:
        file.write(re.sub(r"@(\w+)@", lambda word: words.get(word[1], ""), text_of(template)))
    os.chmod(path, 0o755)
    return path


def files_below(folder):
    for above, _, files in os.walk(folder):
        yield from (os.path.join(above, file) for file in files)


def text_of(path):
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            return file.read()
    except FileNotFoundError:
        return ""


def with_planner(ini, planner):
    """The text of an INI file with this planner; one without [TRAJ] stays as it is."""
    return re.sub(r"^(\s*\[TRAJ\].*)$", rf"\1\nTPMOD = {planner}", ini, count=1, flags=re.MULTILINE)


def copy_suite(linuxcnc, suite, planner, folder):
    """A copy of a suite for a planner. Its links stay links: suites share files by them."""
    copy = os.path.join(folder, suite)
    shutil.copytree(os.path.join(linuxcnc.source, "tests", suite), copy, symlinks=True)
    for path in files_below(copy):
        if path.endswith(".ini") and not os.path.islink(path):
            text = with_planner(text_of(path), planner)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
    return copy


class Outcome:
    """Of a test with a planner: whether it passes, and what is said of that."""

    def __init__(self, passes, text, details=""):
        self.passes, self.text, self.details = passes, text, details


def run_test(linuxcnc, test, planner, scratch):
    """Runs a copy of a test in namespaces of its own. With blendtp nothing else can be loaded as a planner."""
    suite = test.split(os.sep)[0]
    folder = tempfile.mkdtemp(prefix=f"{planner}-", dir=scratch)
    os.chmod(folder, 0o755)
    copy = copy_suite(linuxcnc, suite, planner, folder)
    place = os.path.join(folder, test)
    try:
        command = [os.path.join(harness.HERE, "isolated"), modules_for(planner, folder), linuxcnc.runtests, "-n", place]
        done = subprocess.run(command, env=linuxcnc.environment(copy), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, encoding="utf-8", errors="replace", timeout=TIMEOUT, check=False)
        said = done.stdout
    except subprocess.TimeoutExpired:
        said = f"*** {place}: XFAIL: stopped after {TIMEOUT} s\n"
    return judge(said, place, linuxcnc.has_planner(test))


def modules_for(planner, folder):
    """A folder of modules to lay over LinuxCNC's."""
    if planner == STOCK:
        return harness.MODULES
    modules = os.path.join(folder, "modules")
    shutil.copytree(harness.MODULES, modules, ignore=lambda _, names: [name for name in names if not name.endswith(".so")])
    with open(os.path.join(modules, f"{STOCK}.so"), "w", encoding="utf-8"):
        return modules


def judge(said, place, has_planner):
    """What LinuxCNC's script said of one test."""
    lines = [said]
    for name in ("result", "stderr"):
        lines += [f"{name}:", *text_of(os.path.join(place, name)).splitlines()[-60:]]
    failure = re.search(r"\*\*\* .*: XFAIL: (.*)", said)
    if failure:
        return Outcome(False, f"fails: {failure[1]}", "\n".join(lines))
    if "1 tests run, 1 successful" not in said:
        return Outcome(True, "skipped") if "1 skipped" in said else Outcome(False, "was not run", "\n".join(lines))
    return Outcome(True, "passes" if has_planner else "passes (no planner in it)")


def outcomes(linuxcnc, tests, scratch):
    """{(test, planner): Outcome}, each told as it comes."""
    found = {}
    with concurrent.futures.ThreadPoolExecutor(AT_A_TIME) as pool:
        running = {pool.submit(run_test, linuxcnc, test, planner, scratch): (test, planner)
                   for test in tests for planner in PLANNERS}
        for future in concurrent.futures.as_completed(running):
            test, planner = running[future]
            found[test, planner] = outcome = future.result()
            print(f"{test}, {planner}: {outcome.text}", file=sys.stderr, flush=True)
            if not outcome.passes:
                print(textwrap.indent(outcome.details, "    "), file=sys.stderr, flush=True)
    return found


def markdown(tests, found):
    yield "| suite | LinuxCNC's planner | blendtp |\n|---|---|---|"
    for test in tests:
        own, ours = (found[test, planner] for planner in PLANNERS)
        yield f"| {test} | {own.text} | {ours.text}{f': {why}' if (why := known(test, ours)) else ''} |"


def known(test, outcome):
    """Why a test fails, if it fails as it is known to."""
    says, why = KNOWN.get(test, ("", ""))
    return why if not outcome.passes and re.search(says, outcome.details) else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("source", help="the folder of LinuxCNC's source; where LinuxCNC was built in it, that one is run")
    parser.add_argument("suites", nargs="*", help="folders of its tests, as abort/g64 (default: all that move a machine)")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="framepath-suites.") as scratch:
        os.chmod(scratch, 0o755)
        linuxcnc = LinuxCNC(arguments.source, scratch)
        missing = [suite for suite in arguments.suites if not linuxcnc.tests(suite)]
        if missing:
            parser.error(f"{arguments.source}/tests has no tests in {', '.join(missing)}")
        tests = [test for suite in arguments.suites for test in linuxcnc.tests(suite)] or linuxcnc.tests_with_motion()
        found = outcomes(linuxcnc, tests, scratch)
    print("\n".join(markdown(tests, found)))
    worse = [test for test in tests if found[test, STOCK].passes and not found[test, OURS].passes
             and not known(test, found[test, OURS])]
    if worse:
        print(f"blendtp fails what LinuxCNC's planner passes: {', '.join(worse)}", file=sys.stderr)
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
