"""Figures of an assessment with names, units and articles: ``figures.csv``."""

from __future__ import annotations

import csv
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files

from mbla.deck.units import Units
from mbla.errors import Message
from mbla.results.assessment import Figure


@cache
def _kinds() -> dict[str, dict[str, str]]:
    text = files("mbla.codes").joinpath("figures.csv").read_text(encoding="utf-8")
    return {row["symbol"]: row for row in csv.DictReader(text.splitlines())}


@dataclass
class Figures:
    """Figures and remarks as they are found, now at one limit state."""

    code: str
    units: Units
    state: str = ""
    figures: list[Figure] = field(default_factory=list)
    remarks: list[Message] = field(default_factory=list)

    def add(self, symbol: str, value: float, words: object = "", article: str = "") -> None:
        """A figure of ``figures.csv``, accelerations in g; ``words`` and ``article`` fill its gaps."""
        kind = _kinds()[symbol.rstrip("0123456789_") if symbol.startswith(("P_", "delta_")) else symbol]
        length = self.units.length
        units = {"acceleration": f"{length}/s2", "length": length, "force": self.units.force}
        size = self.units.standard_gravity if kind["unit"] == "acceleration" else 1.0
        said = kind[self.code].format(article), kind["words"].format(words)
        self.figures.append(Figure(self.state, symbol, value * size, units.get(kind["unit"], kind["unit"]), *said))

    def doubt(self, words: str) -> None:
        """What makes the figures less than they seem."""
        self.remarks.append(Message("assessment-in-doubt", words))
