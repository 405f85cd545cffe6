"""What the report says about a structure that has exactly one thing wrong with it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.contacts import ContactReport, find_contacts
from mbla.contacts.narrow_phase import _on_same_facet
from mbla.contacts.notices import _by_tolerance, overlap_messages
from mbla.deck.units import Units
from mbla.model.solids.polyhedra import join_polyhedra
from tests.contacts.structures import (
    any_rotation,
    blocks_of,
    boxes,
    contacts_of,
    ground,
    model_of,
    moved,
    prism,
    profile,
    section,
)


def words(report: ContactReport) -> dict[str, str]:
    return {notice.identifier: notice.message for notice in report.notices}


def test_near_miss_between_blocks() -> None:
    pair = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1.004], [1, 1, 2.004]))
    report = contacts_of(pair, grounds=(ground(),)).report
    assert report.near_misses.tolist() == [[0, 1]]
    assert report.near_miss_gaps == pytest.approx([0.004])
    assert words(report)["near-misses"] == (
        "1 near miss, opposite faces that miss each other by more than the tolerance of 0.001: "
        "block[0] and block[1] (0.004 m, 0.004 of the block size); they are no contacts, with contacts.tolerance above "
        "0.0042 all of them are"
    )


def test_face_that_opens_like_a_wedge_is_a_near_miss() -> None:
    lower, upper = boxes(([0, 0, 0], [1, 1, 1])), boxes(([0, 0, 1], [1, 1, 2]))
    vertices = upper.vertices + 0.015 * upper.vertices[:, :1] * [0, 0, 1]
    report = contacts_of(join_polyhedra([lower, replace(upper, vertices=vertices)]), fixed=[0]).report
    assert report.near_misses.tolist() == [[0, 1]]
    assert report.near_miss_gaps == pytest.approx([0.015], rel=1e-2)


@pytest.mark.parametrize("gap", [0.0009, 0.101])
def test_contacts_and_wide_gaps_are_no_near_misses(gap: float) -> None:
    report = contacts_of(boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1 + gap], [1, 1, 2 + gap]))).report
    assert len(report.near_misses) == 0


@pytest.mark.parametrize(("gap", "count"), [(0.009, 1), (0.0101, 0)])
def test_gaps_between_blocks_that_are_held_are_looked_at_up_to_ten_tolerances(gap: float, count: int) -> None:
    shapes = boxes(([0, 0, 0], [1, 1, 1]), ([1 + gap, 0, 0], [2 + gap, 1, 1]))
    assert len(contacts_of(shapes, grounds=(ground(),)).report.near_misses) == count


def test_near_miss_of_the_ground() -> None:
    report = contacts_of(boxes(([0, 0, 0.002], [1, 1, 1])), grounds=(ground(),)).report
    assert report.near_misses.tolist() == [[1, 0]]
    assert set(words(report)) == {"near-misses", "isolated-blocks", "ground-without-contact"}


def test_neighbours_but_one_in_a_pile_of_tiles_are_no_near_misses() -> None:
    """The tile between fills the gap of 0.05 of the block size."""
    pile = boxes(*(([0, 0, 0.01 * i], [1, 1, 0.01 * (i + 1)]) for i in range(4)))
    report = contacts_of(moved(pile, turn=any_rotation(2)), fixed=[0], tolerance=1e-2).report
    assert len(report.near_misses) == 0


@pytest.mark.parametrize("turn", [None, any_rotation(2)], ids=["along the axes", "turned"])
def test_neighbours_but_one_of_tiles_like_an_l_are_no_near_misses(turn: np.ndarray | None) -> None:
    """The middle of what they share lies in the notch."""
    outline = [[0.0, 0.0], [4.0, 0.0], [4.0, 0.4], [1.0, 0.4], [1.0, 4.0], [0.0, 4.0]]
    pile = join_polyhedra([prism(outline, 0.01 * i, 0.01 * (i + 1)) for i in range(3)])
    contacts = contacts_of(moved(pile, turn=turn), fixed=[0], tolerance=1e-2)
    assert contacts.bodies.tolist() == [[0, 1], [1, 2]]
    assert len(contacts.report.near_misses) == 0
    apart = pile.vertices + np.repeat([[0, 0, 0], [9, 0, 0], [0, 0, 0]], 12, axis=0)
    report = contacts_of(moved(replace(pile, vertices=apart), turn=turn), fixed=[0], tolerance=1e-2).report
    assert report.near_misses.tolist() == [[0, 2]]


def test_near_miss_beside_a_contact_of_the_same_pair() -> None:
    """A step in the upper block: one foot stands, the other hangs just above."""
    lower = boxes(([0, 0, -1], [3, 1, 0]))
    foot, hanging = boxes(([0, 0, 0], [1, 1, 1])), boxes(([2, 0, 0.003], [3, 1, 1]))
    report = contacts_of(join_polyhedra([lower, foot, hanging]), fixed=[0]).report
    assert report.near_misses.tolist() == [[0, 2]]
    assert report.isolated.tolist() == [2]


def test_sliver() -> None:
    report = contacts_of(boxes(([0, 0, 0], [1, 1, 1]), ([0.9995, 0, 1], [2, 1, 2]))).report
    assert report.slivers.tolist() == [[0, 1]]
    assert report.sliver_widths == pytest.approx([0.0005], rel=1e-3)
    assert words(report)["slivers-dropped"] == (
        "1 common surface narrower than the tolerance of 0.001 dropped; the widest, between block[0] and block[1], "
        "measures 0.0005 m, 0.0005 of the block size"
    )


def test_isolated_block() -> None:
    report = contacts_of(
        boxes(([0, 0, 0], [1, 1, 1]), ([5, 0, 0], [6, 1, 1]), ([0, 0, 1], [1, 1, 2])), fixed=[0]
    ).report
    assert report.isolated.tolist() == [1]
    assert [part.tolist() for part in report.unsupported] == [[1]]
    assert words(report) == {
        "isolated-blocks": "1 of 3 blocks touches nothing: block[1]; nearest to it is block[0], 4 m from block[1], by "
        "the boxes around them; exit status 4, unless contacts.isolated is allow"
    }


def test_part_that_reaches_no_support() -> None:
    blocks = boxes(([0, 0, 0], [1, 1, 1]), ([5, 0, 0], [6, 1, 1]), ([0, 0, 1], [1, 1, 2]), ([5, 0, 1], [6, 1, 2]))
    report = contacts_of(blocks, fixed=[0]).report
    assert [part.tolist() for part in report.unsupported] == [[1, 3]]
    assert words(report) == {
        "unsupported-parts": "1 part of the structure not connected to a support; the part has 2 blocks: "
        "block[1], block[3]; nearest to it is block[0], 4 m from block[1], by the boxes around them"
    }


def test_the_gap_below_a_part_without_support() -> None:
    """The box of a tier 0.0128 m above the one it was meant to stand on; a block that meets an edge only; a ground."""
    tiers = boxes(([0, 0, 0], [3, 1, 1]), ([0, 0, 1.0128], [1, 1, 2]), ([1, 0, 1.0128], [2, 1, 2]))
    assert "nearest to it is block[0], 0.0128 m from block[1]" in words(contacts_of(tiers, fixed=[0]).report).get(
        "unsupported-parts", ""
    )
    edge = boxes(([0, 0, 0], [1, 1, 1]), ([1, 0, 1], [2, 1, 2]))
    assert (
        "nearest to it is block[0], which block[1] meets or overlaps without a common surface"
        in words(contacts_of(edge, fixed=[0]).report)["isolated-blocks"]
    )
    above = boxes(([0, 0, 0.02], [1, 1, 1]))
    assert (
        "nearest to it is ground, 0.02 m from block[0]"
        in words(contacts_of(above, grounds=(ground(),)).report)["isolated-blocks"]
    )


def test_parts_are_not_connected_through_a_support_that_only_one_touches() -> None:
    row = boxes(([0, 0, 0], [1, 1, 1]), ([1, 0, 0], [2, 1, 1]), ([2, 0, 0], [3, 1, 1]))
    assert contacts_of(row, fixed=[1]).report.unsupported == ()
    assert [part.tolist() for part in contacts_of(row).report.unsupported] == [[0, 1, 2]]


def test_ground_that_carries_nothing() -> None:
    row = boxes(([0, 0, 0], [1, 1, 1]))
    report = contacts_of(row, grounds=(ground(), ground(point=[9, 0, 0], normal=[1, 0, 0]))).report
    assert set(words(report)) == {"ground-without-contact"}


def test_block_on_both_sides_of_the_ground() -> None:
    row = boxes(([0, 0, 0], [1, 1, 1]), ([1, 0, -0.5], [2, 1, 0.5]))
    report = contacts_of(row, grounds=(ground(),)).report
    assert words(report)["block-crosses-ground"] == "1 block on both sides of ground: block[1]"


def test_override_without_contact() -> None:
    stack = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1], [1, 1, 2]))
    model = model_of(blocks_of(stack, ["base", "top"]), fixed=[0])
    report = find_contacts(model, section(overrides=[("top", "top", "mortar")])).report
    assert words(report) == {
        "override-without-contact": "no contact between top and top: the override with joint mortar has no effect"
    }


def test_lengths_in_words_are_in_the_unit_of_the_deck() -> None:
    pair = moved(boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1.004], [1, 1, 2.004])), scale=1000.0)
    model = model_of(blocks_of(pair), fixed=[0])
    model = replace(model, units=Units(length="mm"))
    assert "(4 mm, 0.004 of the block size)" in words(find_contacts(model, section()).report)["near-misses"]


def test_fixed_bodies_among_themselves_are_not_reported() -> None:
    pair = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1.004], [1, 1, 2.004]))
    report = contacts_of(pair, fixed=[0, 1]).report
    assert len(report.near_misses) == 0
    np.testing.assert_array_equal(report.isolated, [0, 1])


def test_the_widest_sliver_is_told() -> None:
    row = boxes(([0, 0, 0], [1, 1, 1]), ([0.9998, 0, 1], [2, 1, 2]), ([1.9993, 0, 0], [3, 1, 1]))
    assert (
        "2 common surfaces narrower than the tolerance of 0.001 dropped; the widest, between block[1] and block[2], "
        "measures 0.0007 m"
    ) in words(contacts_of(row).report)["slivers-dropped"]


@pytest.mark.parametrize("order", [(0, 1, 2), (1, 2, 0), (2, 0, 1)])
def test_a_pair_that_overlaps_is_no_near_miss_too(order: tuple[int, ...]) -> None:
    """A hook that reaches into its neighbour at one place and nearly touches it at another; a third block apart."""
    outline = [(0, 0), (1, 0), (1, 2.004), (3, 2.004), (3, 3), (0, 3)]
    parts = [profile(outline), boxes(([0.9, 0, 0], [3, 1, 2])), boxes(([9, 0, 0], [10, 1, 1]))]
    report = contacts_of(join_polyhedra([parts[place] for place in order])).report
    pair = sorted((order.index(0), order.index(1)))
    assert report.overlaps.tolist() == [pair]
    assert report.near_misses.tolist() == []


def test_a_block_twice_in_one_place_lies_inside_the_other() -> None:
    twice = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 0], [1, 1, 1]))
    model = model_of(blocks_of(twice))
    report = find_contacts(model, section()).report
    assert overlap_messages(model, report) == (
        "block[0] lies wholly inside block[1]: leave one of them out; a block has no hollows",
    )


def test_near_misses_behind_contacts_of_the_same_facet() -> None:
    """Rows that share a facet, beside all pairs looked at one by one; the ground is none."""
    facets = np.array([3, -1, 0, 5, 3])
    contacts = np.array([[-1, 3], [3, 0], [4, 2], [0, 7]])
    miss, contact = _on_same_facet(facets, contacts)
    pairs = [(m, c) for m, one in enumerate(facets) for c, two in enumerate(contacts) if one >= 0 and one in two]
    assert sorted(zip(miss.tolist(), contact.tolist(), strict=True)) == sorted(pairs)


def test_a_tolerance_that_a_deck_may_not_give_is_not_advised() -> None:
    """Decks allow 0.1 and no more; a twentieth more than what is needed, rounded, is advised."""
    assert _by_tolerance(0.09, "above {:.2g}") == "above 0.095"
    assert _by_tolerance(0.0944, "above {:.2g}") == "above 0.099"
    assert _by_tolerance(0.0952, "above {:.2g}") == ""
    assert _by_tolerance(0.2, "above {:.2g}") == ""
