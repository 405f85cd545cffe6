from __future__ import annotations

from mbla.deck.content import DeckContent
from mbla.deck.fields import allowed_keys, annotations_at, description, takes_names
from mbla.deck.quantities import PositiveLength, PositiveNumber


def test_keys_along_a_path() -> None:
    assert allowed_keys(DeckContent, ("units",)) == ["length", "force", "mass"]
    assert allowed_keys(DeckContent, ("blocks", 3, "wall", "openings", 0)) == ["from", "to", "lintel", "arch"]
    assert allowed_keys(DeckContent, ("supports", 0, "blocks", 2))[:4] == ["group", "box", "index", "member"]
    assert allowed_keys(DeckContent, ("blocks", 0, "box", "transform", "rotate")) == ["axis", "angle", "about"]
    assert allowed_keys(DeckContent, ("joints", "dry"))[0] == "friction"


def test_no_keys_where_names_are_free_or_nothing_is() -> None:
    assert allowed_keys(DeckContent, ("joints",)) == []
    assert allowed_keys(DeckContent, ("nothing", "here")) == []
    assert allowed_keys(DeckContent, ("title", "x")) == []


def test_mappings_of_names() -> None:
    names = [key for key in DeckContent.model_fields if takes_names(DeckContent, (key,))]
    assert names == ["parameters", "materials", "joints", "loads", "load_cases", "expected"]


def test_description() -> None:
    assert description(DeckContent, ("output", "frames")) == "frames of the animation of the mechanism"
    assert description(DeckContent, ("output", "nothing")) == ""


def test_annotations_with_units_and_bounds() -> None:
    assert annotations_at(DeckContent, ("blocks", 0, "mesh", "scale")) == [PositiveNumber]
    assert annotations_at(DeckContent, ("blocks", 0, "mesh", "extrude")) == [PositiveLength | None]
    assert annotations_at(DeckContent, ("blocks", 0, "mesh", "nothing")) == []
    assert annotations_at(DeckContent, ("title", 0)) == []
