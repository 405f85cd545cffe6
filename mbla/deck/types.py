"""The types of the deck: the one source of the schema, of the checks on single values and of the key reference.

Numbers are in the deck's own units; a string with a unit (``"18 kN/m^3"``) is converted while it is read.
Checks that need more than one key are in :mod:`mbla.deck.rules`.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BeforeValidator, Discriminator, Field, Tag

from mbla.deck.quantities import (
    Acceleration,
    Angle,
    Count,
    EmbraceAngle,
    Force,
    FrictionAngle,
    Index,
    Length,
    NonNegativeNumber,
    NonNegativeStress,
    Number,
    PositiveDensity,
    PositiveLength,
    PositiveNumber,
    PositiveStress,
    PositiveUnitWeight,
    Quantity,
    Switch,
    Time,
    Whole,
)
from mbla.deck.section import Section

Point: TypeAlias = tuple[Length, Length, Length]
PlanePoint: TypeAlias = tuple[Length, Length]
Direction: TypeAlias = tuple[Number, Number, Number]
Name: TypeAlias = Annotated[str, Field(pattern=r"^[A-Za-z0-9_][A-Za-z0-9_.-]*$", max_length=64)]
Line: TypeAlias = Annotated[str, Field(pattern=r"^.*$", max_length=200)]


def _shape(value: Any) -> str:
    """Which branch of a union a value of the deck belongs to, so that a fault in it is reported once."""
    return "mapping" if isinstance(value, (dict, Section)) else "list" if isinstance(value, list) else "name"


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


# --- blocks -------------------------------------------------------------------------------------------------------


class Rotation(Section):
    """Rotation by an angle about an axis, right-handed."""

    axis: Direction = Field(description="direction of the axis")
    angle: Angle = Field(description="degrees")
    about: Point = Field((0.0, 0.0, 0.0), description="point on the axis")


class Reflection(Section):
    """Mirror image in a plane."""

    normal: Direction = Field(description="normal of the plane")
    point: Point = Field((0.0, 0.0, 0.0), description="point on the plane")


class TransformStep(Section):
    """One step of a transform: exactly one of its keys."""

    translate: Point | None = Field(None, description="displacement")
    rotate: Rotation | None = Field(None, description="rotation about an axis")
    scale: PositiveNumber | None = Field(None, description="factor on all coordinates, about the origin")
    mirror: Reflection | None = Field(None, description="reflection in a plane")


Transform: TypeAlias = Annotated[
    Annotated[TransformStep, Tag("mapping")] | Annotated[list[TransformStep], Tag("list")],
    Discriminator(lambda value: "mapping" if _shape(value) == "mapping" else "list"),
]


class Item(Section):
    """What every item of `blocks` has."""

    group: Name | None = Field(None, description="name that selectors use; the item's kind unless given")
    material: Name = Field(description="name of a material")
    transform: Transform = Field(
        default_factory=list, description="a step, or a list of steps applied in order to the item's own geometry"
    )


class BoxItem(Item):
    """One block: a cuboid along the axes."""

    min: Point = Field(description="corner with the least coordinates")
    max: Point = Field(description="corner with the greatest coordinates")


class PolyhedronItem(Item):
    """One block: a closed polyhedron with planar faces, convex or not."""

    vertices: list[Point] = Field(min_length=4, description="corner points")
    faces: list[Annotated[list[Index], Field(min_length=3)]] = Field(
        min_length=4, description="corners of each face in order, as indices of vertices from 0; any orientation"
    )


class Opening(Section):
    """Rectangular opening in the plane of a wall, its bottom and top on bed joints."""

    from_: PlanePoint = Field(alias="from", description="lower corner: distance along the wall, height")
    to: PlanePoint = Field(description="upper corner: distance along the wall, height")


class WallItem(Item):
    """A wall one unit thick: runs along +x from the origin, rises along +z, thickness along +y."""

    unit: tuple[PositiveLength, PositiveLength, PositiveLength] = Field(
        description="length along the wall, thickness, height of one unit"
    )
    length: PositiveLength = Field(description="length of the wall; the closing units are cut to fit")
    courses: Count = Field(description="number of courses")
    bond: Literal["running", "stack"] = Field("running", description="running: odd courses shifted by half a unit")
    start: Literal["full", "half"] = Field("full", description="first unit of the bottom course")
    openings: list[Opening] = Field(default_factory=list, description="rectangles left free")


class ArchItem(Item):
    """A circular arch with radial joints and straight-edged voussoirs, in the x-z plane, extruded along +y.

    The left intrados springing is at the origin, the right one at x = span.
    """

    shape: Literal["semicircular", "segmental"] = Field(description="semicircular, or segmental with rise or embrace")
    span: PositiveLength = Field(description="distance between the intrados springings")
    thickness: PositiveLength = Field(description="radial thickness")
    width: PositiveLength = Field(description="extent along y")
    voussoirs: Count = Field(description="number of voussoirs")
    rise: PositiveLength | None = Field(None, description="segmental: height of the intrados crown over the springings")
    embrace: EmbraceAngle | None = Field(None, description="segmental: angle between the springing joints in degrees")
    springers: Literal["none", "ground", "blocks"] = Field(
        "none",
        description="ground: rigid ground under both springing joints; blocks: a fixed block behind each, "
        "in group GROUP_springers; none: the deck's supports hold the arch",
    )
    joint: Name | None = Field(None, description="joint law at a springing on ground; that of contacts unless given")


class MeshItem(Item):
    """Blocks from a geometry file: each object, closed component or volume cell is one block."""

    file: str = Field(
        min_length=1, description="OBJ, PLY, STL, VTU, Gmsh .msh or Abaqus/CalculiX .inp, relative to the deck"
    )
    scale: PositiveNumber = Field(1.0, description="factor from the file's coordinates to the deck's unit of length")


class BlockItem(Section):
    """An item of `blocks`: exactly one key, its kind."""

    box: BoxItem | None = None
    polyhedron: PolyhedronItem | None = None
    wall: WallItem | None = None
    arch: ArchItem | None = None
    mesh: MeshItem | None = None


# --- selectors, contacts, supports --------------------------------------------------------------------------------


class SelectorTerm(Section):
    """Blocks of a group (all, or the one with an index), or blocks whose centroid lies in a box."""

    group: Name | None = Field(None, description="name of a group")
    index: Index | None = Field(None, description="which block of the group, from 0 in order of creation")
    box: tuple[Point, Point] | None = Field(None, description="least and greatest coordinates; centroids inside count")


Term: TypeAlias = Annotated[
    Annotated[Name, Tag("name")] | Annotated[SelectorTerm, Tag("mapping")],
    Discriminator(lambda value: "mapping" if _shape(value) == "mapping" else "name"),
]
Selector: TypeAlias = Annotated[
    Annotated[Name, Tag("name")]
    | Annotated[SelectorTerm, Tag("mapping")]
    | Annotated[list[Term], Field(min_length=1), Tag("list")],
    Discriminator(_shape),
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
    """One load: exactly one of gravity, acceleration, force."""

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


# --- analysis, output, expectations -------------------------------------------------------------------------------


class PublishedScheme(Section):
    """Parameters of the iterative procedure of Portioli et al. 2014 for non-associative flow."""

    slope: Annotated[float, Quantity("number", ge=0, le=1)] = Field(
        0.0,
        description="alpha: share of the friction coefficient kept as slope of each program's yield line; "
        "published runs use small values above 0, which are a small dilatancy; 0 is none",
    )
    averaging: Annotated[float, Quantity("number", gt=0, le=1)] = Field(
        0.6, description="beta: weight of the newest normal forces in the average that sets the fictitious cohesion"
    )
    tolerance: Annotated[float, Quantity("number", gt=0, le=0.1)] = Field(
        1e-4,
        description="the sequence stops when the load factor changes by less, relatively, and no force exceeds "
        "its true friction by more than this share of the mean block load",
    )
    max_programs: Count = Field(60, description="cone programs before the sequence is given up")


class AnalysisSection(Section):
    """How the load factor is computed."""

    flow_rule: Literal["associative", "non_associative", "dilatancy"] = Field(
        "non_associative", description="associative; non-associative without dilatancy; or with the joints' dilatancy"
    )
    contact_model: Literal["concave"] = Field("concave", description="contact points at the corners of each interface")
    scheme: Literal["published"] = Field("published", description="how non-associative flow is solved")
    published: PublishedScheme = Field(default_factory=PublishedScheme, description="its parameters")
    accuracy: Literal["draft", "standard", "reference"] = Field("standard", description="one word for every knob")
    tolerance: Annotated[float, Quantity("number", gt=0, le=1e-3)] | None = Field(
        None, description="relative tolerance of the cone solver; set by accuracy unless given"
    )
    max_iterations: Count | None = Field(None, description="iterations of the cone solver for one program")
    time_limit: Time | None = Field(None, description="seconds for all load cases together")


class OutputSection(Section):
    """Which result files are written."""

    vtu: Switch = Field(True, description="VTU and PVD files for ParaView")
    frames: Annotated[int, Whole(ge=2, le=1000)] = Field(11, description="frames of the animation of the mechanism")
    plots: Switch = Field(False, description="pictures of each load case beside the results")


class Expectation(Section):
    """What a load case should give, with its source."""

    load_factor: Number | None = Field(None, description="by the deck's own flow rule")
    associative_load_factor: Number | None = Field(None, description="by the associative flow rule")
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
    parameters: dict[Annotated[str, Field(pattern=r"^[A-Za-z_][A-Za-z0-9_]*$")], Number] = Field(
        default_factory=dict, description='names for "=..." expressions'
    )
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
