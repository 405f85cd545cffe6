"""Parts of the design with the parameters that each of them changes."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.deck.tree import KeyPath
from mbla.sweeps.file.content import DesignPart, Sampled, SweepContent
from mbla.sweeps.file.ways import RANDOM, way_of

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
