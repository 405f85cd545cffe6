"""Figures of the path are verified by the law of elastic joints, and a history that is none is found."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.solution.solution import Status
from mbla.verify import verify_file
from tests.analytic.test_ties import SLENDER
from tests.line import BLOCK, WALL
from tests.results.changed_files import changing, image_of_run

WITHOUT = "flow_rule: non_associative"
DECKS = {
    "slides": (BLOCK.replace("flow_rule: associative", WITHOUT).replace("h: 2", "h: 1"), 0.5),
    "rocks with a tie": (SLENDER.replace("flow_rule: associative", WITHOUT), None),
    "wall": (WALL.replace("flow_rule: associative", WITHOUT).replace("n: 5", "n: 4"), None),
}
"""decks, and the load factor of statics where it is simple"""


@pytest.fixture(scope="module", params=DECKS)
def image(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[bytes, float | None]:
    deck, expected = DECKS[request.param]
    return image_of_run(tmp_path_factory.mktemp("elastic"), deck), expected


def test_the_state_is_solved_and_verified_by_its_own_law(image: tuple[bytes, float | None], tmp_path: Path) -> None:
    path = tmp_path / "deck.h5"
    path.write_bytes(image[0])
    results, disagreements = verify_file(path)
    (case,) = results.cases
    assert (disagreements, case.status) == ((), Status.SOLVED)
    assert case.checks.elastic_residual < 2e-6
    assert case.checks.penetration != case.checks.penetration  # of rigid joints
    assert case.solution.mechanics is not None
    assert case.solution.associative is not None
    assert case.solution.mechanics.load_factor <= case.solution.associative.load_factor * (1.0 + 1e-6)
    if image[1] is not None:
        assert case.solution.mechanics.load_factor == pytest.approx(image[1], rel=1e-5)


@pytest.fixture(scope="module")
def tied(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return image_of_run(tmp_path_factory.mktemp("tied"), DECKS["rocks with a tie"][0])


@pytest.mark.parametrize("name", ["remembered", "stiffness", "mechanism", "contact_forces"])
def test_another_history_or_motion_is_not_believed(name: str, tied: bytes, tmp_path: Path) -> None:
    path = tmp_path / "deck.h5"
    path.write_bytes(tied)
    with changing(path) as file:
        place = file["cases/push"]
        uneven = np.linspace(1.0, 1.1, len(place[name]))[:, None] if name == "stiffness" else 1.1
        place[name][...] = uneven * place[name][()]
    results, disagreements = verify_file(path)
    assert disagreements
    assert results.cases[0].status is not Status.SOLVED


def test_a_file_without_history_is_not_agreed_with(tied: bytes, tmp_path: Path) -> None:
    path = tmp_path / "deck.h5"
    path.write_bytes(tied)
    with changing(path) as file:
        for name in ("remembered", "stiffness", "tie_remembered", "tie_stiffness"):
            file["cases/push"].pop(name, None)
    _, disagreements = verify_file(path)
    assert any("history of elastic joints" in words for words in disagreements)
