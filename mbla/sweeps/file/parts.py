"""Parameters and parts of a checked sweep file: keys that they set, how they say values, what changes together."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.deck.tree import KeyPath
from mbla.sweeps.file.content import DesignPart, Parameter, Sampled, SweepContent

DISTRIBUTIONS = ("normal", "lognormal", "uniform", "triangular")
"""they have no levels: a grid cannot take them"""
WITH_POINTS = ("linear", "log", "horizon", "sphere")
"""they need a number of points where they are levels, and have none where they are sampled"""
WAYS = ("values", "linear", "log", "whole", *DISTRIBUTIONS, "horizon", "sphere")
RANDOM = (*DISTRIBUTIONS, "whole", "horizon", "sphere")
"""drawn values of these have a probability; those of plain ranges and lists only fill the space"""
DIRECTIONS = ("horizon", "sphere")
"""they turn a vector of the deck"""


def way_of(parameter: Parameter) -> str:
    """The one way that a checked parameter uses."""
    return next(way for way in WAYS if getattr(parameter, way) is not None)


def level_count(parameter: Parameter) -> int | None:
    """How many values a parameter has in a grid; None where it does not say, or has no levels."""
    if parameter.values is not None:
        return len(parameter.values)
    if parameter.whole is not None:
        return parameter.whole.end - parameter.whole.start + 1
    points: int | None = getattr(getattr(parameter, way_of(parameter)), "points", None)
    return points


def key_paths(name: str, parameter: Parameter) -> tuple[str, ...]:
    """Key paths of a parameter: those that it gives, or what its name stands for."""
    if parameter.key is None:
        return (name if "." in name else f"parameters.{name}",)
    return (parameter.key,) if isinstance(parameter.key, str) else tuple(parameter.key)


def spelt(key: str) -> tuple[str, ...]:
    """Parts of a key path, numbers of items in one spelling: ``blocks.00.box`` is ``blocks.0.box``."""
    return tuple(str(int(part)) if part.isascii() and part.isdecimal() else part for part in key.strip().split("."))


KINDS = tuple(DesignPart.model_fields)
SAMPLED = ("random", "latin_hypercube", "sobol")


@dataclass(frozen=True)
class Part:
    """One part.

    kind   : key of ``DesignPart``
    names  : parameters in the order of the part
    points : of a sample; 0 for grid and zip
    seed   : of a sample
    path   : place of the part in the sweep file, for messages
    """

    kind: str
    names: tuple[str, ...]
    points: int
    seed: int
    path: KeyPath


def design_parts(content: SweepContent) -> tuple[Part, ...]:
    """Parts in their order; a grid of all parameters where the file gives none.

    Names that are no parameters are left out here, and a second part without `of` is empty: both are reported where
    the file is read.
    """
    if content.design is None:
        return (Part("grid", tuple(content.parameters), 0, 0, ("parameters",)),)
    named = {name for each in content.design for name in (getattr(each, _kind(each)).of or ())}
    rest = tuple(name for name in content.parameters if name not in named)
    parts = []
    for index, each in enumerate(content.design):
        parts.append(_part(index, each, rest, content))
        rest = () if getattr(each, _kind(each)).of is None else rest
    return tuple(parts)


def is_random(part: Part, content: SweepContent) -> bool:
    """Whether the points of a part are a random sample: drawn, and every parameter with a probability."""
    return part.kind in SAMPLED and all(way_of(content.parameters[name]) in RANDOM for name in part.names)


def _part(index: int, each: DesignPart, rest: tuple[str, ...], content: SweepContent) -> Part:
    kind = _kind(each)
    section = getattr(each, kind)
    names = rest if section.of is None else tuple(name for name in section.of if name in content.parameters)
    sampled = isinstance(section, Sampled)
    points, seed = (section.points, section.seed) if sampled else (0, 0)
    return Part(kind, names, points, seed, ("design", index, kind))


def _kind(each: DesignPart) -> str:
    return next(kind for kind in KINDS if getattr(each, kind) is not None)
