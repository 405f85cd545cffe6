"""Distances from the reference, the Pareto front and the advice, load case by load case.

The reference is ``accuracy: reference`` where it is verified, else the verified setting of the deck's own model that is
good to the least share; its own accuracy is the resolution below which distances cannot be distinguished. On the front
are the verified settings of the same model of which no other is both as fast and as near. Nothing that is not verified,
and no other model, is ever on the front or advised: the difference of another model is no error.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.results.listing.text import small
from mbla.solution.solution import Status
from mbla.sweeps.tradeoff.settings import REFERENCE, Setting

NAN = math.nan
ROUNDING = 1e-12
"""least resolution: rounding of figures that are the same"""
SAME_TIME, SAME_SECONDS = 0.1, 0.03
"""share of time, and seconds, by which another run of the same may differ: a preset is preferred to a knob in both"""
PRESETS = ("accuracy: standard", "accuracy: draft", REFERENCE)
"""the one that needs no word in the deck first"""


@dataclass(frozen=True)
class CaseTrade:
    """What each setting gave for one load case, a travelling load by its worst position; (n,), nan for no figure.

    what       : load factor, or angle or reaction with its unit
    status     : of the load case; empty where it was not solved
    verified   : as sharply as the setting asks for, or that there is no load factor
    answer     : load factor, angle of a tilting table, or reaction of a support that gives way
    seconds    : of the load case by the clock
    reference  : number of the setting that the others are compared with; None where none has an answer
    certain    : the reference is verified
    resolution : distances below this cannot be resolved; nan without a reference
    distance   : relative, from the reference; 0 where both confirm that there is no figure, nan where only one has one
    sound      : verified, of the deck's own model, and comparable: may be on the front and be advised
    front      : sound, and no other is at least as good in time and distance and better in one
    shown      : further figures of the table by their heads
    """

    name: str
    what: str
    settings: tuple[Setting, ...]
    status: np.ndarray[Any, np.dtype[Any]]
    verified: BoolArray
    answer: FloatArray
    seconds: FloatArray
    reference: int | None
    certain: bool
    resolution: float
    distance: FloatArray
    sound: BoolArray
    front: BoolArray
    shown: Mapping[str, FloatArray] = field(default_factory=dict)


def trade_of(
    name: str,
    what: str,
    settings: Sequence[Setting],
    status: np.ndarray[Any, np.dtype[Any]],
    verified: BoolArray,
    answer: FloatArray,
    accuracy: FloatArray,
    seconds: FloatArray,
    least: float = 0.0,
    shown: Mapping[str, FloatArray] | None = None,
) -> CaseTrade:
    """The settings compared with each other; arrays (n,) as of ``CaseTrade``.

    accuracy : (n,) what the answer is good to, relatively: the gap of the bounds, or the largest residual
    least    : size below which differences of answers are relative to this
    """
    own = np.array([not setting.model for setting in settings])
    sharp = verified & own & (status != Status.APPROXIMATE.value)
    reference = _reference(settings, sharp, own & (status != "") & np.isfinite(answer), accuracy)
    certain = reference is not None and bool(sharp[reference])
    resolution, distance, sound = NAN, np.full(len(settings), NAN), np.zeros(len(settings), dtype=bool)
    if reference is not None:
        resolution = max(ROUNDING, float(np.nan_to_num(accuracy[reference])))
        value = answer[reference]
        size = np.where(answer == value, 1.0, max(abs(value), least) or np.abs(answer))
        alike = verified & verified[reference] & np.isnan(answer) & (status == status[reference])
        distance = np.where(alike, 0.0, NAN) if np.isnan(value) else np.abs(answer - value) / size
        sound = verified & own & np.isfinite(distance)
    front = sound & certain & ~_beaten(np.where(sound, seconds, np.inf), np.fmax(distance, resolution))
    figures = (status, verified, answer, seconds, reference, certain, resolution, distance, sound, front)
    return CaseTrade(name, what, tuple(settings), *figures, shown or {})


def _reference(settings: Sequence[Setting], sharp: BoolArray, answered: BoolArray, accuracy: FloatArray) -> int | None:
    """The preset if it is verified, else the sharpest that is, else the sharpest that has an answer at all."""
    for number in np.flatnonzero(sharp).tolist():
        if settings[number].name == REFERENCE:
            return int(number)
    found = np.flatnonzero(sharp if sharp.any() else answered)
    return int(found[np.nan_to_num(accuracy[found], nan=np.inf).argmin()]) if len(found) else None


def _beaten(seconds: FloatArray, errors: FloatArray) -> BoolArray:
    """Settings than which another one is at least as good in both, (n,), and better in one."""
    as_good = (seconds[:, None] <= seconds) & (errors[:, None] <= errors)
    better = (seconds[:, None] < seconds) | (errors[:, None] < errors)
    return np.asarray((as_good & better).any(axis=0))


@dataclass(frozen=True)
class Advice:
    """The setting that is advised, None where none can be; its seconds over all load cases, and the sentence."""

    setting: Setting | None
    seconds: float
    sentence: str


def advice(trades: Sequence[CaseTrade], wanted: float) -> Advice:
    """For some load cases together: a setting must be sound and near enough under every one of them."""
    unsure = [trade.name for trade in trades if not trade.certain]
    coarse = max(trade.resolution for trade in trades)
    if unsure or coarse > wanted:
        why = f"an error of {wanted:g} is asked for, and the reference itself is good to {small(coarse)}"
        why = f"no setting is verified for {', '.join(unsure)}" if unsure else why
        return Advice(None, NAN, f"No setting can be advised: {why}.")
    errors = np.max([np.where(trade.sound, trade.distance, np.inf) for trade in trades], axis=0)
    seconds = np.where(errors <= wanted, np.sum([trade.seconds for trade in trades], axis=0), np.inf)
    fastest = int(seconds.argmin())  # the reference is always among those that are near enough
    enough = max((1.0 + SAME_TIME) * seconds[fastest], seconds[fastest] + SAME_SECONDS * len(trades))
    names = [setting.name for setting in trades[0].settings]
    near = [names.index(name) for name in PRESETS if name in names and seconds[names.index(name)] <= enough]
    chosen = (near or [fastest])[0]
    setting, took = trades[0].settings[chosen], float(seconds[chosen])
    words = " without ".join([setting.name, *(f"analysis.{name}" for name in setting.without)])
    reached = small(max(float(errors[chosen]), coarse))
    return Advice(
        setting, took, f"For an error of {wanted:g} take {words} ({took:.3g} s, within {reached} of the reference)."
    )
