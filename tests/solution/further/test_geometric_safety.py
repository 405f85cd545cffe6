"""The geometric factor of safety: closed forms, its proof, what has none, and what result files keep of it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import mbla
from mbla.assembly.assembly import Assembly
from mbla.results.hdf5.result_file import read_results_hdf5, write_results_hdf5
from mbla.results.listing.sections.geometric_safety import geometric_safety_blocks
from mbla.results.listing.text import lines_of
from mbla.results.outcome import case_notices
from mbla.results.results import CaseResult
from mbla.solution.further.further import Further
from mbla.solution.further.geometric_safety.geometric_safety import GeometricSafety
from mbla.solution.solution import Status
from mbla.solution.verification.geometric_safety import proved
from mbla.verify import verify_file
from tests.analytic.test_least_thickness import deck_text
from tests.decks.folder import ROOT
from tests.line import BLOCK, case_of, cases_of

NEAR = 2e-6
SAFE = BLOCK.replace("flow_rule: associative", "flow_rule: associative, geometric_safety: true")
LEANING = SAFE.replace("live:", "dead: [{gravity: [1, 0, -9.81]}], live:")
STACK = LEANING.replace(
    "supports:", '  - box: {group: top, material: stone, min: [0, 0, "=h"], max: ["=b", 1, "=2*h"]}\nsupports:'
)


def safety_of(text: str, *overrides: str) -> GeometricSafety:
    """Of a deck that has one."""
    _, case = case_of(text, *overrides)
    assert case.solution.further.geometric_safety is not None
    return case.solution.further.geometric_safety


def test_block_under_a_leaning_gravity() -> None:
    """Its weight passes h/2 tan α from the middle of its base of width b: factor b/(h tan α)."""
    found = safety_of(LEANING)
    assert found.factor == pytest.approx(9.81 / 2, rel=NEAR)
    assert found.factor < 9.81 / 2 < found.most
    assert found.verified
    assert found.solves <= 6


def test_block_of_a_deck_under_tilted_gravity() -> None:
    text = (ROOT / "decks/benchmarks/closed_forms/incline_tilted_gravity.yaml").read_text(encoding="utf-8")
    assert safety_of(text).factor == pytest.approx(1.0 / (0.2 * math.tan(math.radians(15))), rel=NEAR)


def test_stack_under_a_leaning_gravity() -> None:
    """The joint at its foot decides, with twice the height."""
    assert safety_of(STACK).factor == pytest.approx(9.81 / 4, rel=NEAR)


@pytest.mark.parametrize(("thickness", "least"), [(0.12, 0.10742599), (0.15, 0.10742599)])
def test_arch_with_its_weight_on_the_centre_line(thickness: float, least: float) -> None:
    """Its thickness over the least one."""
    text = deck_text(thickness, 86, 0.7).replace("flow_rule:", "geometric_safety: true, flow_rule:")
    found = safety_of(text)
    assert found.factor == pytest.approx(thickness / least, rel=2 * NEAR)
    assert found.verified
    assert found.solves <= 6


def test_an_arch_that_falls_has_less_than_1() -> None:
    text = deck_text(0.1, 86, 0.7).replace("flow_rule:", "geometric_safety: true, flow_rule:")
    _, case = case_of(text)
    assert case.status is Status.NO_EQUILIBRIUM
    found = case.solution.further.geometric_safety
    assert found is not None
    assert found.factor == pytest.approx(0.1 / 0.10742599, rel=2 * NEAR)
    assert found.verified


def test_a_block_on_its_middle_stands_on_a_point() -> None:
    found = safety_of(SAFE)
    assert found.factor == pytest.approx(1000.0)
    assert found.most == np.inf
    assert found.verified


def test_what_stands_on_its_middles_or_by_self_stress_is_not_called_safe() -> None:
    """A block on the ground; one between two others that only a thrust that nothing causes would hold."""
    _, upright = case_of(SAFE)
    assert "size is no measure of safety" in " ".join(" ".join(lines_of(geometric_safety_blocks(upright))).split())
    between = SAFE.replace("min: [0, 0, 0]", "min: [0, 0, 1]").replace(
        "joints: {", "joints: {ground: {friction: 0.7}, "
    )
    between = between.replace(
        "supports: [{ground: {z: 0}}]",
        """  - box: {group: left, material: stone, min: [-1, 0, 0], max: [0, 1, 2]}
  - box: {group: right, material: stone, min: [1, 0, 0], max: [2, 1, 2]}
