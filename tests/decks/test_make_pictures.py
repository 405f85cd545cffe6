"""Every picture beside the decks is made by the table, of a load case that its deck has."""

from pathlib import Path

import pytest

from mbla.deck import read_deck
from tests.decks.folder import DECKS
from tests.decks.make_pictures import (
    EXPERIMENTS,
    PICTURES,
    SAMPLE,
    STUDIES,
    SWEEPS,
    TABLE,
    DeckPicture,
    deck_path,
    readme_block,
)


def test_table_names_every_picture_once() -> None:
    of_sweeps = [f"sweep_{picture.sweep}" for picture in SWEEPS]
    names = [*(picture.name for picture in TABLE), *STUDIES, EXPERIMENTS, *of_sweeps]
    assert sorted(names) == sorted(set(names))
    assert set(names) == {path.stem for path in PICTURES.iterdir()}


@pytest.mark.parametrize("picture", TABLE, ids=lambda picture: picture.name)
def test_deck_has_the_load_case(picture: DeckPicture, tmp_path: Path) -> None:
    deck = read_deck(deck_path(picture, tmp_path))
    assert picture.case in deck.content.load_cases


def test_the_sweep_of_the_readme_has_the_sample_that_its_picture_enlarges() -> None:
    assert readme_block("`door.yaml`, next to", DECKS / "sweeps" / "README.md").count(SAMPLE[0]) == 1
