"""Least thickness of the semicircular arch with friction, joints everywhere and its weight on the centre line.

Mean radius 1, weight 1 per length of the centre line, half of the arch, angles from the crown. The horizontal thrust H
at the crown has to be

- at least so large that the line of thrust, which then leaves the crown at the extrados, stays above the intrados: by
  moments about the intrados at beta,
  H >= ((1 - t/2) beta sin(beta) - (1 - cos(beta))) / (1 + t/2 - (1 - t/2) cos(beta));
- at least so large that no voussoir slides inwards: H >= beta / tan(beta + atan(mu));
- at most so large that the line of thrust stays inside the extrados of the springing: by moments about it,
  H (1 + t/2) <= (1 + t/2) pi/2 - 1;
- at most what friction bears at the springing: H <= mu pi/2.

The first and the third give the thickness that hinges alone need, the first and the last that of an arch whose
springings slide, the second and the last the friction below which no thickness stands. The results are those of
Cocchetti and Rizzi, Frattura ed Integrita Strutturale 51, 2020, 356-375, Tables 1 and 3, to every digit they print
(``test_frictional_arch``).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize_scalar

HALF = np.pi / 2
Angles: TypeAlias = NDArray[np.float64] | float
Thrust: TypeAlias = Callable[[Angles], NDArray[np.float64]]
NO_THICKNESS = 1e-9
"""lower end of the thicknesses and angles searched"""
CLOSE = 1e-14
"""of roots and greatest values; the roots are then good to ten digits"""


@cache
def rotational_thickness() -> float:
    """Least thickness over mean radius where nothing slides: that of five hinges, 0.107426."""
    return float(brentq(lambda t: thrust_of_hinges(t) - greatest_thrust(t), 0.05, 0.2, xtol=CLOSE))


@cache
def rotational_friction() -> float:
    """Friction from which on nothing slides at the least thickness, 0.395832."""
    return greatest_thrust(rotational_thickness()) / HALF


@cache
def least_friction() -> float:
    """Friction below which the arch stands at no thickness, 0.309215."""
    return float(brentq(lambda mu: thrust_of_friction(mu) - mu * HALF, 0.2, 0.5, xtol=CLOSE))


def least_thickness(mu: float) -> float | None:
    """Least thickness over mean radius that stands; None where none does."""
    if mu < least_friction():
        return None
    if mu >= rotational_friction():
        return rotational_thickness()
    return float(brentq(lambda t: thrust_of_hinges(t) - mu * HALF, rotational_thickness(), 0.5, xtol=CLOSE))


def thrust_of_hinges(t: float) -> float:
    """Least thrust whose line stays above the intrados."""
    inner, outer = 1 - t / 2, 1 + t / 2

    def at(beta: Angles) -> NDArray[np.float64]:
        return np.asarray((inner * beta * np.sin(beta) - (1 - np.cos(beta))) / (outer - inner * np.cos(beta)))

    return _greatest(at)


def thrust_of_friction(mu: float) -> float:
    """Least thrust at which nothing slides inwards."""
    return _greatest(lambda beta: np.asarray(beta / np.tan(beta + np.arctan(mu))))


def greatest_thrust(t: float) -> float:
    """Greatest thrust whose line stays inside the extrados of the springing."""
    outer = 1 + t / 2
    return float((outer * HALF - 1) / outer)


def _greatest(thrust: Thrust) -> float:
    """Greatest value between crown and springing: a grid says where, a bounded search how much."""
    grid = np.linspace(NO_THICKNESS, HALF, 201)
    place = int(np.argmax(thrust(grid)))
    low, high = grid[max(place - 1, 0)], grid[min(place + 1, len(grid) - 1)]
    found = minimize_scalar(lambda beta: -float(thrust(beta)), bounds=(low, high), method="bounded",
                            options={"xatol": 1e-12})  # fmt: skip
    return -float(found.fun)