supports: [{ground: {z: 0}, joint: ground}]""",
    )
    _, jammed = case_of(between)
    assert "It is no safety: from the stress-free" in " ".join(
        " ".join(lines_of(geometric_safety_blocks(jammed))).split()
    )
    assert any("its geometric factor is no safety" in each.message for each in case_notices(jammed))


def test_units_do_not_matter() -> None:
    small = LEANING.replace("mbla: 1", "mbla: 1\nunits: {length: mm}").replace("density: 2000", "density: 2.e-6")
    small = small.replace("b: 1, h: 2", "b: 1000, h: 2000").replace(
        '[0, 0, 0], max: ["=b", 1,', '[0, 0, 0], max: ["=b", 1000,'
    )
    small = small.replace("[1, 0, -9.81]", "[1000, 0, -9810]")
    assert safety_of(small).factor == pytest.approx(safety_of(LEANING).factor, rel=1e-8)


@pytest.mark.parametrize(
    ("text", "overrides", "words"),
    [
        (LEANING.replace("[1, 0, -9.81]", "[6, 0, -9.81]"), ("parameters.h=1",), "at no size of the joints"),
        (SAFE.replace("friction:", "compressive_strength: 1.e6, friction:"), (), "compressive strength"),
        (SAFE.replace("live:", "dead: [{gravity: none}], live:"), (), "no dead load"),
    ],
)
def test_what_has_none_says_so(text: str, overrides: tuple[str, ...], words: str) -> None:
    _, case = case_of(text, *overrides)
    assert case.solution.further.geometric_safety is None
    said = [each.words for each in case.solution.remarks if each.identifier == "geometric-safety-not-done"]
    assert len(said) == 1
    assert words in said[0]


@pytest.fixture(scope="module")
def leaning() -> tuple[Assembly, CaseResult]:
    assembly, (case,) = cases_of(LEANING)
    return assembly, case


def test_a_factor_that_is_too_large_is_not_proved(leaning: tuple[Assembly, CaseResult]) -> None:
    assembly, case = leaning
    found = case.solution.further.geometric_safety
    assert found is not None
    assert proved(assembly, case.load_case, found)
    assert not proved(assembly, case.load_case, replace(found, sizes=0.999 * found.sizes))
    assert not proved(assembly, case.load_case, replace(found, sizes=1.001 * found.sizes))
    assert not proved(assembly, case.load_case, replace(found, forces=1.001 * found.forces, sizes=found.sizes - 1e-3))


@pytest.mark.parametrize(
    "forged",
    [
        lambda found: replace(found, sizes=found.sizes * [2.0, 1.0]),
        lambda found: replace(found, pressed=found.pressed + 1.0),
        lambda found: replace(found, load_factors=3.0 * found.load_factors),
        lambda found: replace(found, load_factors=np.nan * found.load_factors),
        lambda found: replace(
            found,
            **{name: getattr(found, name)[:1] for name in ("sizes", "pressed", "load_factors", "forces", "mechanisms")},
        ),
    ],
    ids=["ends far apart", "pressed", "load factors", "no load factors", "no end that falls"],
)
def test_what_does_not_belong_to_its_proof_is_not_proved(
    forged: Callable[[GeometricSafety], GeometricSafety], leaning: tuple[Assembly, CaseResult]
) -> None:
    assembly, case = leaning
    found = case.solution.further.geometric_safety
    assert found is not None
    assert not proved(assembly, case.load_case, forged(found))


def test_result_files_keep_it_and_verify_proves_it_again(tmp_path: Path) -> None:
    deck = tmp_path / "leaning.yaml"
    deck.write_text(LEANING.replace("geometric_safety: true", "geometric_safety: true, sensitivity: true"), "utf-8")
    mbla.run(str(deck), output=tmp_path / "out")
    path = tmp_path / "out" / "leaning.h5"
    _, disagreements = verify_file(path)
    assert disagreements == ()
    results = read_results_hdf5(path)
    (case,) = results.cases
    safety = case.solution.further.geometric_safety
    assert safety is not None
    bold = replace(safety, sizes=0.9 * safety.sizes)
    first, *others = case.solution.further.sensitivity
    changed = Further(sensitivity=(replace(first, slope=1.0), *others), geometric_safety=bold)
    path.write_bytes(write_results_hdf5(replace(results, cases=(case.with_further(changed, ()),))))
    _, disagreements = verify_file(path)
    assert any("geometric_safety/verified" in each for each in disagreements)
    assert any("sensitivity/slope" in each for each in disagreements)
