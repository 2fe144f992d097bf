"""In which order pytest runs the tests of this folder, a few at a time: each LinuxCNC has a world of its own and mostly
waits."""

import inspect
import os
import unittest

import pytest
from _pytest.runner import runtestprotocol

from overload import ATTEMPTS, is_overloaded

#: Files whose tests are marked as busy, the longest first.
BUSY = ("test_contract_soak", "test_contract_table", "test_faults_table", "test_short_programs", "test_compare",
        "test_preview_speed", "test_plan")
#: What takes longest comes first, or the others would wait for it at the end.
FIRST = ("test_dialect_examples", "test_spindle", "test_preview", "test_preview_axis", "test_preview_screens",
         "test_look_ahead")


#: What is about the LinuxCNC that is installed, and its modules: left out where the others run in another one.
OF_THE_INSTALLED = ("test_packages.py", "test_right_module.py")
IN_PLACE = os.environ.get("LINUXCNC_IN_PLACE")

collect_ignore = list(OF_THE_INSTALLED) if IN_PLACE else []


def pytest_report_header():
    """What is said before the tests."""
    return f"in the LinuxCNC of {IN_PLACE}, without {', '.join(OF_THE_INSTALLED)}" if IN_PLACE else ""


def is_set_up_once(item):
    """Whether the tests of the class share what they set up."""
    return any("setUpClass" in vars(kind) for kind in item.cls.__mro__ if kind is not unittest.TestCase)


# Before xdist looks at the groups.
@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    def place(item):
        stem = item.path.stem
        if stem in BUSY:
            return BUSY.index(stem), 0
        return len(BUSY) + (stem not in FIRST), -os.path.getsize(item.path)

    for item in items:
        # pytest calls whatever has the name of a test, and a mark that was given a lambda passes
        if not inspect.isroutine(item.obj):
            raise pytest.UsageError(f"{item.nodeid} is no function, and would run nothing: {item.obj!r}")
        if item.path.stem in BUSY:
            item.add_marker(pytest.mark.busy)
        if is_set_up_once(item):
            item.add_marker(pytest.mark.xdist_group(f"{item.path.stem}.{item.cls.__name__}"))
    # a stable sort: what belongs together stays so
    items.sort(key=place)


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_protocol(item, nextitem):
    """Runs a test again that fails on an overloaded computer, with all that its class sets up."""
    item.ihook.pytest_runtest_logstart(nodeid=item.nodeid, location=item.location)
    for attempt in range(1, ATTEMPTS + 1):
        reports = runtestprotocol(item, nextitem=nextitem, log=False)
        failures = [report.longreprtext for report in reports if report.failed]
        if not failures or attempt == ATTEMPTS or not is_overloaded():
            break
        item.user_properties.append(("failed on an overloaded computer", failures[0]))
        item.session._setupstate.teardown_exact(None)
    for report in reports:
        item.ihook.pytest_runtest_logreport(report=report)
    item.ihook.pytest_runtest_logfinish(nodeid=item.nodeid, location=item.location)
    return True


def pytest_terminal_summary(terminalreporter):
    """What failed at first, and how."""
    for report in terminalreporter.stats.get("passed", []):
        for name, failure in report.user_properties if report.when == "call" else []:
            terminalreporter.section(f"{report.nodeid} {name}, and was run again")
            terminalreporter.line("\n".join(line for line in failure.splitlines() if line.startswith("E "))[:2000])
