"""Load `gravity`: the mass m of blocks, own and added, times an acceleration, F = m g.

It acts in every load case: where its dead loads have none, as 9.81 m/s2 along -z.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Any, Literal, TypeAlias

import numpy as np
from pydantic import Discriminator, Tag

from mbla.arrays import FloatArray, IntArray
from mbla.deck.kinds.load_key import register_load
from mbla.deck.quantities import Acceleration, Vector
from mbla.deck.sections.any_load import AnyLoad
from mbla.deck.units import Units
from mbla.errors import KeyPath
from mbla.model.applied_load import AppliedLoad
from mbla.model.loads.load_kind import Entry, LoadKind, LoadSite
from mbla.model.loads.mass_forces import mass_forces
from mbla.model.wording import vector

GRAVITY = "gravity"
"""its key"""

Gravity: TypeAlias = Annotated[
    Annotated[Literal["none"], Tag("name")] | Annotated[tuple[Acceleration, Acceleration, Acceleration], Tag("list")],
    Discriminator(lambda value: "name" if isinstance(value, str) else "list"),
]


def vector_of(value: Any) -> Vector:
    """The acceleration in the deck's unit of length per s2, from ``Gravity``."""
    return (0.0, 0.0, 0.0) if value == "none" else value


def gravity_load(entry: Entry, blocks: IntArray | None, site: LoadSite) -> AppliedLoad:
    """Weights of all blocks, (n_blocks,)."""
    everywhere, acceleration = np.arange(len(site.blocks)), vector_of(entry.value)
    words = "no gravity" if entry.value == "none" else f"gravity {vector(acceleration)} {site.units.length}/s2"
    return AppliedLoad(everywhere, mass_forces(everywhere, np.array(acceleration), site), words, on_masses=True)


def gravity_of(dead: Iterable[Entry]) -> FloatArray:
    """The sum of gravity among dead loads, (3,) in the deck's unit of length per s2."""
    found = [entry.factor * np.array(vector_of(entry.value)) for entry in dead if entry.kind == GRAVITY]
    return np.asarray(sum(found, np.zeros(3)))


def with_gravity(dead: Iterable[Entry], path: KeyPath, units: Units) -> list[Entry]:
    """The dead loads of a case, before them 9.81 m/s2 along -z where none of them is gravity."""
    entries = list(dead)
    if any(entry.kind == GRAVITY for entry in entries):
        return entries
    usual = (0.0, 0.0, -units.standard_gravity)
    return [Entry(GRAVITY, usual, AnyLoad.model_construct(), path, 1.0), *entries]


register_load(
    LoadKind(
        name=GRAVITY,
        section=Gravity,
        description="gravitational acceleration, in the deck's unit of length per s^2, in place of 9.81 m/s^2 along "
        "-z; `none` among the dead loads of a structure without weight",
        refuses={"on": "gravity, which acts on all blocks: use acceleration"},
        build=gravity_load,
        vector=vector_of,
    )
)
