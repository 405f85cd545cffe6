"""The layout of the HDF5 result file: the stored part of the record, a dataset a quantity, at its place."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product

from mbla.deck.units import Units
from mbla.results.record.quantity import NOT_VERIFIED, Quantity, unit_text
from mbla.results.record.stored import STORED

FILETYPE = "mbla results"
VERSION = 7
"""raised by one with every change that an older reader would misread"""

ATTRIBUTES = {
    "filetype": f'"{FILETYPE}"',
    "version": f"version of this layout, {VERSION}; a reader checks it first",
    "mbla_version": "version of the program that ran the analysis",
    "created": "date of the run, UTC, ISO 8601; the only thing that differs between two runs of one deck and its times",
    "deck_sha256": "hash of the effective deck: sources and overrides",
    "complete": "1; 0 of a run that was stopped: load cases that were done before",
}
"""attributes of the root group"""

SHARED_DIMENSIONS = (
    "block",
    "block_bound",
    "vertex",
    "corner",
    "face",
    "face_bound",
    "interface",
    "interface_bound",
    "point",
    "group",
    "member",
    "position",
    "joint",
    "ground",
    "axis",
    "direction",
    "component",
    "pair",
)
"""dimensions with their scale in the root group, where every group sees it; that of others is beside their dataset"""


def fields_of(cases: Iterable[str]) -> tuple[tuple[str, Quantity], ...]:
    """Path and quantity of every dataset that a file with these load cases may hold, in the order of writing."""
    common = tuple((each.path, each) for each in STORED if "*" not in each.path)
    own = (each for each in STORED if "*" in each.path)
    return common + tuple((each.path.replace("*", name), each) for name, each in product(cases, tuple(own)))


def layout_table() -> str:
    """The datasets as a Markdown table, as it stands in schemas/results.md; units as in a deck in m, N, kg."""
    lines = ["| dataset | type | dimensions | units | content |", "|---|---|---|---|---|"]
    for field in STORED:
        content = field.words + (f" (part: {field.part})" if field.part else "")
        content += f"; {NOT_VERIFIED.format(field.told)}" if field.told else ""
        content += f" (verified where it is {' or '.join(field.proved)})" if field.proved else ""
        dims = ", ".join(field.dims) or "–"
        lines.append(f"| `/{field.path}` | {field.kind} | {dims} | {unit_text(field.unit, Units())} | {content} |")
    return "\n".join(lines) + "\n"
