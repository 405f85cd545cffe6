"""Parts of the design that a sweep file asks for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mbla.errors import KeyPath
from mbla.sweeps.file.content import RANDOM, SAMPLED, DesignPart, Sampled, SweepContent, way_of

KINDS = tuple(DesignPart.model_fields)


@dataclass(frozen=True)
class PartOfDesign:
    """A part of the design; every point of it is combined with every point of the others.

    kind       : ``grid``, ``zip``, ``random``, ``latin_hypercube`` or ``sobol``
    parameters : their names, in the order of the part
    path       : place of the part in the sweep file, for messages
    of         : names as the file gives them; None where it leaves that to the rest
    points     : of a sample; 0 for grid and zip
    seed       : of a sample
    """

    kind: str
    parameters: tuple[str, ...]
    path: KeyPath
    of: Sequence[str] | None = None
    points: int = 0
    seed: int | None = None


def design_parts(content: SweepContent) -> tuple[PartOfDesign, ...]:
    """Parts in their order; a grid of all parameters where the file gives none.

    Names that are no parameters are left out here, and a second part without `of` is empty: both are reported where
    the file is read.
    """
    if content.design is None:
        return (PartOfDesign("grid", tuple(content.parameters), ("parameters",)),)
    sections = [(kind, getattr(each, kind)) for each in content.design for kind in KINDS if getattr(each, kind)]
    named = {name for _, section in sections for name in section.of or ()}
    rest = tuple(name for name in content.parameters if name not in named)
    parts = []
    for index, (kind, section) in enumerate(sections):
        names = rest if section.of is None else tuple(name for name in section.of if name in content.parameters)
        sampled = (section.points, section.seed) if isinstance(section, Sampled) else ()
        parts.append(PartOfDesign(kind, names, ("design", index, kind), section.of, *sampled))
        rest = () if section.of is None else rest
    return tuple(parts)


def is_random(part: PartOfDesign, content: SweepContent) -> bool:
    """Whether the points of a part are a random sample: drawn, and every parameter with a probability."""
    return part.kind in SAMPLED and all(way_of(content.parameters[name]) in RANDOM for name in part.parameters)
