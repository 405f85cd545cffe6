"""From the content of a sweep file to the points of its design."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mbla.errors import DeckError, Message
from mbla.results.listing.text import counted
from mbla.sweeps.design.axis import Axis, FaultAt, Sources, axes_of
from mbla.sweeps.design.constraints import BoolArray, Constrained, constrained, read_constraints
from mbla.sweeps.design.design import Design, Part, Point
from mbla.sweeps.design.ways import Vector
from mbla.sweeps.file.content import SweepContent
from mbla.sweeps.plan import Plain


def design_of(
    content: SweepContent,
    vectors: Mapping[str, Vector],
    units: Mapping[str, str],
    known: Mapping[str, object],
    fault_at: FaultAt,
) -> Design:
    """The design of a sweep; the same for the same content, on every machine.

    vectors  : by name of a parameter, the vector of the base deck whose direction it turns
    units    : by name of a parameter, the unit of its column
    known    : the base deck's own parameters by name, as they are written: numbers and ``"=..."`` strings
    fault_at : key path of the sweep file and message -> fault

    Raises
    ------
    DeckError
        values that cannot be had, constraints that cannot be read, and a design that leaves no point
    """
    comparisons, unread = read_constraints(content.constraints, fault_at)
    try:
        parts, axes = axes_of(Sources(content, vectors, units, fault_at))
        found = constrained(comparisons, axes, known, fault_at)
    except DeckError as error:
        raise DeckError([*unread, *error.faults]) from error
    if unread:
        raise DeckError(unread)
    points = _points(axes, np.argwhere(found.keep).tolist())
    if not points:
        message = f"leave none of {counted(found.keep.size, 'point')}: {_breaches(found)}"
        raise DeckError([fault_at(("constraints",), Message("sweep-no-point", message))])
    samples = [axis for axis in axes if axis.sampling]
    sample = samples[0] if len(samples) == 1 else None
    left_out = found.keep.size - len(points)
    return Design(
        columns=tuple(column for axis in axes for column in axis.columns),
        dimensions=tuple(axis.dimension for axis in axes),
        points=tuple(points),
        levels=tuple(values for axis in axes for values in zip(*axis.values, strict=True)),
        left_out=left_out,
        samples="" if sample is None else sample.dimension.name,
        sampling="" if sample is None else sample.sampling,
        parts=tuple(parts),
        breaches=found.breaches,
        remarks=(*_remarks(parts, axes), *_cut(axes, found.keep)),
    )


def _points(axes: Sequence[Axis], positions: Sequence[Sequence[int]]) -> list[Point]:
    """Points at positions, numbered in their order."""
    points: list[Point] = []
    for number, position in enumerate(positions, start=1):
        values: tuple[Plain, ...] = ()
        settings: dict[str, Plain] = {}
        for axis, place in zip(axes, position, strict=True):
            values += axis.values[place]
            settings.update(axis.settings[place])
        points.append(Point(number, tuple(position), values, settings))
    return points


def _breaches(found: Constrained) -> str:
    return "; ".join(f"{text} is broken by {count}" for text, count in found.breaches)


def _remarks(parts: Sequence[Part], axes: Sequence[Axis]) -> list[str]:
    """What is worth knowing of samples."""
    by_name = {axis.dimension.name: axis for axis in axes}
    remarks: list[str] = []
    for part in parts:
        axis = by_name[part.dimensions[0]]
        size = axis.dimension.size
        if part.kind == "sobol" and size & (size - 1):
            below = 2 ** (size.bit_length() - 1)
            remarks.append(
                f"{size} points of a Sobol sequence are spread less evenly than a power of two: {below} or {2 * below}"
            )
        ranges = [column.name for column in axis.columns if not column.random]
        if part.seed is not None and 0 < len(ranges) < len(axis.columns):
            remarks.append(
                f"{part.kind}: {', '.join(ranges)} has no distribution, so that shares of these points are no "
                "probabilities: give it one (uniform), or put it into a part of its own"
            )
    samples = [axis for axis in axes if axis.sampling]
    if len(samples) > 1:
        names = " and ".join(axis.dimension.name for axis in samples)
        remarks.append(
            f"{names} are combined point by point, so that together they are no random sample: one part for all "
            "random parameters makes them one"
        )
    return remarks


def _cut(axes: Sequence[Axis], keep: BoolArray) -> list[str]:
    """A remark where constraints leave out some points of a random sample and not others."""
    cut = [axis.dimension.name for i, axis in enumerate(axes) if axis.sampling and (keep.any(i) != keep.all(i)).any()]
    return [f"constraints leave out points of {name}: shares of its points are of those that stay" for name in cut]
