"""The part of the record that the result file holds, from which everything else follows: the rows of ``stored.csv``.

A row has the fields of a :class:`Quantity`; ``rule`` is ``index of DIMENSION``, ``start of DIMENSION`` or ``open``.
Rows of ``ANSWER`` stand for one of each answer, ``WHOSE`` for what that is.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator
from importlib.resources import files

from mbla.results.record.quantity import PASSED, TOLD, Quantity
from mbla.solution.solution import PROVED_STANDING

ANSWERS = {
    "mechanics": ("", "by the deck's flow rule"),
    "associative": ("/associative", "by the associative flow rule, where that is not the deck's"),
    "lower": ("/lower", "the least for the mechanism found"),
    "upper": ("/upper", "the greatest for the mechanism found"),
    "peak": ("/peak", "the greatest of the load path, passed before the structure comes to rest"),
    "outer": ("/outer", "with the circumscribed friction polyhedron"),
    "level": ("/level", "of the level table with the load across, by the associative flow rule"),
}
"""answers of a solution: group below the load case, and whose forces and velocities they are"""
OF_MECHANISM = ("contact_velocities", "mechanism", "modes")
"""quantities of an answer that at a peak nothing proves"""
PROVED = {"cases/*/standing/verdict": tuple(verdict.value for verdict in PROVED_STANDING)}
"""texts that are verified although others of their quantity are not"""


def rows_of(name: str) -> Iterator[dict[str, str]]:
    """Rows of a table of the record by the names of its columns."""
    text = files("mbla.results.record").joinpath(name).read_text(encoding="utf-8")
    yield from csv.DictReader(text.splitlines())


def _stored() -> Iterator[Quantity]:
    rows = list(rows_of("stored.csv"))
    own = [row for row in rows if "ANSWER" in row["place"]]
    first = rows.index(own[0])
    for row in (row for row in rows[:first] if row not in own):
        yield _quantity(row)
    for answer, (group, whose) in ANSWERS.items():
        for row in own:
            part, words = row["part"].replace("ANSWER", answer), row["words"].replace("WHOSE", whose)
            told = PASSED if answer == "peak" and row["name"] in OF_MECHANISM else ""
            yield _quantity(row | {"place": f"cases/*{group}", "part": part, "words": words}, told)
    for row in (row for row in rows[first:] if row not in own):
        yield _quantity(row)


def _quantity(row: dict[str, str], told: str = "") -> Quantity:
    kind, _, dimension = row["rule"].partition(" of ")
    return Quantity(
        name=row["name"],
        kind=row["kind"],  # type: ignore[arg-type]
        words=row["words"],
        unit=row["unit"] or "1",  # type: ignore[arg-type]
        dims=tuple(row["dims"].split()),
        place=row["place"],
        index_of=dimension if kind == "index" else "",
        start_of=dimension if kind == "start" else "",
        open=kind == "open",
        part=row["part"],
        told=told or (TOLD[row["told"]] if row["told"] else ""),
        proved=PROVED.get(f"{row['place']}/{row['name']}", ()),
    )


STORED: tuple[Quantity, ...] = tuple(_stored())
"""in the order of writing"""
STORED_BY_PATH: dict[str, Quantity] = {each.path: each for each in STORED}


def stored(kind: type, place: str) -> tuple[str, ...]:
    """Fields of a dataclass that the result file holds at a place, by the name that both have."""
    names = kind.__dataclass_fields__  # type: ignore[attr-defined]
    return tuple(name for name in names if f"{place}/{name}" in STORED_BY_PATH)
