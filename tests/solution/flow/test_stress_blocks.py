"""The path where interfaces crush as stress blocks: closed forms, in the plane and in space, any convex outline."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest
import shapely
import yaml

from mbla.assembly.assembly import Assembly
from mbla.contacts import find_contacts
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.model import select_cases
from mbla.program import assemble
from mbla.program.resultants.interface_motions import CrushingInterfaces
from mbla.solution.flow.path_of_part import path_by
from mbla.solution.law.interfaces import Interfaces
from tests.analytic.test_crushing import PIER
from tests.decks.folder import PATHS
from tests.line import Line, line_of, line_of_file
from tests.performance.court import dry_wall
from tests.reached import reaches
from tests.solution.convex_structures import prism
from tests.solution.flow.paths import DEFAULT, load_factor_of, reduced, rest_of, stress_blocks

CLOSE = 2e-5
"""Relative: what is left of the smoothing at the peak."""

TRIANGLE = ((0.0, 0.0), (1.0, 0.0), (0.2, 0.9))
HEXAGON = tuple((math.cos(math.radians(60 * i)), math.sin(math.radians(60 * i))) for i in range(6))
ANGLE = ((0.0, 0.0), (1.0, 0.0), (1.0, 0.4), (0.4, 0.4), (0.4, 1.0), (0.0, 1.0))
KITE = ((0.0, -0.5), (0.9, 0.0), (0.0, 0.5), (-0.4, 0.0))


def crushing(line: Line, *, associative_flow: bool = False) -> float:
    return load_factor_of(line, associative_flow=associative_flow, interfaces=stress_blocks(line))


@pytest.mark.parametrize(
    ("name", "case", "expected"),
    [
        ("eccentric_compression", 0, 0.980380),
        ("eccentric_compression", 1, 0.499285),
        ("bridge_axle_crushing", 0, 2.211802),
        ("nave_crushing", 0, 0.348129),
        ("nave_crushing", 1, 0.117406),
        ("trapezium_crushing", 0, 0.425926),
        ("trapezium_crushing", 1, 0.372390),
        ("block_crushing_a_corner", 0, 0.230296),
    ],
)
def test_decks_with_known_answers(name: str, case: int, expected: float) -> None:
    """The corners alone say .98038, .65359, 2.8372, .3583, .1332, .556, .444, .400."""
    (path,) = (path for path in PATHS if path.stem == name)
    line = line_of_file(path, case=case)
    assert reaches(crushing(line), expected, below=2e-4)


@pytest.mark.parametrize(
    ("e1", "e2", "block"),
    [(0.3, 0.1, 0.426029), (0.5, 0.3, 0.104274), (-0.1, 0.1, 0.682055), (0.2, -0.3, 0.222815)],
)
def test_a_pier_under_both_eccentricities(e1: float, e2: float, block: float) -> None:
    """By the largest part of its base with its centroid under the force (tests/analytic/test_crushing.py)."""
    line = line_of(PIER, f"parameters.e1={e1}", f"parameters.e2={e2}")
    assert crushing(line) == pytest.approx(block, rel=CLOSE)


@pytest.mark.parametrize("share", [0.0, 0.3, 0.6])
def test_a_stress_block_in_the_corner_of_a_triangle_is_homothetic(share: float) -> None:
    point = (1 - share) * np.array([0.4, 0.3]) + share * np.array(TRIANGLE[1])
    line = line_of(prism(TRIANGLE, point.tolist()))
    assert crushing(line) == pytest.approx(20 * 0.45 * (1 - share) ** 2 - 1, rel=CLOSE)


def as_a_whole(line: Line, expected: float) -> float:
    """Load factor of one interface with a strength of 20 kPa; its contact points alone bear any load."""
    program = reduced(line)
    assert len(line.contacts) == 1
    live = line.program.scaling.live
    found = path_by(program, expected / live, DEFAULT, interfaces=stress_blocks(line, 2e4))
    return float(live * found.load_factor)


def whole(outline: Sequence[tuple[float, float]], angle: float) -> tuple[str, float]:
    """A prism pressed where the half of its outline towards an angle has its centroid; its load factor."""
    polygon = shapely.Polygon(outline)
    centre = np.array(polygon.centroid.coords[0])
    along = np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
    across = np.array([-along[1], along[0]])
    ends = [centre + 1e4 * across, centre - 1e4 * across]
    half = polygon & shapely.Polygon([*ends, ends[1] + 1e4 * along, ends[0] + 1e4 * along])
    text = prism(outline, half.centroid.coords[0]).replace(', compressive_strength: "=fc"', "")
    return text, 20 * half.area - 1


@pytest.mark.parametrize("angle", [0.0, 30.0, 77.0])
@pytest.mark.parametrize("outline", [HEXAGON, KITE, ANGLE], ids=["hexagon", "kite", "angle"])
def test_outlines_that_are_no_parallelograms_crush_as_a_whole(
    outline: tuple[tuple[float, float], ...], angle: float
) -> None:
    """In the plane by their width, else in triangles about their centroid; springs at their corners."""
    text, expected = whole(outline, angle)
    assert as_a_whole(line_of(text), expected) == pytest.approx(expected, rel=CLOSE)


def test_lengths_and_axes_do_not_matter() -> None:
    turn = np.array([[math.cos(0.3), -math.sin(0.3)], [math.sin(0.3), math.cos(0.3)]])
    moved = [(x, y) for x, y in (1e3 * np.array(KITE) @ turn).tolist()]
    text, expected = whole(moved, 25.0)
    line = line_of(text.replace("[0, 0, -1000]", "[0, 0, -1e9]"))
    expected = 1e-6 * (expected + 1) - 1
    assert as_a_whole(line, expected) == pytest.approx(expected, rel=CLOSE)


@pytest.mark.parametrize("tension", [0.0, 5e3])
def test_a_tensile_strength_shifts_the_origin(tension: float) -> None:
    """With n = N + f_t A, F = (f_c + f_t) A: n (1 − n/F) b/2 = N e."""
    text = prism(((-0.5, -0.3), (0.5, -0.3), (0.5, 0.3), (-0.5, 0.3)), [0.25, 0.0])
    line = line_of(text.replace("friction: 0.5", f"friction: 0.5, cohesion: {tension}, tensile_strength: {tension}"))
    pulled, full = 0.6 * tension, 0.6 * (2e4 + tension)
    normal = full * (0.25 + math.sqrt(0.0625 + pulled / (2 * full))) - pulled
    assert crushing(line) == pytest.approx(normal / 1000 - 1, rel=CLOSE)


def test_with_associative_flow_it_is_the_load_factor_of_associative_stress_blocks() -> None:
    line = line_of(yaml.safe_dump(dry_wall(1.2, 0.15, 1.325, 100, 73e6, 0.65), sort_keys=False))
    assert crushing(line, associative_flow=True) == pytest.approx(38.26647, rel=3e-4)  # at D = 50 it still rises


@pytest.mark.every(2)
@pytest.mark.parametrize(("load", "expected"), [(40, 15.69209), (250, 93.342)])
def test_walls_that_were_pushed(load: int, expected: float) -> None:
    """The pairs of programs of the contact model without dilatancy say 15.69209 and 93.342."""
    line = line_of(yaml.safe_dump(dry_wall(1.2, 0.15, 1.325, load, 73e6, 0.65), sort_keys=False))
    assert crushing(line) == pytest.approx(expected, rel=2e-4)


@pytest.mark.parametrize(("strength", "stands"), [(0.99, False), (1.01, True)])
def test_a_pier_whose_base_crushes_under_its_weight(strength: float, stands: bool) -> None:
    line = line_of(PIER, f"parameters.fc={strength * 2000 * 9.81}")
    assert rest_of(line, interfaces=stress_blocks(line)).carried is stands


def test_ties_beside_stress_blocks() -> None:
    """Rods and a strut beside a base that crushes: λ W h/2 = W b/2 (1 − W/F) + T h_t + C h_s."""
    (path,) = (path for path in PATHS if path.stem == "tied_wall")
    deck = read_deck(path, ("analysis.solver=mbla", "joints.dry.compressive_strength=1e5"))
    model = build_model(deck)
    (case,) = select_cases(model, ["push"])
    bodies = Assembly(model, find_contacts(model, deck.contacts)).of(case)
    program = assemble(bodies.model, bodies.contacts, bodies.load_case(case))
    weight, full, rods = 15696.0, 1e5 * 0.4, math.pi / 4 * 0.012**2 * 235e6
    expected = (weight * 0.2 * (1 - weight / full) + rods * 1.8 + 5000.0 * 1.0) / weight
    interfaces = Interfaces(CrushingInterfaces.of(bodies.model, bodies.contacts))
    found = path_by(program, expected / program.scaling.live, DEFAULT, interfaces=interfaces)
    assert program.scaling.live * found.load_factor == pytest.approx(expected, rel=CLOSE)
