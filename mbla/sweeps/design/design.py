"""The design of a sweep: points in their order, what the columns are in which they differ, and all of it in words."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, TypeAlias

from mbla.deck.suggestions import listed
from mbla.errors import Fault, KeyPath, Message
from mbla.results.listing.text import INDENT, counted, entry, heading, sentence, shortened, table
from mbla.sweeps.file.content import SweepContent
from mbla.sweeps.file.parts import PartOfDesign
from mbla.sweeps.plan import Plain

FaultAt: TypeAlias = Callable[[KeyPath, Message], Fault]
"""fault for a place in the sweep file and a message"""
TurnedVector: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True)
class Sources:
    """What a design is made from.

    vectors  : by name of a parameter, the vector of the base deck that its directions turn
    units    : by name of a parameter, the unit of its column
    known    : the base deck's own parameters by name, as they are written: numbers and ``"=..."`` strings
    fault_at : key path of the sweep file and message -> fault
    """

    content: SweepContent
    vectors: Mapping[str, TurnedVector]
    units: Mapping[str, str]
    known: Mapping[str, object]
    fault_at: FaultAt


@dataclass(frozen=True)
class SweepColumn:
    """One column of the table of a sweep.

    name      : of a parameter, with ``_azimuth`` and ``_elevation`` for the angles of directions over a sphere
    unit      : of the deck, or ``degree``; empty for plain numbers and for text
    words     : what it is
    kind      : ``float``, ``int``, ``bool`` or ``text``
    role      : ``number`` of the point; ``parameter``, ``azimuth``, ``elevation`` of the design; ``state``,
                ``exit_code``, ``reason``, ``tries``, ``seconds``; ``result``
    dimension : the axis of the design along which a parameter changes, empty for others
    random    : of a parameter: it follows a distribution, not only a range
    case      : load case of a result, empty for others
    path      : key path of a result in the JSON object of its case or run, empty for others
    """

    name: str
    unit: str
    words: str
    kind: str
    role: str
    dimension: str = ""
    random: bool = False
    case: str = ""
    path: str = ""

    @property
    def header(self) -> str:
        """``thickness [m]``; the name alone where there is no unit."""
        return header_of(self.name, self.unit)


def header_of(name: str, unit: str) -> str:
    """A name with its unit, as headers of tables have it."""
    return f"{name} [{unit}]" if unit else name


@dataclass(frozen=True)
class DesignDimension:
    """An axis of the design: a parameter of a grid, or a set of points that change several parameters together.

    name : the parameter's, or that of the kind of design (``zip``, ``sobol``, ...)
    size : positions along it
    """

    name: str
    size: int


@dataclass(frozen=True)
class DesignAxis:
    """An axis with what the design has at each position along it.

    columns  : those that change along it
    values   : one for each position and column
    settings : values by key path of the deck, one mapping for each position
    sampling : kind of design whose points are a random sample of distributions; empty otherwise
    """

    dimension: DesignDimension
    columns: tuple[SweepColumn, ...]
    values: tuple[tuple[Plain, ...], ...]
    settings: tuple[Mapping[str, Plain], ...]
    sampling: str = ""


@dataclass(frozen=True, slots=True)
class DesignPoint:
    """One point.

    number   : from 1, in the order of the design; those that constraints leave out have none
    position : along each dimension, from 0
    values   : one for each column
    settings : values by key path of the deck, as ``--set`` takes them
    """

    number: int
    position: tuple[int, ...]
    values: tuple[Plain, ...]
    settings: Mapping[str, Plain]


@dataclass(frozen=True)
class Design:
    """All points of a sweep; the last dimension changes fastest.

    levels   : of each column, its values along its dimension, also those at which constraints leave no point
    left_out : points that broke a constraint
    samples  : name of the dimension whose points are a random sample of distributions; empty where there is none
    sampling : ``random``, ``latin_hypercube`` or ``sobol`` for that; empty where there is none
    parts    : what it is made of, slowest first, each with the names of the axes that it makes: one for each parameter
               of a grid, one of any other part
    breaches : constraints with how many points break each; a point may break several
    remarks  : remarks on it, in sentences
    """

    columns: tuple[SweepColumn, ...]
    dimensions: tuple[DesignDimension, ...]
    points: tuple[DesignPoint, ...]
    levels: tuple[tuple[Plain, ...], ...]
    left_out: int = 0
    samples: str = ""
    sampling: str = ""
    parts: tuple[tuple[PartOfDesign, tuple[str, ...]], ...] = ()
    breaches: tuple[tuple[str, int], ...] = ()
    remarks: tuple[str, ...] = ()


def design_json(design: Design) -> dict[str, Any]:
    """Parts, axes, columns, counts and points of a design; keys are those of ``Design``."""
    names = [column.name for column in design.columns]
    return {
        "parts": [
            {"kind": part.kind, "parameters": part.parameters, "dimensions": dimensions, "seed": part.seed}
            for part, dimensions in design.parts
        ],
        "dimensions": [asdict(dimension) for dimension in design.dimensions],
        "columns": [asdict(column) for column in design.columns],
        "n_points": len(design.points),
        "left_out": design.left_out,
        "constraints": [{"text": text, "broken_by": count} for text, count in design.breaches],
        "samples": design.samples,
        "sampling": design.sampling,
        "remarks": list(design.remarks),
        "points": [
            {
                "number": point.number,
                "position": list(point.position),
                "values": dict(zip(names, point.values, strict=True)),
                "settings": dict(point.settings),
            }
            for point in design.points
        ],
    }


LONGEST = 24
"""characters of a text; of a longer one the middle is left out"""


def design_lines(design: Design) -> list[str]:
    """Parts, totals, what constraints leave out, remarks, and a table of all points."""
    lines = [*heading("Design")]
    sizes = {dimension.name: dimension.size for dimension in design.dimensions}
    for part, names in design.parts:
        lines += entry(part.kind, _part_words(part, names, sizes))
    lines += entry("points", str(len(design.points)))
    if design.breaches:
        lines += entry("left out by constraints", f"{design.left_out} of {len(design.points) + design.left_out}")
    for text, count in design.breaches:
        lines += entry(f"{INDENT}{shortened(text, LONGEST)}", f"broken by {count}")
    for remark in design.remarks:
        lines += ["", *sentence(remark)]
    head = ["point", *(column.header for column in design.columns)]
    rows = [[str(point.number), *map(_cell, point.values)] for point in design.points]
    return [*lines, *heading("Points"), *table(head, rows, left=0)]


def _part_words(part: PartOfDesign, dimensions: Sequence[str], sizes: dict[str, int]) -> str:
    if part.kind == "grid":
        return " × ".join(f"{name} ({sizes[name]})" for name in dimensions)
    together = f"{listed(part.parameters, 'and')}: {counted(sizes[dimensions[0]], 'point')}"
    return together if part.seed is None else f"{together}, seed {part.seed}"


def _cell(value: Plain) -> str:
    return f"{value:.6g}" if isinstance(value, float) else shortened(str(value), LONGEST)
