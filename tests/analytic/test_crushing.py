"""Crushing under an eccentric force: contact points and interface resultants against the rectangular stress block.

The exact answer for a force at the eccentricity e = (e_1, e_2) is the largest part of the interface with its centroid
there under the full stress f_c. By duality N = f_c min over β of ∫ (1 + β·(x − e))₊ dA.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from scipy.optimize import linprog, minimize

from mbla.arrays import FloatArray
from mbla.contacts.outlines.corners import areas_and_centroids, needed_corners
from mbla.contacts.outlines.points import interface_points
from mbla.contacts.outlines.refine import InterfacePoints
from mbla.deck.sections.contacts import ContactPoints
from tests.line import HEAD, factor_of

B, H = 1.2, 0.8
PIER = (
    HEAD
    + f"""\
parameters: {{e1: 0, e2: 0, fc: 1.e+6, b: {B}, h: {H}}}
joints: {{dry: {{friction: 0.6, compressive_strength: "=fc"}}}}
blocks:
  - box: {{group: pier, material: stone, min: ["=-b/2", "=-h/2", 0], max: ["=b/2", "=h/2", 1]}}
supports: [{{ground: {{z: 0}}}}]
load_cases:
  press:
    live: [{{force: [0, 0, "=-fc*b*h"], on: pier, at: ["=e1", "=e2", 1]}}]
