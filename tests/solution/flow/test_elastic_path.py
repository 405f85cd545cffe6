"""The greatest load on the path of elastic joints: closed forms, published walls, associative flow, invariance."""

from __future__ import annotations

import json
import math

import pytest

from mbla.solution.flow.path_record import Stop
from mbla.solution.flow.settings import PathSettings
from tests.decks.folder import BENCHMARKS, PATHS
from tests.line import BLOCK, Line, line_of, line_of_file
from tests.reached import reaches
from tests.solution.flow.paths import case_of, load_factor_of, path_of
from tests.solution.nonassociative.structures import FERRIS_1, FERRIS_3
from tests.trust.certificates.assemblies import assembly

CLOSE = 1e-5
"""Relative: what is left of the smoothing at the peak."""

DECK = {path.stem: path for path in PATHS}

COLUMNS = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 2], repeat: {count: 2, translate: [0, 0, 2]}}
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""


@pytest.mark.parametrize(
    ("overrides", "expected"),
    [
        (("parameters.mu=0.4",), 0.4),
        (("parameters.mu=0.6",), 0.5),
        (("parameters.mu=0.2", "parameters.c=1000"), 0.2 + 1000.0 / (2000 * 9.81 * 2)),
    ],
    ids=["slides", "rocks", "cohesion"],
)
def test_a_block(overrides: tuple[str, ...], expected: float) -> None:
    assert load_factor_of(line_of(BLOCK, *overrides)) == pytest.approx(expected, rel=CLOSE)


@pytest.mark.parametrize(
    ("name", "case", "expected"),
    [
        ("mortar_joint", 1, 1.5096839959225279),
        ("mortar_joint", 2, 0.7548419979612639),
        ("leaning_block", 0, 0.25751072961373395),
        ("guided_blocks", 2, 1.0),
        ("arch_20_voussoirs", 0, 0.14935017),
        ("eccentric_compression_spacing", 0, 0.45538),
    ],
)
def test_closed_forms(name: str, case: int, expected: float) -> None:
    line = line_of_file(BENCHMARKS[name], case=case)
    assert load_factor_of(line) == pytest.approx(expected, rel=2.0 * CLOSE)


@pytest.mark.parametrize(("deck", "published"), [(FERRIS_1, 0.640), (FERRIS_3, 0.356)])
def test_walls_of_ferris_and_tin_loi(deck: str, published: float) -> None:
    """doi:10.1016/S0020-7403(99)00111-3; rigid blocks in time come to .6396 to .6413 and .3553 to .3563."""
    assert load_factor_of(line_of(deck)) == pytest.approx(published, rel=3e-3)


def test_with_associative_flow_it_is_the_associative_load_factor() -> None:
    line = line_of(FERRIS_3, "analysis.flow_rule=associative")
    assert load_factor_of(line, associative_flow=True) == pytest.approx(0.403694, rel=3e-4)  # at D = 50 it still rises


@pytest.mark.parametrize("ratio", [0.2, 1.0])
def test_the_stiffness_does_not_count_where_the_load_factor_is_unique(ratio: float) -> None:
    assert load_factor_of(line_of(COLUMNS), PathSettings(ratio=ratio)) == pytest.approx(0.25, rel=CLOSE)


def _forms() -> list[Line]:
    lengths = COLUMNS.replace("[1, 1, 2]", "[1e3, 1e3, 2e3]").replace("[0, 0, 2]", "[0, 0, 2e3]")
    return [line_of(deck) for deck in (FERRIS_3, FERRIS_3.replace("[1, 0, 0]", "[-1, 0, 0]"))] + [line_of(lengths)]


def test_mirrors_and_units() -> None:
    wall, mirrored, column = (load_factor_of(line) for line in _forms())
    assert mirrored == pytest.approx(wall, rel=1e-4)
    assert column == pytest.approx(0.25, rel=CLOSE)


def test_a_path_ends_as_far_as_it_is_told() -> None:
    found = path_of(line_of(BLOCK), PathSettings(until=5.0))
    assert found.path is not None
    assert found.stop is Stop.FAR
    assert found.path.displacement == pytest.approx(5.0)
    assert math.isclose(found.gain, 0.0, abs_tol=1e-3)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (PathSettings(ratio=0.01), "ratio"),
        (PathSettings(until=2000.0), "end of the path"),
        (PathSettings(growth=1.0), "steps"),
        (PathSettings(most_smoothing=0.0), "smoothing"),
        (PathSettings(settled=0.0), "flat"),
        (PathSettings(falling=(0, 1.02, 1.001)), "fall"),
        (PathSettings(near=(1e-6, 8)), "near the peak"),
        (PathSettings(spent=(100, 500)), "solved steps"),
        (PathSettings(measures=0), "counts"),
    ],
)
def test_settings_that_lead_nowhere_are_refused(wrong: PathSettings, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        wrong.validate()


@pytest.mark.parametrize(
    ("deck", "name", "first", "expected"),
    [("filled_bridge", "lorry@05", 0.1, 6.71), ("settling_wall", "sinks", 0.4, 0.2716)],
)
@pytest.mark.long
def test_a_path_that_was_blocked_comes_back(deck: str, name: str, first: float, expected: float) -> None:
    """It lies low for some steps: with another first step that was taken for a fall, or for the end.

    That of the bridge still rises where it ends, by 2 % over its last half.
    """
    case = case_of(DECK[deck], name)
    found = case.path(PathSettings(first=first))
    assert found.is_answer
    assert case.loaded.scaling.load_factor(found.load_factor) == pytest.approx(expected, rel=1e-2)


@pytest.mark.long
def test_a_path_that_is_blocked_with_its_peak_behind_it_has_its_answer() -> None:
    """A dome on its drum snaps at D = 45, after 0.4135 at D = 41; other smoothing finds 0.4132 to 0.4140."""
    case = case_of(DECK["dome_on_drum"], "push_x")
    found = case.path()
    assert found.is_answer
    assert case.loaded.scaling.load_factor(found.load_factor) == pytest.approx(0.4135, rel=2e-3)


def test_where_smoothing_is_more_than_the_load_every_step_is_solved() -> None:
    """A block on a slope that friction just holds: the path that is smoothed stays below zero."""
    found = case_of(DECK["incline_too_steep"], "flat_enough").path()
    assert found.paths == 2
    flat = math.atan(0.999 * 0.5)
    assert reaches(found.load_factor, 0.5 * math.cos(flat) - math.sin(flat))


def test_a_state_that_fits_the_law_counts_before_a_greater_load_that_does_not() -> None:
    """A random arch whose path breaks down at 0.7268, off the law by a twentieth; solved steps come to 0.6809."""
    found = case_of(json.dumps(assembly(546)), "collapse").path()
    assert not found.is_answer
    assert found.path is not None
    assert found.path.peak is not None
    assert found.path.peak.misfit < 1e-4
    assert found.load_factor == pytest.approx(0.681, rel=0.02)
