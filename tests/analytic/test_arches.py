"""Arches of other shapes than the circle against a linear program of the arch drawn a second time."""

from __future__ import annotations

import pytest

from mbla.deck import read_deck
from mbla.model import build_model
from tests.analytic.arches import basket, catenary, elliptic, joints, pointed_joints, push_factor
from tests.analytic.planar import Array
from tests.decks.folder import BENCHMARKS

MU = 0.7


def of_deck(name: str) -> tuple[Array, Array]:
    """Corners of joints at intrados and extrados."""
    if name == "arch_pointed":
        return pointed_joints(4, 3, 24, 0.4)
    if name == "arch_elliptic":
        return joints(elliptic(4, 1.4), 25, 0, 0.4)
    if name == "arch_basket":
        return joints(basket(4, 1.4), 25, 0, 0.4)
    thickness, count = (0.004, 40) if name == "arch_catenary_thin" else (0.4, 24)
    return joints(catenary(4, 2), count, -thickness / 2, thickness / 2)


NAMES = ("arch_pointed", "arch_elliptic", "arch_basket", "arch_catenary", "arch_catenary_thin")


@pytest.mark.parametrize("name", NAMES)
def test_figures_of_the_decks(name: str) -> None:
    deck = read_deck(BENCHMARKS[name])
    assert push_factor(*of_deck(name), MU) == pytest.approx(deck.content.expected["push_x"].load_factor, rel=1e-6)


@pytest.mark.parametrize("name", NAMES)
def test_voussoirs_of_the_decks(name: str) -> None:
    """Every corner of the generated arch lies where the arch drawn a second time has one."""
    inner, outer = of_deck(name)
    vertices = build_model(read_deck(BENCHMARKS[name])).blocks.vertices.reshape(-1, 8, 3)[:, 4:][..., [0, 2]]
    if name.startswith("arch_catenary"):  # springings of the centre line at the origin, in both
        assert abs(inner[0, 1] + outer[0, 1]) < 1e-9
    for corner, drawn in enumerate((inner[:-1], inner[1:], outer[1:], outer[:-1])):
        assert vertices[:, corner] == pytest.approx(drawn, abs=1e-7)


@pytest.mark.parametrize("thickness", [0.04, 0.004, 0.0004])
def test_a_catenary_stands_at_any_thickness_and_an_ellipse_does_not(thickness: float) -> None:
    half = thickness / 2
    factor = push_factor(*joints(catenary(4, 2), 40, -half, half), MU)
    assert factor is not None
    assert factor == pytest.approx(1.08 * thickness, rel=0.06)  # nearly in proportion to the thickness
    assert push_factor(*joints(elliptic(4, 2), 40, -half, half), MU) is None