analysis: {{flow_rule: associative}}
"""
)
WEIGHT = 2000 * 9.81 / 1e6
"""Of the pier, centred, in units of f_c A, like the eccentric force."""


def points_of(asked: ContactPoints, polygon: shapely.Polygon) -> InterfacePoints:
    corners = needed_corners(np.array([polygon], dtype=object), 1e-6)
    return interface_points(corners, areas_and_centroids(corners)[1], np.ones(1), asked)[0]


def by_points(n: int, e1: float, e2: float, weight: float = 0.0) -> float:
    """Force over f_c A that the contact points of the rectangle bear beside a weight, by a separate linear program."""
    points = points_of(ContactPoints(per_edge=n), shapely.box(-B / 2, -H / 2, B / 2, H / 2))
    shares = points.areas / (B * H)
    balance = (points.points - [e1, e2]).T
    needed = -weight * np.array([e1, e2])  # the weight is centred
    found = linprog(-np.ones(len(shares)), A_eq=balance, b_eq=needed, bounds=[(0.0, share) for share in shares])
    assert found.fun is not None, found.message
    return -float(found.fun) - weight


def stress_block(e1: float, e2: float) -> float:
    """N/(f_c A) of the exact stress block of the rectangle."""
    whole = shapely.box(-B / 2, -H / 2, B / 2, H / 2)

    def total(beta: FloatArray) -> float:
        """∫ (1 + β·(x − e))₊ dA: the height over the centroid of the part where it is positive, times its area."""
        steep = float(np.hypot(*beta))
        if steep < 1e-9:
            return 1.0
        along, edge = beta / steep, np.array([e1, e2]) - beta / steep**2
        across, far = np.array([-along[1], along[0]]), 10 * (B + H)
        corners = [edge + far * across, edge - far * across, edge - far * across + far * along]
        part = whole & shapely.Polygon([*corners, edge + far * across + far * along])
        centroid = np.array(part.centroid.coords[0])
        return float(part.area * (1 + beta @ (centroid - [e1, e2])) / (B * H))

    start = np.array([6 * e1 / B**2 + 0.3, 6 * e2 / H**2 + 0.3])
    options: Any = {"xatol": 1e-9, "fatol": 1e-13, "maxiter": 2000}
    found = minimize(total, start, method="Nelder-Mead", options=options)
    return float(found.fun)


def test_the_bound_of_crushing_by_points_is_attained() -> None:
    """Between two rows of points the trapezoidal rule errs by Δ²/8: no smaller bound holds for every eccentricity."""
    n, worst = 4, 0.0
    for share in np.linspace(0.01, 0.45, 45):
        found = by_points(n, share * B, 0.0)
        moment = found * share - found * (1 - found) / 2
        assert moment <= 1 / (8 * n**2) + 1e-9
        worst = max(worst, moment)
    assert worst > 0.95 / (8 * n**2)


@pytest.mark.parametrize(("e1", "e2", "n"), [(0.1, 0.1, 2), (0.3, 0.1, 5), (0.4, 0.25, 2), (0.15, 0.3, 5)])
def test_points_under_both_eccentricities(e1: float, e2: float, n: int) -> None:
    """A force of the same size lies within f_c A b/(8 n²) and f_c A h/(8 n²) in the exact stress block."""
    force = by_points(n, e1, e2, WEIGHT)
    found, moments = force + WEIGHT, force * np.array([e1, e2])
    assert found >= stress_block(*(moments / found)) * (1 - 1e-6)
    inner = np.maximum(moments - np.array([B, H]) / (8 * n**2), 0.0) / found
    assert found <= stress_block(*inner) * (1 + 1e-6)


def integral_of_hinge(polygon: shapely.Polygon, normal: FloatArray, point: FloatArray) -> float:
    """∫ (n·(x − p))₊ dA over a polygon, the normal a unit vector."""
    across, far = np.array([-normal[1], normal[0]]), 100.0
    edge = [point + far * across, point - far * across]
    part = polygon & shapely.Polygon([*edge, edge[1] + far * normal, edge[0] + far * normal])
    return float(part.area * (normal @ (np.array(part.centroid.coords[0]) - point))) if part.area else 0.0


@pytest.mark.parametrize(
    ("polygon", "factor"),
    [
        (shapely.Polygon([[0, 0], [3, 0], [1, 2]]), 1 / 2),
        (shapely.Polygon([[0, 0], [4, 0], [4, 1], [1, 1], [1, 4], [0, 4]]), 1 / 2),
        (shapely.Polygon([[0, 0], [4, 0], [4, 4], [0, 4]], [[[1, 1], [2, 1], [2, 2], [1, 2]]]), 1 / 2),
        (shapely.box(0, 0, 2, 3), 1 / 8),
    ],
    ids=["triangle", "L", "hole", "rectangle along its sides"],
)
@pytest.mark.parametrize("n", [2, 5])
def test_crushing_by_points_contains_the_stress_block_within_its_bound(
    polygon: shapely.Polygon, factor: float, n: int
) -> None:
    """In every direction the moment at a kink exceeds that of the stress block by f_c b h²/(2 n²) at most."""
    rng = np.random.default_rng(7)
    points = points_of(ContactPoints(per_edge=n), polygon)
    corners = np.array(polygon.exterior.coords)
    directions = rng.normal(size=(40, 2)) if factor > 1 / 4 else np.tile(np.eye(2), (20, 1))
    for normal in directions / np.linalg.norm(directions, axis=1)[:, None]:
        heights = corners @ normal
        place = rng.uniform(heights.min(), heights.max()) * normal
        excess = points.areas @ np.maximum((points.points - place) @ normal, 0.0)
        excess -= integral_of_hinge(polygon, normal, place)
        breadth = np.ptp(corners @ [-normal[1], normal[0]])
        assert -1e-12 <= excess <= factor * breadth * np.ptp(heights) ** 2 / n**2 + 1e-12


@pytest.mark.every(3)
@pytest.mark.parametrize(("e1", "e2"), [(0.05, 0.0), (0.25, 0.1), (0.33, 0.25), (0.05, 0.4)])
@pytest.mark.parametrize("rule", ["associative", "non_associative"])
def test_interfaces_bear_the_exact_stress_block(e1: float, e2: float, rule: str) -> None:
    """Without points between the corners, by default."""
    ways = (f"parameters.e1={e1 * B}", f"parameters.e2={e2 * H}", f"analysis.flow_rule={rule}")
    force = factor_of(PIER, *ways)
    found = force + WEIGHT
    exact = stress_block(*(force / found * np.array([e1 * B, e2 * H])))
    assert found == pytest.approx(exact, rel=1e-6)


WAYS = {
    "as it is": (),
    "twelve parts an edge": ("contacts.points.per_edge=12",),
    "convex": ("analysis.contact_model=convex",),
    "mbla": ("analysis.solver=mbla",),
    "published": ("analysis.flow_rule=non_associative", "analysis.scheme=published"),
    "published, by mbla": ("analysis={flow_rule: non_associative, scheme: published, solver: mbla}",),
    "livesley": ("analysis.flow_rule=livesley",),
    "dilatancy": ("analysis.flow_rule=dilatancy",),
}


@pytest.mark.every(2)
@pytest.mark.parametrize("way", WAYS)
def test_no_way_of_solving_changes_how_a_joint_crushes(way: str) -> None:
    force = factor_of(PIER, "parameters.e1=0.3", "parameters.e2=0.2", *WAYS[way])
    found = force + WEIGHT
    assert found / stress_block(0.3 * force / found, 0.2 * force / found) == pytest.approx(1.0, abs=1e-6)
