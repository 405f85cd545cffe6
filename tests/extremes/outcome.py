"""A scene with a known answer, and the verdict on what the program says of it.

Verdicts::

    right      solved and verified, and within the stated tolerance of the expected load factor; or, where there is
               none, one of the statuses or notices that the scene names
    diagnosed  not that, but a status, notice or error that the scene allows says so, in words; or the load factor is
               within what it is given with as the worth of rounding
    wrong      a load factor that is given out as a result is not the right one
    silent     no result, and nothing that names the cause
    warning    a warning of Python or a library reached the user
    crash      an exception that is none of the program's own, or the process died
    hang       nothing came within the time that the scene has

The last five are red lines.
"""

from __future__ import annotations

import io
import re
import time
import warnings
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from mbla.deck import read_deck
from mbla.errors import MblaError
from mbla.process.run_options import RunOptions
from mbla.results.findings import rounding_of
from mbla.results.listing.listing import listing
from mbla.results.listing.summary import summary_lines
from mbla.results.outcome import notices_of, result_of
from mbla.results.record.json_record import results_json
from mbla.results.record.json_values import json_line
from mbla.results.results import CaseResult, Results
from mbla.results.status_file import StatusFile
from mbla.run import solve_deck
from tests.limited import Hang, limited

GREEN = ("right", "diagnosed")
LIMIT, LONG_LIMIT = 20.0, 300.0
"""Seconds of the processor after which a scene counts as one that hangs."""


@dataclass(frozen=True)
class Scene:
    """One row of the table.

    name      : unique within its family, says the extreme value
    family    : heading under which it stands
    deck      : text of the deck, with one load case
    overrides : key.path=value texts, as for ``--set``
    expected  : load factor; None where there is none, ``diagnosis`` then being the right answer
    tolerance : of the load factor, relative; absolute where 0 is expected
    diagnosis : what may be said instead: statuses of the case, identifiers of notices, parts of an error's message
    long      : takes seconds, or minutes
    """

    name: str
    family: str
    deck: str
    overrides: tuple[str, ...] = ()
    expected: float | None = None
    tolerance: float = 1e-6
    diagnosis: tuple[str, ...] = ()
    long: bool = False


@dataclass(frozen=True)
class Outcome:
    """What came of a scene.

    got, static, kinematic : load factor given out as a result and its bounds, None where there are none
    status : of the load case; ``error`` where the program refused
    words  : what was said: status with its reason, notices, or the error
    """

    scene: Scene
    verdict: str
    got: float | None = None
    static: float | None = None
    kinematic: float | None = None
    status: str = "error"
    words: str = ""
    seconds: float = 0.0

    @property
    def is_red(self) -> bool:
        """Whether the program may not behave so."""
        return self.verdict not in GREEN


def outcome_of(scene: Scene) -> Outcome:
    """Run a scene as ``mbla run`` does, with listing, summary and JSON, and judge."""
    started = time.process_time()
    try:
        with warnings.catch_warnings(), limited(LONG_LIMIT if scene.long else LIMIT):
            warnings.simplefilter("error")
            outcome = _judged(scene, results_of(scene))
    except MblaError as error:
        outcome = _refused(scene, str(error))
    except Warning as warning:
        outcome = Outcome(scene, "warning", words=f"{type(warning).__name__}: {warning}")
    except Hang:
        outcome = Outcome(scene, "hang", words=f"nothing within {LONG_LIMIT if scene.long else LIMIT:g} s")
    except Exception as error:  # that is what is looked for
        outcome = Outcome(scene, "crash", words=f"{type(error).__name__}: {error}")
    seconds = time.process_time() - started
    return replace(outcome, seconds=seconds)


def results_of(scene: Scene) -> Results:
    """All that a run of the scene's deck gives, shown once in every form of text."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "scene.yaml"
        path.write_text(scene.deck, encoding="utf-8")
        started = time.perf_counter()
        deck = read_deck(path, scene.overrides)
        results = solve_deck(deck, RunOptions(), StatusFile(io.StringIO(), scene.name), None, started)
    for shown in (listing(results), *summary_lines(results), json_line(results_json(results))):
        assert shown.isprintable() or "\n" in shown
    return results


def _judged(scene: Scene, results: Results) -> Outcome:
    (case,) = results.cases
    mechanics, checks = result_of(case), case.checks
    got = None if mechanics is None else mechanics.load_factor
    notices = notices_of(results)
    said = [str(case.status), *(notice.identifier for notice in notices)]
    named = [word for word in said if word in scene.diagnosis]
    if got is not None and scene.expected is not None and abs(got - scene.expected) <= rounding_of(results.model, case):
        named.append("load-factor-rounding")
    words = f"{case.status}: {case.solution.reason}" if case.solution.reason else str(case.status)
    shown = [notice.message for notice in notices if notice.identifier in named]
    return Outcome(
        scene,
        _verdict(scene, case, got, named),
        got,
        _number(checks.static_bound),
        _number(checks.kinematic_bound),
        str(case.status),
        "; ".join([words, *shown]),
    )


def _verdict(scene: Scene, case: CaseResult, got: float | None, named: list[str]) -> str:
    if scene.expected is None:
        return "right" if named else "silent" if got is None else "wrong"
    if got is not None and case.status == "solved":
        unit = abs(scene.expected) or 1.0
        if abs(got - scene.expected) <= scene.tolerance * unit:
            return "right"
    return "diagnosed" if named else "silent" if got is None else "wrong"


def _refused(scene: Scene, message: str) -> Outcome:
    message = re.sub(r"\S*/scene\.yaml", "scene.yaml", message)
    named = any(words in message for words in scene.diagnosis)
    verdict = "silent" if not named else "right" if scene.expected is None else "diagnosed"
    return Outcome(scene, verdict, words=message)


def _number(value: float) -> float | None:
    return value if value == value else None
