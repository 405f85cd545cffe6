"""Rows and trades made by hand."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mbla.sweeps.tradeoff import trade
from mbla.sweeps.tradeoff.settings import Setting
from mbla.sweeps.tradeoff.trade import CaseTrade


@dataclass(frozen=True)
class Row:
    """A solved and verified load factor."""

    setting: Setting
    answer: float = 0.5
    seconds: float = 1.0
    accuracy: float = 1e-9
    status: str = "solved"
    verified: bool = True


def row(name: str, answer: float, seconds: float, model: str = "", **changes: Any) -> Row:
    """One that took so many seconds."""
    key, _, value = name.partition(": ")
    return replace(Row(Setting(name, {f"analysis.{key}": value}, model=model), answer, seconds), **changes)


def rows_of_a_study() -> list[Row]:
    """A preset of each kind, a fast one that is not verified, a dominated one and another model, faster and nearer."""
    return [
        row("accuracy: standard", 0.50001, 0.8),
        row("accuracy: reference", 0.5, 2.0),
        row("accuracy: draft", 0.5005, 0.2),
        row("solver: mbla", 0.50002, 1.5),
        row("solver: clarabel", 0.5, 0.1, status="not_verified", verified=False),
        row("flow_rule: associative", 0.5, 0.1, model="flow_rule"),
    ]


def trade_of(rows: list[Row], name: str = "push", least: float = 0.0) -> CaseTrade:
    """The trade of one load case."""
    answer, accuracy, seconds, verified = (
        np.array([getattr(one, key) for one in rows]) for key in ("answer", "accuracy", "seconds", "verified")
    )
    status = np.array([one.status for one in rows], dtype=object)
    settings = [one.setting for one in rows]
    return trade.trade_of(name, "load factor", settings, status, verified, answer, accuracy, seconds, least)
