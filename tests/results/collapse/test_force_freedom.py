"""How unique forces are, against structures whose degree of indeterminacy is known and against ranges by programs."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.results.collapse.force_freedom import force_freedom, why_undetermined
from tests.line import BLOCK, HEAD, case_of, line_of, line_of_file, verified
from tests.results.no_contacts import without_contacts
from tests.results.synthetic import tower_contacts, tower_mechanics, tower_model

WALL = (
    HEAD
    + """\
joints: {dry: {friction: 0.65}}
blocks:
  - wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.2], length: 1.6, courses: 4}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
analysis: {flow_rule: associative, force_ranges: true}
"""
)
BEAM = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: pier, material: stone, min: [0, 0, 0], max: [1, 1, 2]}
  - box: {group: pier, material: stone, min: [4, 0, 0], max: [5, 1, 2]}
  - box: {group: beam, material: stone, min: [0, 0, 2], max: [5, 1, 3]}
  - box: {group: top, material: stone, min: [2, 0, 3], max: [3, 1, 3.5]}
supports: [{blocks: pier}]
load_cases:
  push: {live: [{force: [100, 0, 0], on: top}]}
analysis: {flow_rule: associative}
"""
)


def freedom(text: str, *overrides: str, dimension: int = 2) -> tuple[int, list[bool]]:
    line = line_of(text, *overrides)
    solution, _, _ = verified(line)
    assert solution.mechanics is not None
    found = force_freedom(line.model, line.contacts, solution.mechanics, dimension)
    assert found is not None
    return found.degree, found.determined.tolist()


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_block_on_one_face_is_determinate(dimension: int) -> None:
    assert freedom(BLOCK, dimension=dimension) == (0, [True])


def test_an_arch_of_four_hinges_is_determinate() -> None:
    line = line_of_file(Path("decks/tutorials/arch.yaml"))
    solution, _, _ = verified(line)
    assert solution.mechanics is not None
    found = force_freedom(line.model, line.contacts, solution.mechanics, 2)
    assert found is not None
    assert found.degree == 0
    assert found.determined.all()


def test_a_beam_on_two_piers_is_indeterminate_in_the_plane_to_the_third_degree() -> None:
    """Only the small block on top slides; the beam rests on two faces, 6 resultants against 3 equations."""
    degree, determined = freedom(BEAM)
    assert degree == 3
    assert sorted(determined) == [False, False, True]


@pytest.mark.parametrize("overrides", [(), ("units.length=mm",)])
def test_in_space_the_same_beam_has_twelve_resultants_against_six_equations(overrides: tuple[str, ...]) -> None:
    """Four corners of the top block that slide one way carry N and two moments: its own equations fix these."""
    degree, determined = freedom(BEAM, *overrides, dimension=3)
    assert sum(determined) == 1
    assert degree == 6


def test_interfaces_called_determined_have_no_range() -> None:
    """Each range is the answer of two programs; where they leave a width the resultant is not determined."""
    model, result = case_of(WALL)
    line = line_of(WALL)
    mechanics, ranges = result.solution.mechanics, result.solution.force_ranges
    assert mechanics is not None
    assert ranges is not None
    found = force_freedom(model, line.contacts, mechanics, 2)
    assert found is not None
    widths = ranges[:, 1] - ranges[:, 0]
    scale = float(np.abs(ranges[np.isfinite(ranges)]).max())
    assert widths[found.determined].max() <= 1e-5 * scale
    assert found.determined.any()
    assert not found.determined.all()
    assert found.degree > 0


def test_what_is_guided_or_without_contact_is_not_judged() -> None:
    line = line_of_file(Path("decks/benchmarks/closed_forms/guided_blocks.yaml"))
    solution, _, _ = verified(line)
    assert solution.mechanics is not None
    assert len(line.model.guides.blocks)
    assert force_freedom(line.model, line.contacts, solution.mechanics, 3) is None
    assert "guided" in why_undetermined(line.model, line.contacts, solution.mechanics, 3)


def test_what_is_too_large_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    line = line_of(BEAM)
    solution, _, _ = verified(line)
    assert solution.mechanics is not None
    monkeypatch.setattr("mbla.results.collapse.force_freedom.MOST_EQUATIONS", 2)
    moved = replace(line.model, title="another")  # what is kept of the model is not asked
    assert force_freedom(moved, line.contacts, solution.mechanics, 2) is None
    assert "more than 2 equations" in why_undetermined(moved, line.contacts, solution.mechanics, 2)


def test_without_contacts_there_is_nothing_to_determine() -> None:
    contacts = without_contacts(tower_contacts())
    assert force_freedom(tower_model(), contacts, tower_mechanics(), 3) is None
    assert why_undetermined(tower_model(), contacts, tower_mechanics(), 3) == "there are no contacts"
