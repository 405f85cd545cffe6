"""What tests of several folders share: examples drawn at random without a limit of time, interruptions, a browser, and
a line at the end that says whether there was one."""

from __future__ import annotations

import gc
import signal
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

from tests.browser import ARGUMENTS, CHROMIUM, PATIENCE

# A machine whose processors are busy elsewhere is no fault of what is tested: 7 ms took 265 ms on one, and failed.
settings.register_profile("untimed", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("untimed")

gc.disable()  # until all tests are collected, what grows is kept

LONG_AS_A_WHOLE = "\npytestmark = pytest.mark.long\n"
"""a line of such a file"""


def pytest_addoption(parser: pytest.Parser) -> None:
    """``--update`` writes texts that tests compare with anew."""
    parser.addoption("--update", action="store_true", help="write texts that tests compare with anew")


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Where short tests are asked for, what is long as a whole is not even read, nor are the scenes of ``extremes``.

    A fifth of what reads all files takes, in every process.
    """
    asked = set(config.getoption("markexpr").split(" and "))
    if "not long" not in asked or not collection_path.name.startswith("test_") or collection_path.suffix != ".py":
        return None
    if collection_path.name == "test_extremes.py":
        return True if "not trust" in asked else None
    return True if LONG_AS_A_WHOLE in collection_path.read_text(encoding="utf-8") else None


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """``every(n)``: of the examples of a test each n-th, from the first on, is short; the others are long."""
    seen: Counter[str] = Counter()
    for item in items:
        mark = item.get_closest_marker("every")
        if mark is not None:
            name = item.nodeid.partition("[")[0]
            if seen[name] % mark.args[0]:
                item.add_marker(pytest.mark.long)
            seen[name] += 1


def pytest_collection_finish() -> None:
    """What all tests share is looked through for garbage no more: thousands of functions and their syntax trees."""
    gc.collect()
    gc.freeze()
    gc.enable()


@pytest.fixture(scope="session", autouse=True)
def interruptible() -> Iterator[None]:
    """SIGINT interrupts, here and in processes that tests start: a shell begins jobs in the background without it."""
    earlier = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, earlier)


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """A headless browser; tests that want one are skipped where there is none."""
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if CHROMIUM is None:
        pytest.skip("this machine has no browser: no chromium, and MBLA_BROWSER names none")
    with playwright.sync_playwright() as driver:
        found = driver.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS, timeout=PATIENCE)
        yield found
        found.close()


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Remember which tests want a browser."""
    if "browser" in getattr(item, "fixturenames", ()):
        item.user_properties.append(("browser", CHROMIUM or "none"))


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """``tests in a browser: 8 passed (/usr/bin/chromium)``, where any were asked for."""
    counts = {
        outcome: sum(
            any(name == "browser" for name, _ in getattr(report, "user_properties", ()))
            and (report.when == "call" or not report.passed)
            for report in terminalreporter.stats.get(outcome, [])
        )
        for outcome in ("passed", "failed", "error", "skipped")
    }
    if any(counts.values()):
        shown = ", ".join(f"{count} {outcome}" for outcome, count in counts.items() if count)
        terminalreporter.write_line(f"tests in a browser: {shown} ({CHROMIUM or 'this machine has none'})")
