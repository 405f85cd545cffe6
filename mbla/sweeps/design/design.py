"""The design of a sweep: its points in their order, and what the columns are in which they differ."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from mbla.sweeps.plan import Plain


@dataclass(frozen=True)
class DesignColumn:
    """One column of the table that the design fills: a parameter, or an angle of a direction.

    name      : of the parameter, with ``_azimuth`` and ``_elevation`` for the angles of directions over a sphere
    unit      : of the deck, or ``degree``; empty for plain numbers and for text
    words     : what it is
    kind      : ``float``, ``int``, ``bool`` or ``text``
    role      : ``parameter``, ``azimuth`` or ``elevation``
    dimension : the axis of the design along which it changes
    random    : it follows a distribution, not only a range
    """

    name: str
    unit: str
    words: str
    kind: str
    role: str
    dimension: str
    random: bool = False


@dataclass(frozen=True)
class Dimension:
    """An axis of the design: a parameter of a grid, or a set of points that change several parameters together.

    name : the parameter's, or that of the kind of design (``zip``, ``sobol``, ...)
    size : positions along it
    """

    name: str
    size: int


@dataclass(frozen=True)
class Part:
    """A part of the design; every point of it is combined with every point of the others.

    kind       : ``grid``, ``zip``, ``random``, ``latin_hypercube`` or ``sobol``
    parameters : their names
    dimensions : names of the axes that it makes: one for each parameter of a grid, one of any other part
    seed       : of a part that is drawn
    """

    kind: str
    parameters: tuple[str, ...]
    dimensions: tuple[str, ...]
    seed: int | None = None


@dataclass(frozen=True, slots=True)
class Point:
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
    parts    : what it is made of, slowest first
    breaches : constraints with how many points break each; a point may break several
    remarks  : what is worth knowing of it, in sentences
    """

    columns: tuple[DesignColumn, ...]
    dimensions: tuple[Dimension, ...]
    points: tuple[Point, ...]
    levels: tuple[tuple[Plain, ...], ...]
    left_out: int = 0
    samples: str = ""
    sampling: str = ""
    parts: tuple[Part, ...] = ()
    breaches: tuple[tuple[str, int], ...] = ()
    remarks: tuple[str, ...] = ()


def design_json(design: Design, points: bool = True) -> dict[str, Any]:
    """Parts, axes, columns and counts of a design; its points too unless they are in a table beside it.

    Keys are those of ``Design``, with ``points`` a list of number, position, values by column and settings by key path.
    """
    record: dict[str, Any] = {
        "parts": [asdict(part) for part in design.parts],
        "dimensions": [asdict(dimension) for dimension in design.dimensions],
        "columns": [asdict(column) for column in design.columns],
        "n_points": len(design.points),
        "left_out": design.left_out,
        "constraints": [{"text": text, "broken_by": count} for text, count in design.breaches],
        "samples": design.samples,
        "sampling": design.sampling,
        "remarks": list(design.remarks),
    }
    if points:
        names = [column.name for column in design.columns]
        record["points"] = [
            {
                "number": point.number,
                "position": list(point.position),
                "values": dict(zip(names, point.values, strict=True)),
                "settings": dict(point.settings),
            }
            for point in design.points
        ]
    return record
