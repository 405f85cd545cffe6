"""A rigid block that rocks on a base that moves, by Housner's equation of motion.

Housner 1963, Bulletin of the Seismological Society of America 53(2), 403-417. A block of width B and height H with half
diagonal R and tan α = B/H turns about one corner of its foot, then about the other; θ > 0 about the one at +x::

    θ'' = −p² [sin(±α − θ) + a/g cos(±α − θ)],   p² = 3 g/(4 R),   + where θ > 0      (a along +x turns to θ < 0)
    θ' ← e θ' as θ passes 0,                     e = 1 − 3/2 sin² α                  (momentum about the next corner)

It begins to rock where |a| > g tan α. Nothing of mbla is in it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

FALLEN = math.radians(60.0)
LEFT = 1e-6
"""share of α at which a block that has just hit its base goes on, so that it does not hit it at once"""


@dataclass(frozen=True)
class RockingBlock:
    """A block in its plane; lengths and gravity in the same units."""

    width: float
    height: float
    gravity: float = 9.81

    @property
    def alpha(self) -> float:
        """Slenderness, rad."""
        return math.atan(self.width / self.height)

    @property
    def radius(self) -> float:
        """Half of the diagonal."""
        return 0.5 * math.hypot(self.width, self.height)

    @property
    def p(self) -> float:
        """1/s."""
        return math.sqrt(0.75 * self.gravity / self.radius)

    @property
    def restitution(self) -> float:
        """Velocity after an impact over that before."""
        return 1.0 - 1.5 * math.sin(self.alpha) ** 2

    def displaced(self, turn: float) -> float:
        """Displacement of its centroid, turned by an angle about a corner."""
        return 2.0 * self.radius * math.sin(0.5 * abs(turn))


@dataclass(frozen=True)
class Rocked:
    """What became of it: greatest |θ| and when, instants of its impacts, whether it has fallen."""

    turn: float
    time: float
    impacts: tuple[float, ...]
    falls: bool


def rocked(
    block: RockingBlock, acceleration: Callable[[float], float], breaks: tuple[float, ...], until: float
) -> Rocked:
    """Follow a block that rests at first.

    acceleration : of the base, smooth between ``breaks``
    """
    time, state, side = 0.0, np.zeros(2), 0.0
    best, when, impacts = 0.0, 0.0, list[float]()
    marks = sorted({*(t for t in breaks if 0.0 < t < until), until})
    while time < until - 1e-12:
        end = next(mark for mark in marks if mark > time + 1e-12)
        if side == 0.0:
            time, side = _begins(block, acceleration, time, end)
            continue
        turned = _turning(block, acceleration, side)
        found = solve_ivp(turned, (time, end), state, events=[_impact(side), _fallen], rtol=1e-10, atol=1e-13)
        size = np.abs(found.y[0])
        if size.max() > best:
            best, when = float(size.max()), float(found.t[size.argmax()])
        time, state = float(found.t[-1]), found.y[:, -1]
        assert found.t_events is not None
        hits, falls = found.t_events
        if len(falls):
            return Rocked(best, when, tuple(impacts), True)
        if len(hits):
            impacts.append(time)
            speed = block.restitution * state[1]
            side = math.copysign(1.0, speed)
            state = np.array([side * LEFT * block.alpha, speed])
            if abs(speed) < 1e-4 * block.p * block.alpha:
                state, side = np.zeros(2), 0.0
    return Rocked(best, when, tuple(impacts), False)


def _begins(
    block: RockingBlock, acceleration: Callable[[float], float], time: float, end: float
) -> tuple[float, float]:
    """When a block at rest begins to turn, and to which side; the end and 0 where it does not."""
    for instant in np.linspace(time, end, 2001):
        a = acceleration(min(float(instant) + 1e-9, end - 1e-9))
        if abs(a) > block.gravity * math.tan(block.alpha):
            return float(instant), -math.copysign(1.0, a)
    return end, 0.0


def _turning(
    block: RockingBlock, acceleration: Callable[[float], float], side: float
) -> Callable[[float, NDArray[np.float64]], list[float]]:
    def change(time: float, state: NDArray[np.float64]) -> list[float]:
        lever = side * block.alpha - state[0]
        pull = math.sin(lever) + acceleration(time) / block.gravity * math.cos(lever)
        return [float(state[1]), -(block.p**2) * pull]

    return change


def _impact(side: float) -> Callable[[float, NDArray[np.float64]], float]:
    def event(time: float, state: NDArray[np.float64]) -> float:
        return float(side * state[0])

    event.terminal = True  # type: ignore[attr-defined]
    event.direction = -1.0  # type: ignore[attr-defined]
    return event


def _fallen(time: float, state: NDArray[np.float64]) -> float:
    return FALLEN - abs(float(state[0]))


_fallen.terminal = True  # type: ignore[attr-defined]


def least_to_overturn(
    block: RockingBlock, pulse: Callable[[float], float], breaks: tuple[float, ...], low: float, high: float
) -> float:
    """Least factor on a pulse at which the block falls, between one at which it does not and one at which it does."""
    until = max(breaks) + 12.0 / block.p
    while high / low - 1.0 > 1e-7:
        middle = 0.5 * (low + high)
        falls = rocked(block, lambda time: middle * pulse(time), breaks, until).falls  # noqa: B023
        low, high = (low, middle) if falls else (middle, high)
    return 0.5 * (low + high)


def time_to_impact(block: RockingBlock, turn: float) -> float:
    """From rest at an angle in (0, α) until it hits its base, which is at rest, s."""
    found = solve_ivp(
        _turning(block, lambda time: 0.0, 1.0), (0.0, 10.0 / block.p), [turn, 0.0], events=_impact(1.0), rtol=1e-10
    )
    assert found.t_events is not None
    return float(found.t_events[0][0])
