"""Axes of a design: along each of them one parameter changes, or several change together."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from mbla.deck.suggestions import listed
from mbla.deck.tree import KeyPath
from mbla.errors import DeckError, Fault, Message
from mbla.sweeps.design.design import DesignColumn, Dimension, Part
from mbla.sweeps.design.sampling import quantiles
from mbla.sweeps.design.ways import WAYS, Filled, Form, Vector, Way, WayError
from mbla.sweeps.file import parts
from mbla.sweeps.file.content import SweepContent
from mbla.sweeps.file.parts import key_paths, way_of
from mbla.sweeps.plan import Plain

FaultAt: TypeAlias = Callable[[KeyPath, Message], Fault]
ANGLES = ("azimuth", "elevation")


@dataclass(frozen=True)
class Axis:
    """An axis with what the design has at each position along it.

    columns  : those that change along it
    values   : one for each position and column
    settings : values by key path of the deck, one mapping for each position
    sampling : kind of design whose points are a random sample of distributions; empty otherwise
    """

    dimension: Dimension
    columns: tuple[DesignColumn, ...]
    values: tuple[tuple[Plain, ...], ...]
    settings: tuple[Mapping[str, Plain], ...]
    sampling: str = ""


@dataclass(frozen=True)
class Sources:
    """What parameters are made from.

    vectors : by name of a parameter, the vector of the base deck that its directions turn
    units   : by name of a parameter, the unit of its column
    """

    content: SweepContent
    vectors: Mapping[str, Vector]
    units: Mapping[str, str]
    fault_at: FaultAt


def axes_of(sources: Sources) -> tuple[list[Part], list[Axis]]:
    """Parts and axes of the design, slowest first.

    Raises
    ------
    DeckError
        with what is wrong with values of parameters
    """
    told: list[Part] = []
    axes: list[Axis] = []
    faults: list[Fault] = []
    taken = set(sources.content.parameters)
    for part in parts.design_parts(sources.content):
        try:
            made = _axes_of_part(sources, part)
        except DeckError as error:
            faults += error.faults
            continue
        if part.kind != "grid":
            made = [_renamed(made[0], _free(part.kind, taken))]
        taken.update(axis.dimension.name for axis in made)
        axes += made
        seed = part.seed if part.kind in parts.SAMPLED else None
        told.append(Part(part.kind, part.names, tuple(axis.dimension.name for axis in made), seed))
    if faults:
        raise DeckError(faults)
    return told, axes


def _axes_of_part(sources: Sources, part: parts.Part) -> list[Axis]:
    """The axes of one part; that of parameters which change together has the name of the kind."""
    if part.kind in parts.SAMPLED:
        return [_drawn(sources, part)]
    axes = _each(sources, part.names, lambda name: _levels(sources, name))
    return axes if part.kind == "grid" else [_joined(part.kind, axes)]


def _drawn(sources: Sources, part: parts.Part) -> Axis:
    """Parameters drawn together."""
    owners: list[str] = []
    streams: list[str] = []
    for name in part.names:
        how, section = _way(sources, name)
        forms = how.forms(section)
        owners += [name] * len(forms)
        streams += [name + form.suffix for form in forms]
    u = quantiles(part.kind, part.points, part.seed, streams)
    own = {name: [i for i, owner in enumerate(owners) if owner == name] for name in part.names}

    def axis(name: str) -> Axis:
        how, section = _way(sources, name)
        return _axis(sources, name, how.at(section, u[:, own[name]], sources.vectors.get(name)), how.random)

    whole = _joined(part.kind, _each(sources, part.names, axis))
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
    return _axis(sources, name, how.levels(section, sources.vectors.get(name)), random=False)


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


def _column(name: str, form: Form, unit: str, keys: Sequence[str], random: bool) -> DesignColumn:
    of = listed(keys, "and")
    words = {
        "parameter": f"value of {of}",
        "azimuth": f"azimuth of {of}, from +x towards +y",
        "elevation": f"elevation of {of} above the horizon",
    }[form.role]
    shown = "degree" if form.role in ANGLES else "" if form.kind in ("text", "bool") else unit
    return DesignColumn(name + form.suffix, shown, words, form.kind, form.role, name, random)


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
