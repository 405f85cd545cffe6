"""From the content of a sweep file to the points of its design: axes, along each of which one parameter changes, or
several together, and the points at their positions.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray
from mbla.errors import DeckError, Fault, Message
from mbla.results.listing.text import counted
from mbla.sweeps.design.constraints import constrained
from mbla.sweeps.design.design import Design, DesignAxis, DesignDimension, DesignPoint, Sources
from mbla.sweeps.design.sampling import quantiles
from mbla.sweeps.design.ways import WayError, columns_of, filled, grid_quantiles
from mbla.sweeps.file.content import RANDOM, SAMPLED, key_paths, way_of
from mbla.sweeps.file.parts import PartOfDesign, design_parts
from mbla.sweeps.plan import Plain

RANGES = ("linear", "log", "horizon")
"""ways whose values in a grid must differ"""


def design_of(sources: Sources) -> Design:
    """The design of a sweep; the same for the same content, on every machine.

    Raises DeckError for values that cannot be formed, constraints without a value, and a design that leaves no point.
    """
    parts, axes = _axes_of(sources)
    keep, breaches = constrained(sources.content.constraints, axes, sources.known, sources.fault_at)
    points = _points(axes, np.argwhere(keep).tolist())
    if not points:
        broken = "; ".join(f"{text} is broken by {count}" for text, count in breaches)
        message = f"leave none of {counted(keep.size, 'point')}: {broken}"
        raise DeckError([sources.fault_at(("constraints",), Message("sweep-no-point", message))])
    samples = [axis for axis in axes if axis.sampling]
    sample = samples[0] if len(samples) == 1 else None
    return Design(
        columns=tuple(column for axis in axes for column in axis.columns),
        dimensions=tuple(axis.dimension for axis in axes),
        points=tuple(points),
        levels=tuple(values for axis in axes for values in zip(*axis.values, strict=True)),
        left_out=keep.size - len(points),
        samples="" if sample is None else sample.dimension.name,
        sampling="" if sample is None else sample.sampling,
        parts=tuple(parts),
        breaches=breaches,
        remarks=tuple(_remarks(axes, keep)),
    )


def _points(axes: Sequence[DesignAxis], positions: Sequence[Sequence[int]]) -> list[DesignPoint]:
    """Points at positions, numbered in their order."""
    points: list[DesignPoint] = []
    for number, position in enumerate(positions, start=1):
        values: tuple[Plain, ...] = ()
        settings: dict[str, Plain] = {}
        for axis, place in zip(axes, position, strict=True):
            values += axis.values[place]
            settings.update(axis.settings[place])
        points.append(DesignPoint(number, tuple(position), values, settings))
    return points


def _remarks(axes: Sequence[DesignAxis], keep: BoolArray) -> list[str]:
    """Remarks on samples."""
    remarks: list[str] = []
    samples = [axis for axis in axes if axis.sampling]
    for i, axis in enumerate(axes):
        name, size = axis.dimension.name, axis.dimension.size
        ranges = [column.name for column in axis.columns if not column.random]
        if name.startswith("sobol") and name != axis.columns[0].name and size & (size - 1):
            below = 2 ** (size.bit_length() - 1)
            words = f"{size} points of a Sobol sequence are spread less evenly than a power of two"
            remarks.append(f"{words}: {below} or {2 * below}")
        if 0 < len(ranges) < len(axis.columns):
            remarks.append(
                f"{name}: {', '.join(ranges)} has no distribution, so that shares of these points are no "
                "probabilities: give it one (uniform), or put it into a part of its own"
            )
        if axis.sampling and (keep.any(i) != keep.all(i)).any():
            remarks.append(f"constraints leave out points of {name}: shares of its points are of those that stay")
    if len(samples) > 1:
        names = " and ".join(axis.dimension.name for axis in samples)
        remarks.append(
            f"{names} are combined point by point, so that together they are no random sample: one part for all "
            "random parameters makes them one"
        )
    return remarks


# --- axes -------------------------------------------------------------------------------------------------------------


def _axes_of(sources: Sources) -> tuple[list[tuple[PartOfDesign, tuple[str, ...]]], list[DesignAxis]]:
    """Parts of the design, each with the names of its axes, and the axes, slowest first."""
    parts_made: list[tuple[PartOfDesign, tuple[str, ...]]] = []
    axes: list[DesignAxis] = []
    faults: list[Fault] = []
    taken = set(sources.content.parameters)
    for part in design_parts(sources.content):
        kinds = [part.kind, *(f"{part.kind}_{number}" for number in range(2, len(taken) + 3))]
        try:
            made = _axes_of_part(sources, part, next(name for name in kinds if name not in taken))
        except DeckError as error:
            faults += error.faults
            continue
        taken.update(axis.dimension.name for axis in made)
        axes += made
        parts_made.append((part, tuple(axis.dimension.name for axis in made)))
    if faults:
        raise DeckError(faults)
    return parts_made, axes


def _axes_of_part(sources: Sources, part: PartOfDesign, together: str) -> list[DesignAxis]:
    """The axes of one part; ``together``: name of that of parameters which change together."""
    parameters, sampled = sources.content.parameters, part.kind in SAMPLED
    columns = {
        name: columns_of(name, one, sources.units.get(name, one.unit), sampled and way_of(one) in RANDOM)
        for name, one in ((name, parameters[name]) for name in part.parameters)
    }
    streams = [column.name for own in columns.values() for column in own]
    drawn = iter(quantiles(part.kind, part.points, part.seed or 0, streams).T) if sampled else iter(())
    axes: list[DesignAxis] = []
    faults: list[Fault] = []
    for name, own in columns.items():
        key, keys = way_of(parameters[name]), key_paths(name, parameters[name])
        try:
            u = np.column_stack([next(drawn) for _ in own]) if sampled else grid_quantiles(parameters[name])
            values, settings = filled(parameters[name], u, sources.vectors.get(name))
            if not sampled and key in RANGES and len(set(map(str, values[0]))) < len(u):
                few = f"has {len(u)} points that numbers cannot distinguish: widen the range, or take fewer"
                raise WayError("sweep-values", few)
        except WayError as error:
            faults.append(sources.fault_at(("parameters", name, key), error.message))
        else:
            rows, into = tuple(zip(*values, strict=True)), tuple(dict.fromkeys(keys, value) for value in settings)
            axes.append(DesignAxis(DesignDimension(name, len(rows)), own, rows, into))
    if faults:
        raise DeckError(faults)
    return axes if part.kind == "grid" else [_joined(together, axes, part.kind if sampled else "")]


def _joined(name: str, axes: Sequence[DesignAxis], sampling: str) -> DesignAxis:
    """One axis along which several change together."""
    columns = tuple(replace(column, dimension=name) for axis in axes for column in axis.columns)
    values = [sum(rows, ()) for rows in zip(*(axis.values for axis in axes), strict=True)]
    settings = [
        {key: value for row in rows for key, value in row.items()}
        for rows in zip(*(axis.settings for axis in axes), strict=True)
    ]
    random = all(column.random for column in columns)
    return DesignAxis(
        DesignDimension(name, len(values)), columns, tuple(values), tuple(settings), sampling if random else ""
    )
