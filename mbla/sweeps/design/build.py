"""From the content of a sweep file to the points of its design: axes, along each of which one parameter changes, or
several together, and the points at their positions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mbla.arrays import BoolArray
from mbla.deck.suggestions import listed
from mbla.errors import DeckError, Fault, Message
from mbla.results.listing.text import counted
from mbla.sweeps.design.constraints import constrained
from mbla.sweeps.design.design import Axis, Design, Dimension, Point, Sources, SweepColumn
from mbla.sweeps.design.sampling import quantiles
from mbla.sweeps.design.ways import RANGES, WAYS, Filled, Form, Way, WayError
from mbla.sweeps.file.content import RANDOM, SAMPLED, Part, design_parts, key_paths, way_of
from mbla.sweeps.plan import Plain

ANGLES = ("azimuth", "elevation")


def design_of(sources: Sources) -> Design:
    """The design of a sweep; the same for the same content, on every machine.

    Raises
    ------
    DeckError
        values that cannot be had, constraints that have no value, and a design that leaves no point
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
        remarks=(*_remarks(parts, axes), *_cut(axes, keep)),
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


def _remarks(parts: Sequence[tuple[Part, tuple[str, ...]]], axes: Sequence[Axis]) -> list[str]:
    """What is worth knowing of samples."""
    by_name = {axis.dimension.name: axis for axis in axes}
    remarks: list[str] = []
    for part, names in parts:
        axis = by_name[names[0]]
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
        told = " and ".join(axis.dimension.name for axis in samples)
        remarks.append(
            f"{told} are combined point by point, so that together they are no random sample: one part for all "
            "random parameters makes them one"
        )
    return remarks


def _cut(axes: Sequence[Axis], keep: BoolArray) -> list[str]:
    """A remark where constraints leave out some points of a random sample and not others."""
    cut = [axis.dimension.name for i, axis in enumerate(axes) if axis.sampling and (keep.any(i) != keep.all(i)).any()]
    return [f"constraints leave out points of {name}: shares of its points are of those that stay" for name in cut]


# --- axes -------------------------------------------------------------------------------------------------------------


def _axes_of(sources: Sources) -> tuple[list[tuple[Part, tuple[str, ...]]], list[Axis]]:
    """Parts of the design, each with the names of its axes, and the axes, slowest first."""
    told: list[tuple[Part, tuple[str, ...]]] = []
    axes: list[Axis] = []
    faults: list[Fault] = []
    taken = set(sources.content.parameters)
    for part in design_parts(sources.content):
        try:
            made = _axes_of_part(sources, part)
        except DeckError as error:
            faults += error.faults
            continue
        if part.kind != "grid":
            made = [_renamed(made[0], _free(part.kind, taken))]
        taken.update(axis.dimension.name for axis in made)
        axes += made
        told.append((part, tuple(axis.dimension.name for axis in made)))
    if faults:
        raise DeckError(faults)
    return told, axes


def _axes_of_part(sources: Sources, part: Part) -> list[Axis]:
    """The axes of one part; that of parameters which change together has the name of the kind."""
    if part.kind in SAMPLED:
        return [_drawn(sources, part)]
    axes = _each(sources, part.parameters, lambda name: _levels(sources, name))
    return axes if part.kind == "grid" else [_joined(part.kind, axes)]


def _drawn(sources: Sources, part: Part) -> Axis:
    """Parameters drawn together."""
    owners: list[str] = []
    streams: list[str] = []
    for name in part.parameters:
        how, section = _way(sources, name)
        forms = how.forms(section)
        owners += [name] * len(forms)
        streams += [name + form.suffix for form in forms]
    u = quantiles(part.kind, part.points, part.seed or 0, streams)
    own = {name: [i for i, owner in enumerate(owners) if owner == name] for name in part.parameters}

    def axis(name: str) -> Axis:
        how, section = _way(sources, name)
        return _axis(
            sources,
            name,
            how.at(section, u[:, own[name]], sources.vectors.get(name)),
            way_of(sources.content.parameters[name]) in RANDOM,
        )

    whole = _joined(part.kind, _each(sources, part.parameters, axis))
    return replace(whole, sampling=part.kind if all(column.random for column in whole.columns) else "")


def _each(sources: Sources, names: Sequence[str], axis_of: Callable[[str], Axis]) -> list[Axis]:
    """An axis for each parameter, all faults told together."""
    axes: list[Axis] = []
    faults: list[Fault] = []
    for name in names:
        try:
            axes.append(axis_of(name))
        except WayError as error:
            key = way_of(sources.content.parameters[name])
            faults.append(sources.fault_at(("parameters", name, key), error.message))
    if faults:
        raise DeckError(faults)
    return axes


def _way(sources: Sources, name: str) -> tuple[Way, Any]:
    """The way in which a parameter says its values, and what it says."""
    parameter = sources.content.parameters[name]
    key = way_of(parameter)
    return WAYS[key], getattr(parameter, key)


def _levels(sources: Sources, name: str) -> Axis:
    how, section = _way(sources, name)
    assert how.grid is not None  # a sweep file with a distribution in a grid is refused
    filled = how.at(section, how.grid(section), sources.vectors.get(name))
    values = filled.columns[0]
    if way_of(sources.content.parameters[name]) in RANGES and len(set(map(str, values))) < len(values):
        few = f"has {len(values)} points that numbers do not tell apart: widen the range, or take fewer"
        raise WayError("sweep-values", few)
    return _axis(sources, name, filled, random=False)


def _axis(sources: Sources, name: str, filled: Filled, random: bool) -> Axis:
    """The axis of one parameter, under its name."""
    parameter = sources.content.parameters[name]
    how, section = _way(sources, name)
    keys = key_paths(name, parameter)
    unit = sources.units.get(name, parameter.unit)
    columns = tuple(_column(name, form, unit, keys, random) for form in how.forms(section))
    return Axis(
        Dimension(name, len(filled.settings)),
        columns,
        tuple(zip(*filled.columns, strict=True)),
        tuple(dict.fromkeys(keys, value) for value in filled.settings),
    )


def _column(name: str, form: Form, unit: str, keys: Sequence[str], random: bool) -> SweepColumn:
    of = listed(keys, "and")
    words = {
        "parameter": f"value of {of}",
        "azimuth": f"azimuth of {of}, from +x towards +y",
        "elevation": f"elevation of {of} above the horizon",
    }[form.role]
    shown = "degree" if form.role in ANGLES else "" if form.kind in ("text", "bool") else unit
    return SweepColumn(name + form.suffix, shown, words, form.kind, form.role, name, random)


def _joined(name: str, axes: Sequence[Axis]) -> Axis:
    """One axis along which several change together."""
    columns = tuple(column for axis in axes for column in axis.columns)
    values = tuple(
        tuple(value for row in rows for value in row) for rows in zip(*(axis.values for axis in axes), strict=True)
    )
    settings = tuple(
        {key: value for row in rows for key, value in row.items()}
        for rows in zip(*(axis.settings for axis in axes), strict=True)
    )
    return Axis(Dimension(name, len(values)), columns, values, settings)


def _renamed(axis: Axis, name: str) -> Axis:
    """An axis with its columns under another name."""
    columns = tuple(replace(column, dimension=name) for column in axis.columns)
    return replace(axis, dimension=Dimension(name, axis.dimension.size), columns=columns)


def _free(kind: str, taken: set[str]) -> str:
    """``sobol``, or ``sobol_2`` where there is one already."""
    names = [kind, *(f"{kind}_{number}" for number in range(2, len(taken) + 3))]
    return next(name for name in names if name not in taken)
