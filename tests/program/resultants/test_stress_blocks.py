"""Pieces of interfaces that crush: their conditions are what stress may carry, and together they are the whole."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.resultants.interface_motions import CrushingInterfaces, crushing_of
from mbla.program.resultants.shapes import InterfaceShapes
from mbla.program.resultants.stress_blocks import pieces_in_plane
from mbla.solution.law.crushing_interfaces import StressBlockBounds
from mbla.solution.verification.interface_laws import InterfaceLaws, crushing_excess
from tests.line import Line, line_of
from tests.solution.convex_structures import prism

RHOMBOID = ((0.0, 0.0), (1.2, 0.1), (1.5, 0.9), (0.3, 0.8))
TRIANGLE = ((0.0, 0.0), (1.0, 0.0), (0.2, 0.9))
PENTAGON = ((0.0, 0.0), (1.0, 0.1), (1.3, 0.8), (0.6, 1.4), (-0.2, 0.9))


def pressed(outline: tuple[tuple[float, float], ...], tension: float) -> tuple[Line, CrushingInterfaces]:
    line = line_of(prism(outline, [0.4, 0.3]).replace(', compressive_strength: "=fc"', ""))
    every = np.ones(len(line.contacts))
    return line, CrushingInterfaces.with_strengths(line.contacts, 2e4 * every, tension * every)


def copies(shapes: InterfaceShapes, n: int) -> InterfaceShapes:
    """One interface n times."""
    own = {name: np.concatenate([values] * n) for name, values in vars(shapes).items() if name != "start"}
    return InterfaceShapes(**own, start=len(shapes.corners) * np.arange(n + 1))


@pytest.mark.parametrize("tension", [0.0, 3e3])
@pytest.mark.parametrize("outline", [RHOMBOID, TRIANGLE], ids=["parallelogram", "triangle"])
def test_resultants_are_within_as_verification_has_it(outline: tuple[tuple[float, float], ...], tension: float) -> None:
    line, interfaces = pressed(outline, tension)
    found = crushing_of(line.program, interfaces)
    assert found is not None
    (pieces,) = found.pieces
    rng, n = np.random.default_rng(5), 1000
    force, rho = line.program.scaling.force, float(interfaces.radii[0])
    full = float(interfaces.compression[0])
    normal = rng.uniform(-0.2, 1.1, n) * full
    moments = rng.uniform(-0.2, 0.2, (2, n)) * full * rho
    resultants = np.stack([normal, *moments / rho]) / force
    conditions = StressBlockBounds(pieces, found.resultants, 1.0)
    within = np.array([conditions.values(one[:, None], np.zeros(0)).min() for one in resultants.T])
    none, every = np.zeros(n), np.ones(n)
    strength, own = (interfaces.compression + interfaces.tension) * every, interfaces.tension * every
    laws = InterfaceLaws(copies(interfaces.shapes, n), none, none, own, strength, none > 0.0, none == 0.0)
    at_interface = np.zeros((n, 6))
    at_interface[:, [0, 4, 5]] = np.stack([normal, moments[1], -moments[0]], axis=1)
    beyond = crushing_excess(laws, at_interface)
    assert 50 < (within > 0.0).sum() < n - 50
    np.testing.assert_array_equal(within > 0.0, beyond < 0.0)


@pytest.mark.parametrize("outline", [RHOMBOID, TRIANGLE, PENTAGON])
def test_pieces_share_the_area_and_its_centroid(outline: tuple[tuple[float, float], ...]) -> None:
    line, interfaces = pressed(outline, 0.0)
    found = crushing_of(line.program, interfaces)
    assert found is not None
    force = np.concatenate([pieces.strength for pieces in found.pieces])
    centre = np.concatenate([pieces.centre for pieces in found.pieces], axis=1)
    assert force.sum() * line.program.scaling.force == pytest.approx(float(interfaces.compression[0]))
    np.testing.assert_allclose((force * centre).sum(axis=1) / force.sum(), [1.0, 0.0, 0.0], atol=1e-12)


def test_widths_along_a_plane_are_strips_and_triangles() -> None:
    outlines = [np.array(PENTAGON) - np.array([0.55, 0.6]), np.array(TRIANGLE)[:, ::-1][::-1]]
    area = [0.5 * abs(float(np.sum(x[:, 0] * np.roll(x[:, 1], -1) - x[:, 1] * np.roll(x[:, 0], -1)))) for x in outlines]
    strips, ramps = pieces_in_plane([outlines], np.array([1.3]))
    share = np.concatenate([strips.share, ramps.share])
    assert share.sum() == pytest.approx(1.0)
    centre = np.concatenate([strips.centre, ramps.centre])[:, 1] * 1.3
    first = [float(np.sum((x[:, 0] + np.roll(x[:, 0], -1)) * _cross(x)) / 6.0) for x in outlines]
    assert (share * centre).sum() == pytest.approx(sum(first) / sum(area))


def _cross(x: FloatArray) -> FloatArray:
    after = np.roll(x, -1, axis=0)
    return np.asarray(x[:, 0] * after[:, 1] - x[:, 1] * after[:, 0])
