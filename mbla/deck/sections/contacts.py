"""Section `contacts`: how contacts are found, where their points lie, and which joint law each has."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from mbla.deck.quantities import Box, Direction, Integer, Name, PositiveLength, RealNumber
from mbla.deck.section import ByShape, Section, given, rule
from mbla.deck.sections.selectors import Selector
from mbla.deck.suggestions import listed
from mbla.errors import Finding


class AboutNormal(Section):
    """Interfaces whose normal is near a direction or its opposite."""

    normal: Direction = Field(description="direction of the normal, not necessarily of length 1")
    within: Annotated[float, RealNumber("angle", gt=0, le=90)] = Field(
        description="greatest angle in degrees between the normal of the interface and this direction or its opposite"
    )


Orientation: TypeAlias = Annotated[Literal["bed", "head"] | AboutNormal, ByShape("name")]


class ContactOverride(Section):
    """Another joint law for interfaces that meet every condition given, at least one of between, orientation, box.

    The last override that fits an interface holds.
    """

    joint: Name = Field(description="name of a joint law; frictionless, glued and open are known everywhere")
    between: tuple[Selector, Selector] | None = Field(
        None, description="two selectors, one for each side; may be the same; `ground` stands for ground planes"
    )
    orientation: Orientation | None = Field(
        None,
        description="bed: the normal of the interface is nearer than 45 degrees to the vertical (z); head: it is not; "
        "or the angle to a direction",
    )
    box: Box | None = Field(
        None, description="least and greatest coordinates; interfaces with their centroid inside count"
    )


class ContactPoints(Section):
    """Contact points of an interface; default: at its corners."""

    per_edge: Annotated[int, Integer(ge=1, le=50)] | None = Field(
        None,
        description="parts of each edge, with points inside too (a grid of (n + 1)² on a parallelogram); 1: the "
        "corners alone, as by default. Associative flow can load the corners alone, so that more points lower "
        "torsion only without dilatancy; in a pushover, where points crush, more points come closer to the stress "
        "block",
    )
    spacing: PositiveLength | None = Field(
        None, description="instead of per_edge: greatest distance of the points along the edges"
    )
    inset: Annotated[float, RealNumber("number", ge=0, lt=1)] = Field(
        0.0,
        description="share of the way to the centroid by which points are moved inwards (shrinking of faces in "
        "LMGC90): lowers torsion (0.459 is exact for a square), and rocking by the same share",
    )
    rounding: Annotated[float, RealNumber("length", ge=0)] = Field(
        0.0,
        description="instead of inset: distance by which the edges that carry points are moved inwards (rounding "
        "length of corners in UDEC)",
    )


class ContactsSection(Section):
    """How contacts are found, where their points lie, and their joint law."""

    joint: Name = Field(description="joint law of every contact that no override names")
    tolerance: Annotated[float, RealNumber("number", gt=0, le=0.1)] = Field(
        1e-3, description="greatest gap, overlap and sliver width, relative to block size"
    )
    overlap_tolerance: Annotated[float, RealNumber("number", gt=0, le=0.1)] | None = Field(
        None,
        description="greatest overlap, relative to block size; default: tolerance. Faces that overlap by no more "
        "are in contact, midway; gaps above tolerance stay open. The shared volume counts in the weight of both "
        "blocks, and a notice says how much it is",
    )
    joint_thickness: PositiveLength | None = Field(
        None,
        description="greatest thickness of joints that are drawn as gaps: opposite faces no further apart, within "
        "20 degrees of parallel, are moved to the plane in the middle of the joint, faces opposite a ground plane "
        "all of the way; free faces stay. The blocks grow, with the density of their material, and a notice says by "
        "how much. Not with symmetry, nor with table",
    )
    table: str | None = Field(
        None,
        min_length=1,
        description="CSV file with the interfaces, which are then not searched for: a header line with the columns "
        "interface,group_a,index_a,group_b,index_b,x,y,z, then a row for each corner, in order around each interface. "
        "For a ground plane the group is `ground` and the index its number. Each must lie on faces of both bodies. A "
        "further column `joint` may give the law of single interfaces, which then holds before overrides. Not with "
        "symmetry",
    )
    isolated: Literal["fail", "allow"] = Field(
        "fail",
        description="blocks that touch neither a block nor a ground. fail: the run ends with exit status 4; allow: "
        "a notice",
    )
    points: ContactPoints = Field(default_factory=ContactPoints, description="where contact points lie")
    overrides: list[ContactOverride] = Field(
        default_factory=list,
        description="other joint laws for some interfaces; the last override that fits an interface holds",
    )

    @property
    def depth_allowed(self) -> float:
        """Greatest overlap, relative to block size."""
        return self.tolerance if self.overlap_tolerance is None else self.overlap_tolerance


CONDITIONS = ("between", "orientation", "box")


@rule(ContactOverride)
def override_conditions(override: ContactOverride) -> Iterator[Finding]:
    """An override without condition would be the joint of the section."""
    if not given(override, CONDITIONS):
        yield Finding("missing-key", f"needs one of {listed(CONDITIONS)}: the joint of all contacts is contacts.joint")


@rule(ContactsSection)
def gaps_or_given(contacts: ContactsSection) -> Iterator[Finding]:
    """Interfaces that are given lie on the faces as drawn."""
    if contacts.joint_thickness is not None and contacts.table is not None:
        yield Finding("one-of-several", "only one of joint_thickness or table may be given", "joint_thickness")


@rule(ContactPoints)
def one_way_each(points: ContactPoints) -> Iterator[Finding]:
    """One measure of the density of points, one of their distance from the edge."""
    if points.per_edge is not None and points.spacing is not None:
        yield Finding("one-of-several", "only one of per_edge or spacing may be given", "spacing")
    if points.inset > 0 and points.rounding > 0:
        yield Finding("one-of-several", "only one of inset or rounding may be given", "rounding")
