from __future__ import annotations

import pytest

from tests.decks.centre_line_arches import CASES, FOLDER, Case, deck_text


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_the_decks_are_those_that_the_generator_writes(case: Case) -> None:
    written = (FOLDER / f"{case.name}.yaml").read_text(encoding="utf-8")
    assert written == deck_text(case), "python -m tests.decks.centre_line_arches writes them again"


def test_every_deck_of_the_arch_is_generated() -> None:
    assert {path.stem for path in FOLDER.glob("cocchetti_rizzi_*.yaml")} == {case.name for case in CASES}
