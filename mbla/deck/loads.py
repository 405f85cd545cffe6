"""Section `load_cases`: loads that stay, and loads that the load factor multiplies."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.quantities import Acceleration, Direction, Force, Point
from mbla.deck.section import Section
from mbla.deck.selectors import Selector
from mbla.deck.supports import Turn


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


class SettlementSection(Section):
    """A support that gives way: blocks that `supports` fixes move as one rigid body, in one way only."""

    on: Selector = Field(description="the blocks that give way; `supports` fixes them otherwise")
    direction: Direction | None = Field(
        None, description="the way they go: [0, 0, -1] for a support that sinks, horizontal for one that spreads"
    )
    turn: Turn | None = Field(None, description="or the line about which they turn")


class LoadCaseSection(Section):
    """Dead loads stay, live loads are multiplied by the load factor; or a support gives way under the dead loads."""

    dead: list[Load] | None = Field(None, description="gravity of 9.81 m/s^2 along -z unless given")
    live: list[Load] | None = Field(None, min_length=1, description="the loads that the load factor multiplies")
    settlement: SettlementSection | None = Field(
        None,
        description="in place of live: a support that gives way, free of other supports; the answer is the mechanism "
        "and the reaction with which the support meets it, the least that equilibrium allows. The load factor is the "
        "loss of reaction, from that of the structure at rest on, over the weight of the free blocks",
    )
