"""Section `load_cases`: loads that stay, and loads that the load factor multiplies."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.quantities import Acceleration, Direction, Force, Point
from mbla.deck.section import Section
from mbla.deck.selectors import Selector


class Load(Section):
    """One load: exactly one of gravity, acceleration, force, table; each may be a dead load or a live one."""

    gravity: tuple[Acceleration, Acceleration, Acceleration] | None = Field(
        None, description="gravitational acceleration, in the deck's unit of length per s^2"
    )
    acceleration: Direction | None = Field(
        None, description="mass-proportional load in units of g = 9.81 m/s^2, pointing where it pushes"
    )
    force: tuple[Force, Force, Force] | None = Field(None, description="force on one block")
    table: str | None = Field(
        None,
        min_length=1,
        description="CSV file, relative to the deck: a header line with the columns group,index,fx,fy,fz, optionally "
        "x,y,z (where the force acts; the centroid unless given) and mx,my,mz (moment); then a row for each force",
    )
    on: Selector | None = Field(None, description="force: the block; acceleration: the blocks, all unless given")
    at: Point | None = Field(
        None, description="point of application, carried with its moment; the centroid unless given"
    )


class LoadCaseSection(Section):
    """Dead loads stay, live loads are multiplied by the load factor."""

    dead: list[Load] | None = Field(None, description="gravity of 9.81 m/s^2 along -z unless given")
    live: list[Load] = Field(min_length=1, description="the loads that the load factor multiplies")
