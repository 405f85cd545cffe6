"""Planar structures solved twice: spatially by mbla, and as a planar linear program by HiGHS (see ``planar``)."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from tests.analytic.planar import (
    Arch,
    PlanarJoint,
    Rectangle,
    arch_load_factor,
    centre_line_arch,
    load_factor,
    polygon_arch,
    rectangles_in_contact,
    sector_arch,
    wall_load_factor,
)
from tests.decks.folder import BENCHMARKS
from tests.line import HEAD
from tests.line import load_factor as mbla_load_factor

DECKS = Path(__file__).parents[2] / "decks"
AGREEMENT = 1e-7
DIGITS = 3e-8
"""Figures in decks have eight digits."""

PUSH = """\
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
analysis: {flow_rule: associative, accuracy: reference}
"""

FERRIS_TIN_LOI: dict[int, tuple[dict[str, list[float]], str]] = {
    1: ({"A": [0.5, 1, 1, 1, 1, 0.5], "B": [1, 1, 1, 1, 1]}, "A B A B A B"),
    3: (
        {"A": [1, 1, 1, 1], "B": [0.5, 1, 1, 1, 0.5], "C": [0.5, 1, -1, 1, 0.5], "D": [1, 0.5, -1, 0.5, 1]},
        "A B A C D C D C A B A",
    ),
    5: (
        {"A": [0.5, 1, 1, 0.5], "B": [1, 1, 1], "C": [1, -1, 1], "D": [0.5, 0.5, -1, 0.5, 0.5]},
        "A B A C D C D C A B A C D C D C A B A",
    ),
}
"""Courses bottom to top in units of 0.4 m, negative for a gap (Int. J. Mech. Sci. 43, 2001, 209-224)."""


def ferris_tin_loi(number: int) -> list[list[float]]:
    """Courses of a wall, from below."""
    courses, order = FERRIS_TIN_LOI[number]
    return [courses[name] for name in order.split()]


def expected(deck: str, case: str) -> float:
    """The associative figure of a deck."""
    content = read_deck(DECKS / f"{deck}.yaml").content
    expectation = content.expected[case]
    figure = expectation.associative_load_factor
    if figure is None and content.analysis.flow_rule == "associative":
        figure = expectation.load_factor
    assert figure is not None
    return figure


ARCHES = [name for name in BENCHMARKS if name.startswith("cocchetti_rizzi_mu_")]


@pytest.mark.parametrize("name", ARCHES)
def test_arches_of_cocchetti_and_rizzi(name: str) -> None:
    """The thickness of a deck is just above or below the published least; so is what the linear program says of it."""
    content = read_deck(BENCHMARKS[name]).content
    mu, thickness = (float(content.parameters[key]) for key in ("mu", "t"))
    planar = arch_load_factor(centre_line_arch(thickness, 86), mu)
    assert (planar is not None) == name.endswith("stands")
    assert content.expected["push_x"].load_factor == (planar and pytest.approx(planar, rel=DIGITS))


@pytest.mark.parametrize("number", [1, 3, 5])
def test_walls_of_ferris_and_tin_loi(number: int) -> None:
    planar = wall_load_factor(ferris_tin_loi(number), 0.65)
    for deck in (f"ferris_wall_{number}", f"ferris_wall_{number}_associative", f"ferris_wall_{number}_slope"):
        assert expected(f"benchmarks/published/{deck}", "push_x") == pytest.approx(planar, rel=DIGITS)


@pytest.mark.parametrize("n", [5, 10, pytest.param(20, marks=pytest.mark.long)])
def test_running_bond_walls(n: int) -> None:
    full, half = [1.0] * n, [0.5] + [1.0] * (n - 1) + [0.5]
    planar = wall_load_factor([half if course % 2 else full for course in range(n)], 0.65)
    assert expected(f"benchmarks/closed_forms/wall_{n}x{n}", "in_plane") == pytest.approx(planar, rel=DIGITS)


@pytest.mark.parametrize("voussoirs", [20, 50])
def test_semicircular_arches(voussoirs: int) -> None:
    planar = arch_load_factor(polygon_arch(0.925, 1.075, np.pi, voussoirs), 0.65)
    assert expected(f"benchmarks/closed_forms/arch_{voussoirs}_voussoirs", "push_x") == pytest.approx(planar, rel=5e-8)


def test_oppenheim_refers_to_the_mean_radius() -> None:
    embrace = np.radians(157.5)
    mean, inner, outer = (
        arch_load_factor(sector_arch(*radii, embrace, 7), 1.0) for radii in ((0.925, 1.075), (1.0, 1.15), (0.85, 1.0))
    )
    assert mean == pytest.approx(0.370010, abs=5e-7)
    assert inner == pytest.approx(0.33258, abs=1e-5)
    assert outer == pytest.approx(0.41483, abs=1e-5)
    assert expected("benchmarks/published/oppenheim_arch", "push_x") == pytest.approx(mean, rel=5e-8)


def test_the_arch_of_the_tutorial() -> None:
    arch = polygon_arch(2.0, 2.4, np.pi, 27)
    assert expected_own("tutorials/arch", "along") == pytest.approx(arch_load_factor(arch, 0.7), rel=5e-8)
    angle = (6.5 / 27 - 0.5) * np.pi
    arm = 2.4 * np.array([np.sin(angle), np.cos(angle)]) - arch.points[6]
    live = np.zeros((27, 3))
    live[6] = [0.0, -1e3, -1e3 * arm[0]]
    heavy = Arch(arch.inner, arch.outer, arch.angles, 22e3 * arch.weights, arch.points)
    assert expected_own("tutorials/arch", "quarter_point") == pytest.approx(
        arch_load_factor(heavy, 0.7, live), rel=5e-8
    )


def test_the_wall_of_the_tutorial() -> None:
    assert expected("tutorials/wall", "in_plane") == pytest.approx(_push(list(_tutorial_wall()), 0.65), rel=DIGITS)


@pytest.mark.parametrize(("case", "towards"), [("to_thick", 1.0), ("to_thin", -1.0)])
def test_rough_leaves(case: str, towards: float) -> None:
    leaves = [Rectangle(-0.15, 0.0, 0.0, 2.0), Rectangle(0.0, 0.3, 0.0, 2.0)]
    assert expected("benchmarks/closed_forms/leaves_rough", case) == pytest.approx(
        _push(leaves, 0.6, towards), rel=5e-8
    )


@pytest.mark.parametrize("seed", range(6))
def test_random_walls(seed: int) -> None:
    """Courses cut at random places, friction of each joint law at random, a gap here and there."""
    random = np.random.default_rng(seed)
    mu = float(random.uniform(0.25, 0.9))
    bricks = [brick for level in range(5) for brick in _random_course(random, level)]
    boxes = "".join(
        f"  - box: {{material: stone, min: [{b.left!r}, 0, {b.bottom!r}], max: [{b.right!r}, 0.3, {b.top!r}]}}\n"
        for b in bricks
    )
    deck = f"{HEAD}joints: {{dry: {{friction: {mu!r}}}}}\nblocks:\n{boxes}supports: [{{ground: {{z: 0}}}}]\n{PUSH}"
    assert mbla_load_factor(deck) == pytest.approx(_push(bricks, mu), rel=AGREEMENT)


@pytest.mark.parametrize(
    ("thickness", "embrace", "voussoirs", "mu"),
    [
        (0.2, 180.0, 9, 0.8),
        (0.3, 180.0, 40, 0.4),
        (0.15, 120.0, 16, 0.35),
        (0.1, 90.0, 11, 0.6),
        (0.25, 210.0, 24, 0.9),
    ],
)
def test_arches_of_any_shape(thickness: float, embrace: float, voussoirs: int, mu: float) -> None:
    inner = 1.0 - thickness / 2
    angle = np.radians(embrace)
    span = float(2 * inner * np.sin(angle / 2))
    deck = (
        f"{HEAD}joints: {{dry: {{friction: {mu}}}}}\nblocks:\n"
        f"  - arch: {{material: stone, shape: segmental, span: {span!r}, embrace: {embrace}, thickness: {thickness},\n"
        f"           width: 0.4, voussoirs: {voussoirs}, springers: ground}}\n"
        f"{PUSH}"
    )
    planar = arch_load_factor(polygon_arch(inner, inner + thickness, angle, voussoirs), mu)
    assert mbla_load_factor(deck) == pytest.approx(planar, rel=AGREEMENT)


def expected_own(deck: str, case: str) -> float:
    """The figure of a deck by its own flow rule."""
    figure = read_deck(DECKS / f"{deck}.yaml").content.expected[case].load_factor
    assert figure is not None
    return figure


def _push(bricks: list[Rectangle], mu: float, towards: float = 1.0) -> float | None:
    areas = np.array([brick.area for brick in bricks])
    centroids = np.array([brick.centroid for brick in bricks])
    joints: list[PlanarJoint] = rectangles_in_contact(bricks, mu)
    return load_factor(joints, centroids, np.outer(areas, [0.0, -1.0]), np.outer(areas, [towards, 0.0]))


def _tutorial_wall() -> list[Rectangle]:
    """Seven courses of eight units, a window of two units' width in courses 3 to 6, a lintel of three above it."""
    full, half = np.arange(9) * 0.4, np.concatenate([[0.0], 0.2 + 0.4 * np.arange(8), [3.2]])
    bricks = [Rectangle(1.0, 2.2, 1.2, 1.4)]
    for level in range(7):
        void = (3.2, 3.2) if level < 2 else (1.2, 2.0) if level < 6 else (1.0, 2.2)
        cuts = half if level % 2 else full
        for left, right in ((0.0, void[0]), (void[1], 3.2)):
            ends = [left, *(cut for cut in cuts if left + 1e-9 < cut < right - 1e-9), right]
            bricks += [Rectangle(a, b, level * 0.2, (level + 1) * 0.2) for a, b in pairwise(ends) if b > a]
    return bricks


def _random_course(random: np.random.Generator, level: int) -> list[Rectangle]:
    ends = np.concatenate([[0.0], np.cumsum(random.uniform(0.25, 0.6, 6))])
    ends *= 2.4 / ends[-1]
    bottom = 0.25 * level
    bricks = [Rectangle(float(a), float(b), bottom, bottom + 0.25) for a, b in pairwise(ends)]
    if level == 2:
        del bricks[2]
    return bricks
