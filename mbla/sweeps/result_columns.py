"""What results of a sweep are: their paths checked against the description of the JSON record, types and units."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mbla.deck.suggestions import did_you_mean, listed
from mbla.deck.units import Units
from mbla.results.hdf5.field import unit_text
from mbla.results.records.description import RUN_RECORD
from mbla.results.records.key import Key
from mbla.sweeps.results import OF_RUN, result_places
from mbla.sweeps.tables.sweep_table import SweepColumn

KINDS = {"integer": "int", "number": "float", "string": "text", "boolean": "bool"}
"""types of JSON that fill a column, and what the column is called"""
OWNERS = ("cases[].", "series[].")
"""what stands before the paths of load cases in the description; a travelling load has both"""


def result_columns(results: Sequence[str], cases: Sequence[str], units: Units) -> tuple[SweepColumn, ...]:
    """The columns of results in their order, as ``result_places`` names them, in a deck's units.

    The paths must have passed ``result_faults``.
    """
    columns = []
    for place in result_places(results, cases):
        key = _key_at(place.path)
        if key is None:
            raise AssertionError(f"{'.'.join(place.path)} was not checked")
        unit = "" if key.unit == "1" else unit_text(key.unit, units)
        path = ".".join(place.path)
        columns.append(
            SweepColumn(
                place.name,
                unit,
                key.words.replace("null", "empty"),
                KINDS[_kind(key)],
                "result",
                case=place.case,
                path=path,
            )
        )
    return tuple(columns)


def result_faults(results: Sequence[str], cases: Sequence[str] = ()) -> tuple[tuple[int, str], ...]:
    """Row and fault, in words, of every path that cannot be a column; cases: names of the load cases, if known."""
    faults = []
    for row, path in enumerate(results):
        words = "stands twice" if path in results[:row] else _fault(path, cases)
        if words:
            faults.append((row, words))
    return tuple(faults)


def _fault(path: str, cases: Sequence[str]) -> str:
    parts = tuple(path.split("."))
    key = _key_at(parts)
    if key is None:
        if parts[0] in cases and _key_at(parts[1:]) is not None:
            return f"stands without its load case, as {'.'.join(parts[1:])}: each load case gets a column of it"
        hint = did_you_mean(path, [name for name, _ in _named_keys()])
        return f"is no result{hint or '; results are the keys of `cases[]` in schemas/results.md'}"
    if _kind(key) in KINDS:
        return ""
    inside = [name for name, _ in _named_keys() if name.startswith(f"{path}.")]
    inside = [name for name in inside if name.count(".") == path.count(".") + 1] or inside
    return f"is {'an object' if _kind(key) == 'object' else 'a list'}, no single value; take {listed(inside)}"


def _kind(key: Key) -> str:
    return key.kind.rstrip("?")


def _key_at(path: Sequence[str]) -> Key | None:
    """The description of what is at a path; a single value before an object where names with full stops allow both."""
    found = [key for steps, key in _described() if _fits(path, steps)]
    return next((key for key in found if _kind(key) in KINDS), found[0] if found else None)


def _described() -> Iterator[tuple[tuple[str, ...], Key]]:
    """Steps from the object of a load case, or of the run, and the key there; ``[]`` is a step of its own."""
    for key in RUN_RECORD:
        owner = next((owner for owner in OWNERS if key.path.startswith(owner)), "")
        path = key.path.removeprefix(owner)
        if owner or path.partition(".")[0] in OF_RUN:
            yield tuple(path.replace("[]", ".[]").split(".")), key


def _named_keys() -> Iterator[tuple[str, Key]]:
    """Paths as a sweep file may have them, of single values: item 0 of lists, NAME where the deck names keys."""
    for steps, key in _described():
        if _kind(key) in KINDS:
            yield ".".join({"[]": "0", "*": "NAME"}.get(step, step) for step in steps), key


def _fits(path: Sequence[str], steps: Sequence[str]) -> bool:
    """Whether a path follows these steps; names that the deck gives may have full stops in them."""
    if not steps or not path:
        return not steps and not path
    if steps[0] == "*":
        return any(_fits(path[count:], steps[1:]) for count in range(1, len(path) + 1))
    fits = path[0].isdecimal() if steps[0] == "[]" else path[0] == steps[0]
    return fits and _fits(path[1:], steps[1:])
