"""Rows and trades made by hand."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from mbla.sweeps.tradeoff.ladder import Rung
from mbla.sweeps.tradeoff.trade import CaseTrade, Row, case_trade

SOLVED = Row(Rung(""), status="solved", verified=True, answer=0.5, accuracy=1e-9, seconds=1.0)


def row(name: str, answer: float, seconds: float, model: str = "", **changes: Any) -> Row:
    """A solved and verified load factor that took so many seconds."""
    key, _, value = name.partition(": ")
    rung = Rung(name, {f"analysis.{key}": value}, model=model)
    return replace(SOLVED, rung=rung, answer=answer, seconds=seconds, **changes)


def ladder() -> list[Row]:
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
    return case_trade(name, rows, least)
