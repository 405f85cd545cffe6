"""Every picture beside the decks is made by the table, of a load case that its deck has."""

from pathlib import Path

import pytest

from mbla.deck import read_deck
from tests.decks.make_pictures import PICTURES, TABLE, DeckPicture, deck_path, make_pictures


def test_table_names_every_picture_once() -> None:
    names = [picture.name for picture in TABLE]
    assert sorted(names) == sorted(set(names))
    assert set(names) == {path.stem for path in PICTURES.iterdir()}


@pytest.mark.parametrize("picture", TABLE, ids=lambda picture: picture.name)
def test_deck_has_the_load_case(picture: DeckPicture, tmp_path: Path) -> None:
    deck = read_deck(deck_path(picture, tmp_path))
    assert picture.case in deck.content.load_cases


def test_unknown_names_are_refused() -> None:
    with pytest.raises(SystemExit, match="no picture wall"):
        make_pictures(["wall"])
