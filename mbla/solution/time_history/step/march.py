"""Steps of a structure in time, one after the other: contacts renewed, impacts in small steps, what fails halved."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mbla.solution.time_history.step.moving_bodies import MovingBodies
from mbla.solution.time_history.step.renewed_contacts import renewed
from mbla.solution.time_history.step.solved_velocities import BALANCED
from mbla.solution.time_history.step.time_state import TimeState
from mbla.solution.time_history.step.time_step import FreeFlight, StepMade, free_flight, step_in_time

PARTS, AHEAD, FAST = 8, 1.5, 2.0
"""Small steps at an impact; steps within which a point closes there, and its speed over free fall in a step."""

OPEN = 1e-6
"""Gap over the size of the smaller block from which a point is open."""

HALVINGS = 4
"""Times that a step is halved where it is not solved."""


@dataclass(frozen=True)
class DeckStep:
    """A step of the deck: the first of those that it was made of, where it ends, and the largest e of them."""

    first: StepMade
    after: TimeState
    error: float


@dataclass
class March:
    """Steps from a state on.

    of_all : β that all joints have, s
    """

    bodies: MovingBodies
    of_all: float

    def steps(self, state: TimeState, h: float) -> Iterator[DeckStep]:
        """Without end."""
        while True:
            made = self._deck_step(state, h)
            yield made
            state = made.after

    def _deck_step(self, state: TimeState, h: float) -> DeckStep:
        state = renewed(self.bodies, state, self.of_all)
        flight = free_flight(self.bodies, state, h)
        parts = PARTS if self._impact(state, flight, h) else 1
        steps = self._solved(state, h / parts, 0, flight if parts == 1 else None)
        for _ in range(parts - 1):
            steps += self._solved(renewed(self.bodies, steps[-1].after, self.of_all), h / parts, 0)
        state = steps[-1].after
        counts = replace(state.counts, steps=state.counts.steps + 1, small=state.counts.small + len(steps) - 1)
        return DeckStep(steps[0], replace(state, counts=counts), max(step.error for step in steps))

    def _solved(self, state: TimeState, h: float, depth: int, flight: FreeFlight | None = None) -> list[StepMade]:
        """A step, or the steps in its place where it is not solved; the smallest are taken as they are."""
        made = step_in_time(self.bodies, state, h, flight)
        if made.error < BALANCED:
            return [made]
        counts = made.after.counts
        if depth == HALVINGS:
            return [replace(made, after=replace(made.after, counts=replace(counts, missed=counts.missed + 1)))]
        halved = replace(state.counts, halved=counts.halved + 1, factorisations=counts.factorisations)
        first = self._solved(replace(state, counts=halved), 0.5 * h, depth + 1)
        return [*first, *self._solved(renewed(self.bodies, first[-1].after, self.of_all), 0.5 * h, depth + 1)]

    def _impact(self, state: TimeState, flight: FreeFlight, h: float) -> bool:
        """Whether an open point closes soon, and fast."""
        joints, fall = state.joints, self.bodies.gravity * h
        if not joints.n_points:
            return False
        per_length, sizes = joints.normal_scale
        gap = state.at.offsets[0] / per_length
        is_open = gap > OPEN * sizes
        if not is_open.any():
            return False
        rate = state.at.joints.velocities(joints.displacements(flight.free))[0] / per_length
        return bool(np.any(is_open & (gap + AHEAD * h * rate < 0.0) & (rate < -FAST * fall)))
