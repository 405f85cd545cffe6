"""The types of the deck: the one source of the schema, of the checks on single values and of the key reference.

Numbers are in the deck's own units; a string with a unit (``"18 kN/m^3"``) is converted while it is read.
Checks that need more than one key are in :mod:`mbla.deck.rules`; the items of `blocks` are in :mod:`mbla.deck.items`
and can be had from here, like the analysis section of :mod:`mbla.deck.analysis`.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BeforeValidator, Discriminator, Field, Tag

from mbla.deck.analysis import AnalysisSection as AnalysisSection
from mbla.deck.analysis import InteriorScheme as InteriorScheme
from mbla.deck.analysis import LowestScheme as LowestScheme
from mbla.deck.analysis import PathScheme as PathScheme
from mbla.deck.analysis import ProximalScheme as ProximalScheme
from mbla.deck.analysis import PublishedScheme as PublishedScheme
from mbla.deck.analysis import ReductionSwitches as ReductionSwitches
from mbla.deck.items import ArchItem as ArchItem
from mbla.deck.items import BlockItem as BlockItem
from mbla.deck.items import BoxItem as BoxItem
from mbla.deck.items import Item as Item
from mbla.deck.items import MeshItem as MeshItem
from mbla.deck.items import Opening as Opening
from mbla.deck.items import PolyhedronItem as PolyhedronItem
from mbla.deck.items import Reflection as Reflection
from mbla.deck.items import Rotation as Rotation
from mbla.deck.items import TransformStep as TransformStep
from mbla.deck.items import WallItem as WallItem
from mbla.deck.names import Line, Name, ParameterName
from mbla.deck.quantities import (
    Acceleration,
    Direction,
    Force,
    FrictionAngle,
    Index,
    Length,
    NonNegativeNumber,
    NonNegativeStress,
    Number,
    Point,
    PositiveDensity,
    PositiveNumber,
    PositiveStress,
    PositiveUnitWeight,
    Quantity,
    Switch,
    Whole,
)
from mbla.deck.section import Section, shape


def _no_boolean(value: Any) -> Any:
    """Python takes True for 1; a deck does not."""
    return str(value) if isinstance(value, bool) else value


class UnitsSection(Section):
    """Units of the numbers in the deck, and of the results."""

    length: Literal["m", "mm", "cm", "ft", "in"] = Field("m", description="unit of length")
    force: Literal["N", "kN", "MN", "lbf", "kip"] = Field("N", description="unit of force")
    mass: Literal["kg", "t", "lb"] = Field("kg", description="unit of mass")


class Material(Section):
    """What blocks are made of; one of density and unit weight."""

    density: PositiveDensity | None = Field(None, description="mass per volume")
    unit_weight: PositiveUnitWeight | None = Field(
        None, description="weight per volume under standard gravity, 9.81 m/s^2"
    )


class JointLaw(Section):
    """Joint law: Coulomb friction without tension unless strengths are given; one of friction and friction angle."""

    friction: NonNegativeNumber | None = Field(None, description="friction coefficient, tan of the friction angle")
    friction_angle: FrictionAngle | None = Field(None, description="friction angle in degrees")
    cohesion: NonNegativeStress = Field(0.0, description="shear strength without normal stress")
    tensile_strength: NonNegativeStress = Field(0.0, description="normal stress at which the joint opens")
    compressive_strength: PositiveStress | None = Field(
        None, description="normal stress at which it crushes; unlimited unless given"
    )
    dilatancy: FrictionAngle = Field(0.0, description="dilatancy angle in degrees, at most the friction angle")


# --- selectors, contacts, supports --------------------------------------------------------------------------------


class SelectorTerm(Section):
    """Blocks of a group (all, or the one with an index), or blocks whose centroid lies in a box."""

    group: Name | None = Field(None, description="name of a group")
    index: Index | None = Field(None, description="which block of the group, from 0 in order of creation")
    box: tuple[Point, Point] | None = Field(None, description="least and greatest coordinates; centroids inside count")


Term: TypeAlias = Annotated[
    Annotated[Name, Tag("name")] | Annotated[SelectorTerm, Tag("mapping")],
    Discriminator(lambda value: "mapping" if shape(value) == "mapping" else "name"),
]
Selector: TypeAlias = Annotated[
    Annotated[Name, Tag("name")]
    | Annotated[SelectorTerm, Tag("mapping")]
    | Annotated[list[Term], Field(min_length=1), Tag("list")],
    Discriminator(shape),
]


class ContactOverride(Section):
    """Another joint law between two selections."""

    between: tuple[Name, Name] = Field(description="two groups; may be the same; `ground` stands for ground planes")
    joint: Name = Field(description="name of a joint law")


class ContactsSection(Section):
    """How contacts are found, and their joint law."""

    joint: Name = Field(description="joint law of every contact that no override names")
    tolerance: Annotated[float, Quantity("number", gt=0, le=0.1)] = Field(
        1e-3, description="greatest gap, overlap and sliver width, relative to block size"
    )
    refine: Annotated[int, Whole(ge=1, le=50)] = Field(
        1,
        description="contact points along each edge of an interface, and rings of them inside; 1: its corners alone. "
        "Associative flow can load the corners alone, so that more points lower torsion only without dilatancy",
    )
    inset: Annotated[float, Quantity("number", ge=0, lt=1)] = Field(
        0.0,
        description="share of the way to the centroid that the contact points are moved inwards: lowers torsion (0.459 "
        "is exact for a square), and rocking by the same share",
    )
    overrides: list[ContactOverride] = Field(default_factory=list, description="the last that fits a contact holds")


class GroundPlane(Section):
    """A plane: exactly one of x, y, z (normal along that axis), or a point and a normal towards the structure."""

    x: Length | None = Field(None, description="the plane at this x, structure on the side of greater x")
    y: Length | None = Field(None, description="the plane at this y, structure on the side of greater y")
    z: Length | None = Field(None, description="the plane at this z, structure above")
    point: Point | None = Field(None, description="a point on the plane")
    normal: Direction | None = Field(None, description="normal of the plane, towards the structure")


class Support(Section):
    """Rigid ground under every face on a plane, or blocks that do not move."""

    ground: GroundPlane | None = Field(None, description="rigid ground")
    joint: Name | None = Field(None, description="joint law on the ground; that of contacts unless given")
    blocks: Selector | None = Field(
        None, description="blocks that do not move; with ground: the only blocks it carries"
    )


# --- loads --------------------------------------------------------------------------------------------------------


class Load(Section):
    """One load: exactly one of gravity, acceleration, force; each may be a dead load or a live one."""

    gravity: tuple[Acceleration, Acceleration, Acceleration] | None = Field(
        None, description="gravitational acceleration, in the deck's unit of length per s^2"
    )
    acceleration: Direction | None = Field(
        None, description="mass-proportional load in units of g = 9.81 m/s^2, pointing where it pushes"
    )
    force: tuple[Force, Force, Force] | None = Field(None, description="force on one block")
    on: Selector | None = Field(None, description="force: the block; acceleration: the blocks, all unless given")
    at: Point | None = Field(
        None, description="point of application, carried with its moment; the centroid unless given"
    )


class LoadCaseSection(Section):
    """Dead loads stay, live loads are multiplied by the load factor."""

    dead: list[Load] | None = Field(None, description="gravity of 9.81 m/s^2 along -z unless given")
    live: list[Load] = Field(min_length=1, description="the loads that the load factor multiplies")


# --- output, expectations -------------------------------------------------------------------------------


class OutputSection(Section):
    """Which result files are written."""

    vtu: Switch = Field(True, description="VTU and PVD files for ParaView")
    frames: Annotated[int, Whole(ge=2, le=1000)] = Field(11, description="frames of the animation of the mechanism")
    plots: Switch = Field(False, description="pictures of each load case beside the results")


class Expectation(Section):
    """What a load case should give, with its source."""

    load_factor: Number | None = Field(None, description="by the deck's own flow rule")
    associative_load_factor: Number | None = Field(None, description="by the associative flow rule")
    lower: Number | None = Field(None, description="least load factor for the mechanism found, without normality")
    status: Literal["solved", "approximate", "not_verified", "no_equilibrium", "unbounded"] | None = Field(
        None, description="status of the case"
    )
    tolerance: PositiveNumber = Field(1e-5, description="relative difference that is allowed")
    source: Line = Field(min_length=1, description="where the figure is from")


class DeckContent(Section):
    """A whole deck."""

    mbla: Annotated[Literal[1], BeforeValidator(_no_boolean)] = Field(description="version of the deck format")
    title: Line = Field("", description="shown in every result")
    units: UnitsSection = Field(default_factory=UnitsSection, description="units of numbers in deck and results")
    parameters: dict[ParameterName, Number] = Field(default_factory=dict, description='names for "=..." expressions')
    include: list[str] = Field(default_factory=list, description="decks merged into this one, relative to it")
    materials: dict[Name, Material] = Field(min_length=1, description="materials by name")
    joints: dict[Name, JointLaw] = Field(min_length=1, description="joint laws by name")
    blocks: list[BlockItem] = Field(min_length=1, description="the structure, item by item")
    contacts: ContactsSection = Field(description="joint law and tolerance of contacts")
    supports: list[Support] = Field(default_factory=list, description="what holds the structure")
    load_cases: dict[Name, LoadCaseSection] = Field(min_length=1, description="load cases by name")
    analysis: AnalysisSection = Field(default_factory=AnalysisSection, description="how it is solved")
    output: OutputSection = Field(default_factory=OutputSection, description="what is written")
    expected: dict[Name, Expectation] = Field(
        default_factory=dict, description="figures that `mbla run --expected` compares"
    )
