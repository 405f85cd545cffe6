"""One key of the JSON record as a record: path, type, unit, meaning."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.deck.units import Units
from mbla.results.record.quantity import UnitKind, unit_text


@dataclass(frozen=True)
class Key:
    """One key.

    kind : integer, number, string, boolean, object or list, with ``?`` where it may be null
    unit : of its number or numbers
    """

    path: str
    kind: str
    words: str
    unit: UnitKind = "1"

    @property
    def item(self) -> tuple[str, str, str]:
        """Path, type with its unit as in a deck in m, N, kg, and meaning."""
        kind = self.kind if self.unit == "1" else f"{self.kind} [{unit_text(self.unit, Units())}]"
        return self.path, kind, self.words
