"""Distances from the reference, the Pareto front and the advice, load case by load case.

The reference is ``accuracy: reference`` where it is verified, else the verified setting of the deck's own model that is
good to the least share; its own accuracy is the resolution below which distances cannot be told apart. On the front are
the verified settings of the same model of which no other is both as fast and as near. Nothing that is not verified, and
no other model, is ever on the front or advised: the difference of another model is no error.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.results.listing.text import small
from mbla.solution.solution import Status
from mbla.sweeps.tradeoff.ladder import REFERENCE, Rung

NAN = math.nan
ROUNDING = 1e-12
"""least resolution: rounding of figures that are the same"""
VERDICTS = (Status.NO_EQUILIBRIUM, Status.UNBOUNDED)
"""statuses that are an answer without a figure, once verified"""
SAME_TIME = 0.1
"""share of time that another run of the same may differ by: a preset is preferred to a single knob within it"""
SAME_SECONDS = 0.03
"""seconds that it may differ by however short it is, as the system does other things meanwhile"""
PRESETS = ("accuracy: standard", "accuracy: draft", "accuracy: reference")
"""the one that needs no word in the deck first"""


@dataclass(frozen=True)
class CaseTrade:
    """What each setting gave for one load case, a travelling load by its worst position; (n,), nan for no figure.

    what     : load factor, or angle or reaction with its unit
    status   : of the load case; empty where it was not solved
    verified : as sharply as the setting asks for, or that there is no load factor
    answer   : load factor, angle of a tilting table, or reaction of a support that gives way
    accuracy : what the answer is good to, relatively: the gap of the bounds, or the largest residual
    residual : the largest
    lower, upper : proved bounds of associative flow, in the unit of the answer
    seconds  : of the load case by the clock
    least    : size below which differences of answers are relative to this
    """

    name: str
    what: str
    rungs: tuple[Rung, ...]
    status: np.ndarray[Any, np.dtype[Any]]
    verified: BoolArray
    answer: FloatArray
    accuracy: FloatArray
    residual: FloatArray
    lower: FloatArray
    upper: FloatArray
    seconds: FloatArray
    least: float = 0.0

    @cached_property
    def reference(self) -> int | None:
        """The preset if it is verified, else the sharpest that is, else the sharpest that has an answer at all."""
        own = (self.status != "") & self._same_model
        sharp = np.flatnonzero(own & self._sharp)
        named = [number for number in sharp if self.rungs[number].name == REFERENCE]
        found = named or list(sharp) or list(np.flatnonzero(own & np.isfinite(self.answer)))
        return min(map(int, found), key=lambda number: np.nan_to_num(self.accuracy[number], nan=np.inf), default=None)

    @cached_property
    def reference_verified(self) -> bool:
        """Whether others may be held against the reference."""
        return self.reference is not None and bool(self._sharp[self.reference])

    @property
    def resolution(self) -> float:
        """Distances below this are none that can be told; nan without a reference."""
        if self.reference is None:
            return NAN
        return max(ROUNDING, float(np.nan_to_num(self.accuracy[self.reference])))

    @cached_property
    def distance(self) -> FloatArray:
        """Relative, from the reference; 0 where both confirm that there is no figure, nan where only one has one."""
        if self.reference is None:
            return np.full(len(self.rungs), NAN)
        answer, both = self.answer[self.reference], self.verified & self.verified[self.reference]
        if np.isnan(answer):
            return np.where(both & np.isnan(self.answer) & (self.status == self.status[self.reference]), 0.0, NAN)
        size = np.where(self.answer == answer, 1.0, max(abs(answer), self.least) or np.abs(self.answer))
        return np.asarray(np.abs(self.answer - answer) / size)

    @property
    def sound(self) -> BoolArray:
        """Verified, of the deck's own model, and comparable with the reference: may be on the front and be advised."""
        return np.asarray(self.verified & self._same_model & np.isfinite(self.distance))

    @property
    def front(self) -> BoolArray:
        """Sound settings than which no other is at least as good in time and distance and better in one."""
        if not self.reference_verified:
            return np.zeros(len(self.rungs), dtype=bool)
        seconds = np.where(self.sound, self.seconds, np.inf)
        errors = np.where(self.sound, np.maximum(self.distance, self.resolution), np.inf)
        as_good = (seconds[:, None] <= seconds) & (errors[:, None] <= errors)
        better = (seconds[:, None] < seconds) | (errors[:, None] < errors)
        return np.asarray(self.sound & ~(as_good & better).any(axis=0))

    @cached_property
    def _sharp(self) -> BoolArray:
        """Verified and not only as sharply as a draft asks for."""
        return np.asarray(self.verified & (self.status != Status.APPROXIMATE.value))

    @property
    def _same_model(self) -> BoolArray:
        return np.array([not rung.model for rung in self.rungs])


@dataclass(frozen=True)
class Advice:
    """The setting that is advised, None where none can be; its seconds over all load cases, and the sentence."""

    rung: Rung | None
    seconds: float
    sentence: str


def advice(trades: Sequence[CaseTrade], wanted: float) -> Advice:
    """For some load cases together: a setting must be sound and near enough under every one of them."""
    unsure = [trade.name for trade in trades if not trade.reference_verified]
    if unsure:
        return _none(f"no setting is verified for {', '.join(unsure)}")
    coarse = max(trade.resolution for trade in trades)
    if coarse > wanted:
        return _none(f"an error of {wanted:g} is asked for, and the reference itself is good to {small(coarse)}")
    errors = np.max([np.where(trade.sound, trade.distance, np.inf) for trade in trades], axis=0)
    seconds = np.where(errors <= wanted, np.sum([trade.seconds for trade in trades], axis=0), np.inf)
    fastest = int(seconds.argmin())  # the reference is always among those that are near enough
    enough = max((1.0 + SAME_TIME) * seconds[fastest], seconds[fastest] + SAME_SECONDS * len(trades))
    names = [rung.name for rung in trades[0].rungs]
    near = [names.index(name) for name in PRESETS if name in names and seconds[names.index(name)] <= enough]
    chosen = (near or [fastest])[0]
    rung, took = trades[0].rungs[chosen], float(seconds[chosen])
    words = " without ".join([rung.name, *(f"analysis.{name}" for name in rung.without)])
    reached = small(max(float(errors[chosen]), coarse))
    return Advice(
        rung, took, f"For an error of {wanted:g} take {words} ({took:.3g} s, within {reached} of the reference)."
    )


def _none(why: str) -> Advice:
    return Advice(None, NAN, f"No setting can be advised: {why}.")
