"""The types of the deck: the one source of the schema, of the checks on single values and of the key reference.

Numbers are in the deck's own units; a string with a unit (``"18 kN/m^3"``) is converted while it is read.
Checks that need more than one key are in :mod:`mbla.deck.rules`; the items of `blocks` are in :mod:`mbla.deck.items`
and can be had from here, like the analysis section of :mod:`mbla.deck.analysis`.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from mbla.deck.analysis import AnalysisSection as AnalysisSection
from mbla.deck.analysis import InteriorScheme as InteriorScheme
from mbla.deck.analysis import LowestScheme as LowestScheme
from mbla.deck.analysis import PathScheme as PathScheme
from mbla.deck.analysis import ProximalScheme as ProximalScheme
from mbla.deck.analysis import PublishedScheme as PublishedScheme
from mbla.deck.analysis import ReductionSwitches as ReductionSwitches
from mbla.deck.contacts import AboutNormal as AboutNormal
from mbla.deck.contacts import ContactOverride as ContactOverride
from mbla.deck.contacts import ContactPoints as ContactPoints
from mbla.deck.contacts import ContactsSection as ContactsSection
from mbla.deck.include import MAX_FILES
from mbla.deck.items import ArchItem as ArchItem
from mbla.deck.items import ArchPiers as ArchPiers
from mbla.deck.items import BarrelVaultItem as BarrelVaultItem
from mbla.deck.items import BlockItem as BlockItem
from mbla.deck.items import BoxItem as BoxItem
from mbla.deck.items import BridgeAbutments as BridgeAbutments
from mbla.deck.items import BridgeItem as BridgeItem
from mbla.deck.items import BridgeParapets as BridgeParapets
from mbla.deck.items import BridgePiers as BridgePiers
from mbla.deck.items import ColumnEnd as ColumnEnd
from mbla.deck.items import ColumnItem as ColumnItem
from mbla.deck.items import CrossVaultItem as CrossVaultItem
from mbla.deck.items import CrossWall as CrossWall
from mbla.deck.items import DomeDrum as DomeDrum
from mbla.deck.items import DomeItem as DomeItem
from mbla.deck.items import Item as Item
from mbla.deck.items import Masonry as Masonry
from mbla.deck.items import MeshItem as MeshItem
from mbla.deck.items import Opening as Opening
from mbla.deck.items import PavilionVaultItem as PavilionVaultItem
from mbla.deck.items import PolyhedronItem as PolyhedronItem
from mbla.deck.items import Reflection as Reflection
from mbla.deck.items import Repetition as Repetition
from mbla.deck.items import Rotation as Rotation
from mbla.deck.items import SpiralStairItem as SpiralStairItem
from mbla.deck.items import StackItem as StackItem
from mbla.deck.items import TableItem as TableItem
from mbla.deck.items import TransformStep as TransformStep
from mbla.deck.items import TrilithonItem as TrilithonItem
from mbla.deck.items import VaultItem as VaultItem
from mbla.deck.items import WallItem as WallItem
from mbla.deck.items import WallsItem as WallsItem
from mbla.deck.joints import JointLaw as JointLaw
from mbla.deck.loads import Axle as Axle
from mbla.deck.loads import HeightPattern as HeightPattern
from mbla.deck.loads import LineLoad as LineLoad
from mbla.deck.loads import Load as Load
from mbla.deck.loads import LoadCaseSection as LoadCaseSection
from mbla.deck.loads import PressureLoad as PressureLoad
from mbla.deck.loads import SettlementSection as SettlementSection
from mbla.deck.loads import Tilt as Tilt
from mbla.deck.loads import Travel as Travel
from mbla.deck.masses import AddedMass as AddedMass
from mbla.deck.names import Line, Name, ParameterName
from mbla.deck.quantities import (
    Count,
    Number,
    PositiveDensity,
    PositiveNumber,
    PositiveUnitWeight,
    Switch,
    Whole,
)
from mbla.deck.section import Section
from mbla.deck.selectors import Selector as Selector
from mbla.deck.selectors import SelectorTerm as SelectorTerm
from mbla.deck.supports import GroundPlane as GroundPlane
from mbla.deck.supports import Support as Support
from mbla.deck.supports import Turn as Turn
from mbla.deck.symmetry import SymmetryPlane as SymmetryPlane


def no_boolean(value: Any) -> Any:
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


# --- output, expectations -------------------------------------------------------------------------------


class OutputSection(Section):
    """Which result files are written."""

    vtu: Switch = Field(True, description="VTU and PVD files for ParaView")
    frames: Annotated[int, Whole(ge=2, le=1000)] = Field(11, description="frames of the animation of the mechanism")
    plots: Switch = Field(
        False, description="pictures of model, mechanisms and forces beside the results, as of ``mbla plot``"
    )
    positions: Literal["worst", "all"] = Field(
        "worst", description="positions of a travelling load that have files, pictures and a section of the listing"
    )


class Expectation(Section):
    """What a load case should give, with its source."""

    load_factor: Number | None = Field(None, description="by the deck's own flow rule")
    angle: Number | None = Field(None, description="tilt: angle of collapse in degrees")
    position: Count | None = Field(None, description="travel: number of the worst position, from 1")
    associative_load_factor: Number | None = Field(None, description="by the associative flow rule")
    reaction: Number | None = Field(None, description="of the support that gives way")
    lower: Number | None = Field(None, description="least load factor for the mechanism found, without normality")
    status: Literal["solved", "approximate", "not_verified", "no_equilibrium", "unbounded"] | None = Field(
        None, description="status of the case"
    )
    tolerance: PositiveNumber = Field(1e-5, description="relative difference that is allowed")
    source: Line = Field(min_length=1, description="where the figure is from")


class DeckContent(Section):
    """A whole deck."""

    mbla: Annotated[Literal[1], BeforeValidator(no_boolean)] = Field(description="version of the deck format")
    title: Line = Field("", description="shown in every result")
    units: UnitsSection = Field(default_factory=UnitsSection, description="units of numbers in deck and results")
    parameters: dict[ParameterName, Number] = Field(default_factory=dict, description='names for "=..." expressions')
    include: Annotated[list[str], Field(max_length=MAX_FILES)] = Field(
        default_factory=list,
        description="decks merged into this one, relative to it; at most 100 are read, with all that these include",
    )
    materials: dict[Name, Material] = Field(min_length=1, description="materials by name")
    joints: dict[Name, JointLaw] = Field(
        default_factory=dict, description="joint laws by name; frictionless, glued and open are known without"
    )
    blocks: list[BlockItem] = Field(min_length=1, description="the structure, item by item")
    contacts: ContactsSection = Field(description="joint law and tolerance of contacts")
    supports: list[Support] = Field(default_factory=list, description="what holds the structure")
    masses: list[AddedMass] = Field(default_factory=list, description="masses that rest on blocks, such as floors")
    loads: dict[Name, Annotated[list[Load], Field(min_length=1)]] = Field(
        default_factory=dict, description="loads by name, for several load cases"
    )
    symmetry: Annotated[list[SymmetryPlane], Field(max_length=3)] = Field(
        default_factory=list, description="planes that mirror what the deck gives, one after the other"
    )
    load_cases: dict[Name, LoadCaseSection] = Field(min_length=1, description="load cases by name")
    analysis: AnalysisSection = Field(default_factory=AnalysisSection, description="how it is solved")
    output: OutputSection = Field(default_factory=OutputSection, description="what is written")
    expected: dict[Name, Expectation] = Field(
        default_factory=dict, description="figures that `mbla run --expected` compares"
    )
