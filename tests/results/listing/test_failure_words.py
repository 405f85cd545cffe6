"""The sentences on a failure, on the wall of the tutorial and on results made by hand."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.results.collapse.collapse import collapse_of, failure_of
from mbla.results.listing.failure_words import failure_sentences
from mbla.results.listing.places import region_words, way_words
from mbla.results.listing.slides import part_name
from tests.line import line_of_file, verified
from tests.results.synthetic import tower_contacts, tower_mechanics, tower_model

WALL = Path("decks/tutorials/wall.yaml")
MODEL = tower_model()
CASE = MODEL.load_cases[0]


def sentences(case: int, *overrides: str) -> list[str]:
    line = line_of_file(WALL, *overrides, case=case)
    mechanics = verified(line)[0].mechanics
    assert mechanics is not None
    collapse = collapse_of(line.model, line.contacts, line.load_case, mechanics)
    failure = failure_of(line.model, line.contacts, collapse, mechanics)
    return failure_sentences(line.model, line.contacts, line.load_case, collapse, failure)


def test_the_wall_of_the_tutorial_in_its_plane() -> None:
    """What a reader needs to draw it: which corner, how it turns and where about, where it parts, what slides."""
    text = " ".join(sentences(0))
    assert "The mechanism is partial: 12 of 52 free blocks, 20.8 % of the weight, move as one rigid part." in text
    assert (
        "Part 1, the upper right corner (12 blocks of wall, 20.8 % of the weight, courses 1 to 6, x 2.2 .. 3.2" in text
    )
    assert "turns about +y, its centroid moving with the load and upwards, over wall[7], on a" in text
    assert "a hinge from (3.2, 0, 0.2) to (3.2, 0.25, 0.2)" in text
    assert "A stepped crack of " in text
    assert "to (2.2, 0.125, 1.3) separates part 1 from " in text


def test_the_wall_of_the_tutorial_out_of_its_plane() -> None:
    assert sentences(1) == [
        "The mechanism is global: 52 of 52 free blocks, 100 % of the weight, move as one rigid part.",
        "The whole structure (52 blocks) turns about -x, its centroid moving with the load and upwards, over ground "
        "z = 0, on a hinge line of 8 interfaces from (3.2, 0.25, 0) to (0, 0.25, 0).",
        "Nothing slides.",
    ]


@pytest.mark.parametrize(
    ("velocity", "words"),
    [
        ((0, 0, -1), "downwards"),
        ((0, 0, 2), "upwards"),
        ((1, 0, 0), "with the load"),
        ((-1, 0, 0.05), "against the load"),
        ((1, 0, 1), "with the load and upwards"),
        ((0, 1, 0), "towards +y"),
        ((0, 0, 0), ""),
    ],
)
def test_directions_by_the_load(velocity: tuple[float, ...], words: str) -> None:
    middle = np.average(MODEL.blocks.centroids, axis=0, weights=MODEL.blocks.volumes)
    assert way_words(MODEL, CASE, np.array(velocity, float), middle) == words


def test_outwards_where_the_load_does_not_tell() -> None:
    middle = np.average(MODEL.blocks.centroids, axis=0, weights=MODEL.blocks.volumes)
    for sign, words in ((1.0, "outwards"), (-1.0, "inwards")):
        assert way_words(MODEL, CASE, np.array([0, sign, 0]), middle + np.array([0, 3, 0])) == words


def test_regions_by_the_extents_of_the_structure() -> None:
    line = line_of_file(WALL)
    low, high = line.model.blocks.vertices.min(axis=0), line.model.blocks.vertices.max(axis=0)
    share = (line.model.blocks.centroids - low) / (high - low)
    for chosen, words in (
        ((share[:, 0] > 0.7) & (share[:, 2] > 0.7), "upper right corner"),
        ((share[:, 0] < 0.3) & (share[:, 2] < 0.3), "lower left corner"),
        (share[:, 0] < 0.3, "left part"),
        (share[:, 2] > 0.7, "upper part"),
        (share[:, 0] >= 0, "part"),
    ):
        assert region_words(line.model, np.flatnonzero(chosen)) == words


def test_a_mechanism_in_which_nothing_moves_is_told_in_one_sentence() -> None:
    contacts = tower_contacts()
    still = replace(
        tower_mechanics(),
        mechanism=np.zeros((3, 6)),
        contact_velocities=np.zeros((8, 3)),
        modes=np.zeros(8, dtype=np.int64),
    )
    collapse = collapse_of(MODEL, contacts, CASE, still)
    failure = failure_of(MODEL, contacts, collapse, still)
    assert failure_sentences(MODEL, contacts, CASE, collapse, failure) == ["No block moves."]


def test_parts_by_their_numbers() -> None:
    """One of two free blocks moves."""
    contacts, mechanics = tower_contacts(), tower_mechanics()
    failure = failure_of(MODEL, contacts, collapse_of(MODEL, contacts, CASE, mechanics), mechanics)
    assert [part_name(MODEL, failure, number) for number in (0, 1)] == ["the stationary blocks", "part 1"]
