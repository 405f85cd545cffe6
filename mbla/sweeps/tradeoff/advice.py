"""Which setting to take for a wanted error: the fastest sound one that is near enough, in one sentence."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mbla.results.listing.text import small
from mbla.sweeps.measure.setting import Setting
from mbla.sweeps.tradeoff.trade import CaseTrade, Row

SAME_TIME = 0.1
"""share of time that another run of the same may differ by: a preset is preferred to a single knob within it"""
SAME_SECONDS = 0.03
"""seconds that it may differ by however short it is, as the system does other things meanwhile"""
PRESETS = ("accuracy: standard", "accuracy: draft", "accuracy: reference")
"""the one that needs no word in the deck first"""


@dataclass(frozen=True)
class Advice:
    """What is advised.

    rung    : name of the setting; empty where none can be advised
    setting : what to put into the deck
    seconds : that it takes, all load cases of the advice together
    error   : largest distance from the reference; nan without a rung
    sentence: the advice, or why there is none
    """

    rung: str
    setting: Setting
    seconds: float
    error: float
    sentence: str


def advice(trades: Sequence[CaseTrade], wanted: float) -> Advice:
    """For some load cases together: a rung must be sound and near enough under every one of them."""
    lacking = [trade.name for trade in trades if trade.reference is None]
    if lacking:
        return _none(f"No setting can be advised: there is no reference for {', '.join(lacking)}.")
    unsure = [trade.name for trade in trades if not trade.verified]
    if unsure:
        return _none(f"No setting can be advised: no setting is verified for {', '.join(unsure)}.")
    coarse = max(trade.resolution for trade in trades)
    if coarse > wanted:
        return _none(f"No setting can be advised for an error of {_digits(wanted)}: the reference itself is good to "
                     f"{small(coarse)}.")  # fmt: skip
    candidates = [_candidate(trades, row.name) for row in trades[0].rows]
    fit = [each for each in candidates if each is not None and each.error <= wanted]
    fastest = min((each.seconds for each in fit), default=math.inf)
    enough = max((1.0 + SAME_TIME) * fastest, fastest + SAME_SECONDS * len(trades))
    near = {each.rung: each for each in fit if each.seconds <= enough}
    preset = next((near[name] for name in PRESETS if name in near), None)
    chosen = preset or min(near.values(), key=lambda each: each.seconds)  # the reference is always among those that fit
    usual = next((each for each in candidates if each is not None and each.rung == PRESETS[0]), None)
    figures = any(trade.has_figure for trade in trades)
    return _said(chosen, usual, wanted, coarse, figures=figures)


def _candidate(trades: Sequence[CaseTrade], name: str) -> Advice | None:
    """A rung over all load cases; None where it is not sound under one."""
    rows: list[Row] = [next(row for row in trade.rows if row.name == name) for trade in trades]
    if not all(row.sound for row in rows):
        return None
    seconds = sum(row.measurement.wall for row in rows if row.measurement is not None)
    return Advice(name, rows[0].run.rung.setting, seconds, max(row.distance for row in rows), "")


def _said(chosen: Advice, usual: Advice | None, wanted: float, coarse: float, *, figures: bool) -> Advice:
    """``figures``: a load case has one; others have the same verdict in the reference and in all that is advised."""
    if not figures:
        reached = "it comes to the same verdict as the reference"
    elif chosen.error > coarse:
        reached = f"{small(chosen.error)} from the reference"
    else:
        reached = f"not to be told from the reference, which is good to {small(coarse)}"
    freed = chosen.setting.freed
    without = f" without {', '.join(f'analysis.{name}' for name in freed)}" if freed else ""
    beside = "" if usual is None or usual.rung == chosen.rung else f"; {usual.rung} {duration(usual.seconds)}"
    took = f"({duration(chosen.seconds)}{beside})"
    take = f"For an error of {_digits(wanted)} take" if figures else "Take"
    sentence = f"{take} {chosen.rung}{without} {took}: {reached}."
    return Advice(chosen.rung, chosen.setting, chosen.seconds, chosen.error, sentence)


def _none(sentence: str) -> Advice:
    return Advice("", Setting(), math.nan, math.nan, sentence)


def _digits(value: float) -> str:
    """``1e-4``, ``0.02``."""
    text = f"{value:.3g}" if value >= 0.01 else f"{value:.2e}"
    mantissa, _, exponent = text.partition("e")
    return f"{float(mantissa):g}e{int(exponent)}" if exponent else text


def duration(seconds: float) -> str:
    """``0.81 s``, ``12.3 s``, ``-``."""
    return "-" if math.isnan(seconds) else f"{seconds:.3g} s" if seconds < 1000.0 else f"{seconds:.0f} s"
