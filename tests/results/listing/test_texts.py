"""Every text of listings and summaries in one file, ``texts.txt``; ``pytest --update`` writes it anew.

Sentences stand there and in no other test, so that one who mends the English reads all of them, and changes one file.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.assembly.assembly import Assembly
from mbla.codes.assess import assessment_of
from mbla.errors import Message
from mbla.model.applied_load import without_forces
from mbla.questions.angle import Angle
from mbla.questions.reaction import Reaction, Settlement
from mbla.questions.tilt import Tilt
from mbla.results.listing.history_words import path_words
from mbla.results.listing.listing import case_sections, listing, verification_lines
from mbla.results.listing.sections.model_words import check_listing
from mbla.results.listing.summary import summary_lines
from mbla.results.listing.text import WIDTH, lines_of, sentence
from mbla.results.provenance import CaseNeeds
from mbla.results.results import CaseResult, PathAgain, Results
from mbla.solution.solution import PathByStiffness, Standing, StandingResult, Status
from tests.results.synthetic import ASSESSED, PATH, full_results, tower_mechanics, tower_results

TEXTS = Path(__file__).with_name("texts.txt")
NAN = float("nan")
RESULTS, ASSOCIATIVE = tower_results(), tower_results("associative")
MODEL = RESULTS.model
SETTLEMENT = Settlement(np.array([0]), np.array([[0.0, 0, -1, 0, 0, 0]]), False, "settlement of base[0]", 30.0, 20.0)
TILT = Tilt(np.array([0.0, 1.0, 0.0]), np.zeros((3, 6)), np.zeros((3, 6)), np.zeros((3, 6)), NAN, True, np.inf)
IN_DOUBT = StandingResult(Standing.DOUBTFUL, 1, "no plateau")
BY_ITSELF = StandingResult(Standing.SELF_STRESS, 1, "the tower hangs between two walls")
FAILED = {"verified": False, "failures": (Message("yield-violation", "residual 0.1"),), "kinematic_bound": 0.4}
BY_PATH = {"elastic_residual": 1e-12, "penetration": NAN, "complementarity_residual": NAN, "power_balance": NAN}
NONE: dict[str, Any] = {"mechanics": None}


def case(
    status: Status = Status.SOLVED,
    *,
    of: Results = RESULTS,
    load: dict[str, Any] | None = None,
    checks: dict[str, Any] | None = None,
    **solution: Any,
) -> CaseResult:
    """The pushed tower with other values."""
    first = of.cases[0]
    return replace(
        first,
        status=status,
        load_case=replace(first.load_case, **(load or {})),
        solution=replace(first.solution, **solution),
        checks=replace(first.checks, **(checks or {})),
    )


OTHERS = PathByStiffness(0.2, 0.505), PathByStiffness(1.0, 0.495)
AGAIN = PathAgain("push_x", 1.0, 0.495, 0.4, 0.5, 0.01, 0.05, agrees=True)
AGAINS = {
    "agrees": AGAIN,
    "differs": replace(AGAIN, off=0.06, agrees=False),
    "approximate": replace(AGAIN, off=0.06),
    "lost": replace(AGAIN, load_factor=np.nan, agrees=False),
    "no limit": replace(AGAIN, load_factor=np.inf, off=np.inf, agrees=False),
}
RISES = Message("elastic-path-rises", "The load still rises")
CASES = {
    "another associative factor": case(associative=tower_mechanics(0.625)),
    "published": case(scheme="published"),
    "path that falls": case(checks=BY_PATH, path=PATH, path_end="falls", path_last=0.4),
    "path below associative flow": case(associative=tower_mechanics(0.625), checks=BY_PATH, path_end="flat"),
    "path that stays": case(checks=BY_PATH, path=PATH[:2], path_end="flat", path_last=0.5),
    "path that ends far out": case(checks=BY_PATH, path=PATH[:2], path_end="far", path_gain=0.02, path_last=0.5),
    "path that still rises": case(
        checks=BY_PATH, path=PATH[:2], path_end="far", path_gain=0.02, path_last=0.5, remarks=(RISES,)
    ),
    "path that is lost": case(Status.APPROXIMATE, checks=BY_PATH, path=PATH[:2], path_end="stuck", path_last=0.5),
    "path beside others": case(checks=BY_PATH, path_by_stiffness=OTHERS),
    "path beside one that was lost": case(checks=BY_PATH, path_by_stiffness=(OTHERS[0], PathByStiffness(1.0, np.nan))),
    "path in doubt": case(checks=BY_PATH, standing=IN_DOUBT, path=PATH, path_end="falls", path_last=0.4),
    "least a little lower": case(checks=BY_PATH | {"least_load_factor": 0.495}),
    "least far lower": case(checks=BY_PATH | {"least_load_factor": 0.45}),
    "least not verified": case(checks=BY_PATH, least=tower_mechanics(0.45)),
    "torsion": case(checks=BY_PATH | {"torsion_load_factor": 0.42}, torsion=tower_mechanics(0.42), torsion_end="flat"),
    "torsion, not followed to its end": case(
        checks=BY_PATH | {"torsion_load_factor": 0.42}, torsion=tower_mechanics(0.42), torsion_end="stuck"
    ),
    "torsion not verified": case(checks=BY_PATH, torsion=tower_mechanics(0.42), torsion_end="flat"),
    "torsion that does not carry the dead load": case(checks=BY_PATH, torsion_end="does not stand"),
    "torsion of which nothing is known": case(checks=BY_PATH, torsion_end="budget"),
    "remark": case(remarks=(Message("livesley-confirms", "That is confirmed"),)),
    "self-stress": case(standing=BY_ITSELF),
    "self-stress, associative": case(of=ASSOCIATIVE, standing=BY_ITSELF),
    "settlement": case(load={"question": Reaction(SETTLEMENT)}, checks=BY_PATH),
    "settlement, unbounded": case(Status.UNBOUNDED, load={"question": Reaction(SETTLEMENT)}, **NONE),
    "tilt": case(load={"question": Angle(TILT)}, associative=None),
    "tilt, unbounded": case(Status.UNBOUNDED, load={"question": Angle(TILT)}, **NONE),
    "tilt, unbounded, associative": case(Status.UNBOUNDED, of=ASSOCIATIVE, load={"question": Angle(TILT)}, **NONE),
    "force": case(load={"live": (without_forces("force (1, 0, 0) N on tower[0]"),)}),
    "approximate": case(Status.APPROXIMATE, reason="did not settle"),
    "assessment": case(of=ASSOCIATIVE, load={"assessment": ASSESSED}),
    "failed": case(Status.NOT_VERIFIED, checks=FAILED),
    "large residual": case(Status.NOT_VERIFIED, checks={"slip_residual": 0.1}),
    "no answer": case(Status.NOT_VERIFIED, **NONE),
    "lock not confirmed": case(Status.NOT_VERIFIED, lock=np.ones((8, 3)), **NONE),
    "fall not confirmed": case(Status.NOT_VERIFIED, certificate=np.ones((3, 6)), **NONE),
    "unbounded": case(Status.UNBOUNDED, **NONE),
    "unbounded, locked": case(Status.UNBOUNDED, of=ASSOCIATIVE, lock=np.ones((8, 3)), reason="locked", **NONE),
    "unbounded, dilatancy": case(Status.UNBOUNDED, flow_rule="dilatancy", **NONE),
    "time limit": case(Status.TIME_LIMIT),
    "time limit, no answer": case(Status.TIME_LIMIT, **NONE),
    "iteration limit": case(Status.ITERATION_LIMIT, **NONE),
    "numerical error": case(Status.NUMERICAL_ERROR, **NONE),
}
"""what a case may be, by what is special to it"""
SHOWN = ("Verdict", "Load factor and bounds", "Path of elastic joints", "Assessment", "Locking forces")
"""sections that say something else for it; what they share with the plain case is left out"""
NEEDS = {"push": CaseNeeds({"unknown_velocities": 12, "cones": 8})}
DIFFERS = ("push_x: static bound is 1 recomputed, the file says 2",)


def texts() -> Iterator[tuple[str, list[str]]]:
    """Titles and lines."""
    for name, results in (("tower", RESULTS), ("tower, associative", ASSOCIATIVE), ("everything", full_results())):
        yield f"listing: {name}", listing(results).splitlines()
        yield f"summary: {name}", summary_lines(results)
    yield "listing before a run", check_listing(replace(RESULTS, cases=()), NEEDS).splitlines()
    yield "verification agrees", verification_lines(RESULTS, ())
    yield "verification differs", verification_lines(RESULTS, DIFFERS)
    for name, path in AGAINS.items():
        yield f"path followed anew: {name}", sentence(path_words(MODEL, RESULTS.cases[0].load_case, path))
    plain = set(case_text(case()))
    for name, made in CASES.items():
        yield f"case: {name}", [line for line in case_text(made) if line not in plain]


def case_text(made: CaseResult) -> list[str]:
    """Sections of a case that say something else for it, and its summary."""
    assembly = Assembly(MODEL, RESULTS.contacts)
    made = replace(made, assessment=assessment_of(assembly, made))
    sections = case_sections(assembly, made)
    lines = [line for each in sections if each.title in SHOWN for line in lines_of(each.blocks)]
    return [*lines, "summary:", *summary_lines(replace(RESULTS, cases=(made,)))[2:]]


def test_texts(pytestconfig: pytest.Config) -> None:
    made = list(texts())
    assert all(len(line) <= WIDTH for _, lines in made for line in lines)
    assert not [line for _, lines in made for line in lines if " nan" in line or "None" in line]
    text = "".join(f"=== {title}\n{chr(10).join(lines)}\n\n" for title, lines in made)
    if pytestconfig.getoption("--update"):
        TEXTS.write_text(text, encoding="utf-8")
    assert text == TEXTS.read_text(encoding="utf-8"), "pytest --update writes texts.txt anew; read what changed"
