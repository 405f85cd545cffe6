"""``mbla verify`` of files with ties: it agrees with what a run wrote, and with nothing else."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.assembly.rigid_bodies import rigid_bodies
from mbla.errors import FileError
from mbla.results.collapse.rigid_parts import rigid_parts
from mbla.verify import verify_file
from tests.analytic.test_ties import SLENDER
from tests.line import HEAD
from tests.results.changed_files import changing, image_of_run

DECK = SLENDER.replace("flow_rule: associative", "flow_rule: non_associative, standing: true").replace(
    'capacity: "=T"', 'capacity: "=T", prestress: 500'
)


@pytest.fixture(scope="module")
def image(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return image_of_run(tmp_path_factory.mktemp("ties"), DECK)


@pytest.fixture
def path(tmp_path: Path, image: bytes) -> Path:
    path = tmp_path / "deck.h5"
    path.write_bytes(image)
    return path


def test_a_file_as_it_was_written_agrees(path: Path) -> None:
    results, disagreements = verify_file(path)
    assert (disagreements, results.exit_code) == ((), 0)


@pytest.mark.every(2)
@pytest.mark.parametrize(
    ("name", "factor"),
    [
        ("model/tie_greatest", 1.1),
        ("model/tie_prestress", 0.5),
        ("model/tie_places", 1.01),
        ("cases/push/tie_forces", 0.99),
        ("cases/push/tie_rates", 1.01),
        ("cases/push/standing/contact_forces", 1.01),
    ],
)
def test_a_change_of_what_a_tie_is_or_does_is_found(path: Path, name: str, factor: float) -> None:
    with changing(path) as file:
        file[name][...] = file[name][()] * factor
    _, disagreements = verify_file(path)
    assert disagreements


def test_a_greater_load_factor_with_a_greater_force_of_the_tie_is_not_believed(path: Path) -> None:
    """Forces and factor fit each other and the blocks; the tie has more than its capacity, and the deck says so."""
    with changing(path) as file:
        case = file["cases/push"]
        case["tie_forces"][...] = 3300.0
        case["load_factor"][...] = case["load_factor"][()] + 300 * 1.6 / (0.4 * 2 * 2000 * 9.81)
    results, disagreements = verify_file(path)
    assert disagreements
    assert not results.cases[0].checks.verified


@pytest.mark.parametrize("name", ["model/tie_bodies", "model/tie_start", "model/tie_least"])
def test_ties_that_are_none_are_told(path: Path, name: str) -> None:
    with changing(path) as file:
        file[name][...] = np.asarray(file[name][()]) + 100000
    assert verify_file(path)[1] == (f"{name} is not what the deck in the file gives",)


def test_forces_of_another_number_of_ties_are_refused_or_told(path: Path) -> None:
    with changing(path) as file:
        place = file["cases/push/standing"]
        values, attributes = place["contact_forces"][()], dict(place["contact_forces"].attrs)
        del place["contact_forces"]
        made = place.create_dataset("contact_forces", data=values[:-1])
        for key in ("units", "description"):
            if key in attributes:
                made.attrs[key] = attributes[key]
    with pytest.raises(FileError):
        verify_file(path)


GUIDED = (
    HEAD.replace("{joint: dry}", "{joint: dry, isolated: allow}")
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: sledge, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: load, material: stone, min: [0, 0, 1], max: [1, 1, 2]}
supports: [{blocks: sledge, slide: [1, 0, 0]}]
ties: [{name: rope, through: [[0, 0.5, 0.5], [-3, 0.5, 0.5]], on: [sledge, ground], capacity: 2000}]
load_cases:
  pulled: {live: [{force: [1000, 0, 0], on: sledge}]}
  held: {live: [{force: [1000, 0, 0], on: sledge}], at: 1.5, objective: {tie: rope}}
analysis: {flow_rule: associative}
"""
)


def test_what_moves_together_does_so_whatever_rounding_says(tmp_path: Path) -> None:
    """The rope alone gets longer; in the load cases for its force nothing moves but what measures it."""
    (tmp_path / "deck.h5").write_bytes(image_of_run(tmp_path, GUIDED))
    results, disagreements = verify_file(tmp_path / "deck.h5")
    assert disagreements == ()
    pulled = results.case("pulled")
    assert pulled.solution.mechanics is not None
    parts = rigid_parts(
        results.model, rigid_bodies(results.model, results.contacts), pulled.solution.mechanics.mechanism
    )
    assert parts.tolist() == [1, 1]
