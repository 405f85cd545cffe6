"""The model: blocks, supports, joint laws and load cases, all as arrays in the deck's units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.sections.assessment import AssessmentSection
from mbla.deck.units import Units
from mbla.errors import Notice, UsageError
from mbla.model.applied_load import AppliedLoad
from mbla.model.fill.fill import CarriedFill
from mbla.model.motion.time_history import TimeHistory
from mbla.model.soil.soil_figure import SoilFigure
from mbla.model.soil.soil_mesh import SoilMesh
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.facets import NO_BENT_FACES, BentFaces
from mbla.model.supports.guides import NO_GUIDES, Guides, joined, together
from mbla.model.ties.ties import NO_TIES, Ties
from mbla.questions import Question
from mbla.questions.load_factor import LOAD_FACTOR

SHEAR_RATIO = 0.4
"""of an elastic joint unless the deck gives another: G/E = 1/(2 (1 + ν)) with ν = 0.25, as of stone and mortar"""


@dataclass(frozen=True)
class Joint:
    """Joint law; stresses in the deck's units (Pa), compressive strength inf where unlimited."""

    name: str
    friction: float
    cohesion: float = 0.0
    tensile_strength: float = 0.0
    compressive_strength: float = np.inf
    dilatancy: float = 0.0
    """tangent of the dilatancy angle"""
    normal_stiffness: float = np.nan
    """force per area and displacement, of time histories and modes; nan where the deck gives none"""
    shear_ratio: float = SHEAR_RATIO
    """stiffness along the joint over that across it"""


@dataclass(frozen=True)
class Ground:
    """Rigid ground behind a plane, or behind a part of it.

    point, normal : (3,) a point on the plane; unit normal towards the structure
    joint         : name of the joint law on it
    blocks        : blocks that it may carry, sorted; None for all
    label         : how messages call it (``ground z = 0``)
    outline       : (n, 3) corners of a surface that ends there, counter-clockwise about the normal; None for a plane
    """

    point: FloatArray
    normal: FloatArray
    joint: str
    blocks: IntArray | None
    label: str
    outline: FloatArray | None = None


@dataclass(frozen=True)
class Pushing:
    """A pushover: how far and by which steps the control point is pushed.

    step, until : m, of the control point; ``until`` inf: until the load factor is at its end
    until_load_factor : to which it falls at the end; 0: until nothing is left of it
    steps       : at most
    blocks      : (m,) whose centre of mass is the control point; none: that of the live load on what moves at first
    direction   : (3,) unit, in which its displacement counts; nan: along the live load on these blocks
    error       : whether steps of twice the size are made as well, for the error of the load factors
    dead_levers, live_levers : (n_blocks, 9) sums of arm times force, arms from the centroid by rows, of what keeps its
                  direction
    dead_following, live_following : (n_blocks, 6) the part of the loads that turns with its block
    live_following_levers : (n_blocks, 9) levers of that part of the live load: where it acts
    """

    step: float
    until: float
    until_load_factor: float
    steps: int
    blocks: IntArray
    direction: FloatArray
    error: bool
    dead_levers: FloatArray
    live_levers: FloatArray
    dead_following: FloatArray
    live_following: FloatArray
    live_following_levers: FloatArray


@dataclass(frozen=True)
class LoadCase:
    """Loads of one case on every block, about its centroid.

    dead_load, live_load : (n_blocks, 6) force N and moment N m, also on fixed blocks (they go into the support)
    dead, live : the loads that these are the sums of
    question : the figure that its load factor stands for
    pushover : the pushover that follows limit analysis, None for none; before the positions of a travelling load are
               solved, all positions that may be pushed have it, afterwards the one that is pushed
    assessment : the question to a code, None for none
    soil : its load factors on meshes of soil that were moved; none without soil of cells, or without a planar scene
    time_history : motion of the base and forces over time; None for none
    modes : how many modes of vibration are sought at its gravity state
    """

    name: str
    dead_load: FloatArray
    live_load: FloatArray
    dead: tuple[AppliedLoad, ...]
    live: tuple[AppliedLoad, ...]
    question: Question = LOAD_FACTOR
    pushover: Pushing | None = None
    assessment: AssessmentSection | None = None
    soil: tuple[SoilFigure, ...] = ()
    time_history: TimeHistory | None = None
    modes: int = 0

    @property
    def dead_words(self) -> tuple[str, ...]:
        """The dead loads in words."""
        return tuple(load.words for load in self.dead)

    @property
    def live_words(self) -> tuple[str, ...]:
        """The live loads in words."""
        return tuple(load.words for load in self.live)

    @property
    def dead_alone(self) -> LoadCase:
        """The load case before anything else acts, with the dead load in the place of what λ multiplies: supports that
        settle later are held, loads do not travel yet.
        """
        return replace(self, live_load=self.dead_load, question=LOAD_FACTOR)

    @property
    def has_load_factor(self) -> bool:
        """Whether it asks for a figure that a load factor stands for, not how it vibrates or moves in time alone."""
        return self.question.group not in ("modes", "time_history")

    @property
    def deck_name(self) -> str:
        """Name in the deck, where a travelling load is one load case for all positions, an objective for both ends."""
        return self.question.series or self.name


