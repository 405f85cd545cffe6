"""What the keys of the JSON record mean, as one table; it makes a section of schemas/results.md and a test holds it.

A path names keys with full stops between them; ``[]`` is each item of a list, ``*`` each key that the deck names. Types
are those of JSON; a question mark: or null, where there is no such value. A row of ``keys.csv`` is a key, or ``{a,b}``
in its path several; rows of kind ``stored`` and ``columns`` stand for quantities of the record below their path: those
named, at a place of the result file, or all of a load case. Rows of ``check`` are keys of ``mbla check`` alone.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from mbla.deck.units import Units
from mbla.results.record.columns import CASE_COLUMNS
from mbla.results.record.quantity import STORED_BY_PATH, Quantity, UnitKind, rows_of, unit_text

KINDS = {"float": "number?", "int": "integer", "bool": "boolean", "text": "string?"}
"""types in JSON: numbers must be finite there, and texts not empty"""
CHECK = "needs"
"""first key of what only ``mbla check`` reports"""


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


def _keys() -> Iterator[tuple[str, Key]]:
    """Every key, and ``check`` where it is of a check alone."""
    for row in rows_of("keys.csv"):
        for path in _expanded(row["path"]):
            of = "check" if path.startswith(CHECK) else row["of"]
            if row["kind"] == "columns":
                yield from ((of, key) for key in _columns(path))
            elif row["kind"] == "stored":
                yield from ((of, key) for key in _stored(path, row["unit"], row["words"]))
            else:
                yield of, Key(path, row["kind"], row["words"], row["unit"] or "1")


def _expanded(path: str) -> Iterator[str]:
    """A path for each of the names in braces."""
    found = re.search(r"\{(.+?)\}", path)
    if found is None:
        yield path
        return
    for name in found[1].split(","):
        yield from _expanded(f"{path[: found.start()]}{name}{path[found.end() :]}")


def _key(path: str, quantity: Quantity, kind: str) -> Key:
    return Key(path, kind, quantity.words, quantity.unit)


def _stored(owner: str, place: str, names: str) -> Iterator[Key]:
    """Quantities of the result file, a question mark behind those that may be null."""
    for name in names.split():
        quantity = STORED_BY_PATH[f"{place}/{name.rstrip('?')}"]
        kind = KINDS[quantity.kind].rstrip("?") + "?" * name.endswith("?")
        yield _key(f"{owner}.{quantity.name}", quantity, kind)


def _columns(owner: str) -> Iterator[Key]:
    """Single values of a load case."""
    for column in CASE_COLUMNS:
        quantity, path = column.quantity, f"{owner}.{column.quantity.name}"
        if "json" not in column.files:
            continue
        if quantity.dims == ("sentence",):
            yield from (Key(path, "list", quantity.words), Key(f"{path}[]", "string", "a sentence"))
        elif quantity.dims:
            yield from (_key(path, quantity, "list?"), _key(f"{path}[]", quantity, "number?"))
        else:
            yield _key(path, quantity, "boolean?" if column.names else KINDS[quantity.kind])


RECORD: tuple[Key, ...] = tuple(key for _, key in _keys())
RUN_RECORD: tuple[Key, ...] = tuple(key for of, key in _keys() if not of)
"""keys of the record of a run"""
