"""The tension by which opposite forces split a disc, from the stresses of a force on a half-plane (Flamant).

A force P on the edge of a half-plane brings one stress, along the way r from it: 2 P cos θ / (π r), compression, with θ
the angle to the force. Two such fields, of opposite forces along a chord of the disc, and an even tension leave its
edge free. All of it is per thickness.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from mbla.arrays import FloatArray

RADIUS, FORCE = 0.3, 7.0


def stress(points: FloatArray, offset: float) -> FloatArray:
    """Stresses (n, 2, 2) at points (n, 2), tension positive, of forces along a chord off the middle."""
    half = np.sqrt(RADIUS**2 - offset**2)
    found = np.tile(FORCE * half / (np.pi * RADIUS**2) * np.eye(2), (len(points), 1, 1))
    for end, way in ((half, -1.0), (-half, 1.0)):
        arms = points - [offset, end]
        square = (arms**2).sum(axis=1)
        size = 2 * FORCE * way * arms[:, 1] / (np.pi * square**2)
        found -= size[:, None, None] * arms[:, :, None] * arms[:, None, :]
    return found


@pytest.mark.parametrize("offset", [0.0, 0.1, 0.25])
def test_its_edge_is_free_and_it_is_elastic_in_balance(offset: float) -> None:
    angles = np.random.default_rng(0).uniform(0, 2 * np.pi, 40)
    outward = np.column_stack([np.cos(angles), np.sin(angles)])
    traction = np.einsum("nij,nj->ni", stress(RADIUS * outward, offset), outward)
    assert np.abs(traction).max() < 1e-9 * FORCE / RADIUS
    inside, step = 0.7 * RADIUS * outward * np.random.default_rng(1).uniform(0, 1, (40, 1)), 1e-4 * RADIUS
    steps = step * np.eye(2)
    ahead, behind = (np.stack([stress(inside + sign * way, offset) for way in steps]) for sign in (1, -1))
    size = np.abs(stress(inside, offset)).max() / step
    balance = np.einsum("knki->ni", (ahead - behind) / (2 * step))
    assert np.abs(balance).max() < 1e-5 * size
    trace = [np.einsum("...ii", each) for each in (ahead, behind, stress(inside, offset))]
    assert np.abs((trace[0] + trace[1]).sum(axis=0) - 4 * trace[2]).max() < 1e-5 * np.abs(trace[2]).max()  # compatible


def test_forces_on_a_diameter_bring_the_same_tension_all_along_it() -> None:
    line = np.column_stack([np.zeros(9), np.linspace(-0.9, 0.9, 9) * RADIUS])
    assert stress(line, 0.0)[:, 0, 0] == pytest.approx(2 * FORCE / (np.pi * 2 * RADIUS), rel=1e-12)


@pytest.mark.parametrize("share", [0.1, 0.4, 0.8, 0.99])
def test_spread_over_a_width_they_bring_less_in_the_middle(share: float) -> None:
    def along(place: float) -> float:
        return float(stress(np.zeros((1, 2)), place * RADIUS)[0, 0, 0])

    mean = quad(along, 0, share)[0] / share
    assert mean == pytest.approx(2 * FORCE / (np.pi * 2 * RADIUS) * (1 - share**2) ** 1.5, rel=1e-9)