@dataclass(frozen=True)
class PrescribedInterfaces:
    """Interfaces by their outlines, in the order of the table.

    bodies       : (n, 2)  blocks, then grounds, numbered as in ``Contacts``; a < b, but ground is always a
    normals      : (n, 3)  unit, from a to b
    corners      : (m, 3)  counter-clockwise about the normal
    corner_start : (n + 1,)
    joints       : (n) name of the joint law; empty for that of contacts
    """

    bodies: IntArray
    normals: FloatArray
    corners: FloatArray
    corner_start: IntArray
    joints: tuple[str, ...]


@dataclass(frozen=True)
class Model:
    """A structure and what acts on it.

    Bodies are numbered: block b is body b, ground g is body len(blocks) + g.

    fixed       : (n_blocks,) blocks that do not move
    joints      : joint laws by name
    load_cases  : in the order of the deck
    notices     : repairs and remarks from building it
    guides      : guided blocks with their admissible motions; they count as free
    mirrors     : unit normal m and offset d of the planes of symmetry that the deck gives, m·x = d: only symmetric
                  states are searched
    interfaces  : interfaces that the deck gives by their corners; None where contacts are searched for
    ties        : ties, struts, rings and strips between blocks
    bent        : bent faces that were split into triangles, in contact with the same face of another block at most
    fill        : soil on blocks, counted among their added masses; None for none
    soils       : soil of rigid cells, which are blocks
    """

    title: str
    units: Units
    blocks: Blocks
    fixed: BoolArray
    grounds: tuple[Ground, ...]
    joints: dict[str, Joint]
    load_cases: tuple[LoadCase, ...]
    notices: tuple[Notice, ...]
    guides: Guides = NO_GUIDES
    mirrors: tuple[tuple[float, float, float, float], ...] = ()
    interfaces: PrescribedInterfaces | None = None
    ties: Ties = NO_TIES
    bent: BentFaces = NO_BENT_FACES
    fill: CarriedFill | None = None
    soils: tuple[SoilMesh, ...] = ()

    def of_case(self, load_case: LoadCase) -> Model:
        """The model as it may move under a load case: with the blocks of its settlement as a guided body."""
        question = load_case.question
        if not len(question.giving_way):
            return self
        fixed = self.fixed.copy()
        fixed[question.giving_way] = False
        return replace(self, fixed=fixed, guides=joined(self.guides, together(question.giving_way, question.ways)))

    @property
    def free(self) -> IntArray:
        """Blocks that can move, in order, (n_free,)."""
        return np.flatnonzero(~self.fixed)

    @property
    def soil_of_block(self) -> IntArray:
        """Row in ``soils`` of the soil that each block is a cell of, (n_blocks,); -1 for a block of its own."""
        rows = np.full(len(self.blocks), -1)
        for row, soil in enumerate(self.soils):
            rows[soil.blocks] = row
        return rows

    @property
    def weights(self) -> FloatArray:
        """Of each block under standard gravity, 9.81 m/s2, added mass included, (n_blocks,) in the unit of force."""
        return np.asarray(self.blocks.masses * self.units.standard_gravity * self.units.force_per_mass_acceleration)

    @property
    def total_weight(self) -> float:
        """Of all blocks, in the deck's unit of force."""
        return float(self.blocks.masses.sum() * self.units.standard_gravity * self.units.force_per_mass_acceleration)

    def body_name(self, body: int) -> str:
        """Name of a block, or label of a ground."""
        n_blocks = len(self.blocks)
        return self.blocks.name(body) if body < n_blocks else self.grounds[body - n_blocks].label


def select_cases(model: Model, names: Sequence[str]) -> tuple[LoadCase, ...]:
    """The load cases of those names in the order of the deck, all if none is named; raises UsageError for unknown ones.

    The name of a load that travels stands for all its positions.
    """
    known = dict.fromkeys(case.deck_name for case in model.load_cases)
    for name in names:
        if name not in known and name not in [case.name for case in model.load_cases]:
            raise UsageError("unknown-load-case", f"no load case {name} in the deck; it has {', '.join(known)}")
    return tuple(case for case in model.load_cases if not names or case.name in names or case.deck_name in names)
