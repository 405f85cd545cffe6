"""Section `masses`: what rests on blocks without being one, such as floors."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.quantities import Point, PositiveMass
from mbla.deck.section import Section
from mbla.deck.sections.selectors import Selector


class AddedMass(Section):
    """A mass that blocks carry along: gravity and accelerations act on it as on the blocks."""

    mass: PositiveMass = Field(description="the mass, all together")
    on: Selector = Field(description="blocks that share it in proportion to their volumes, at their centroids")
    at: Point | None = Field(None, description="where it is, for a mass on one block; its centroid unless given")
