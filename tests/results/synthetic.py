"""Small results made by hand, exact where they claim to be: no reader, no search, no solver needed.

A tower 1 x 1 x 2 on a fixed base and a flat brick 1 x 1 x 0.5 on the ground z = 0, both of weight 10 N, pushed along
+x: with friction 0.65 the tower rocks about its edge at load factor 1/2 and the brick stays.
"""

import itertools
from dataclasses import fields, replace
from typing import Any

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import ContactReport, Contacts
from mbla.deck.deck import sha256_of
from mbla.deck.sections.assessment import AssessmentSection
from mbla.deck.units import Units
from mbla.errors import Message, Notice
from mbla.model.applied_load import without_forces
from mbla.model.fill.fill import CarriedFill
from mbla.model.model import Ground, Joint, LoadCase, Model, Pushing
from mbla.model.solids.blocks import Blocks, labels_of
from mbla.model.supports.guides import Guides
from mbla.model.ties.ties import Ties
from mbla.program.reductions import ProgramSize, ReductionOutcome, ReductionStep
from mbla.questions.angle import Angle
from mbla.questions.force import Force, Objective
from mbla.questions.reaction import Reaction, Settlement
from mbla.questions.tilt import Tilt
from mbla.questions.travel import Travel
from mbla.questions.travel_position import TravelPosition
from mbla.results.assessment import Assessment, Figure
from mbla.results.results import CaseResult, DeckRecord, Results
from mbla.solution.further.further import Further
from mbla.solution.further.geometric_safety.geometric_safety import GeometricSafety
from mbla.solution.further.sensitivity.slopes import Side, Slope
from mbla.solution.further.soil_range.soil_path import SoilPath
from mbla.solution.modes.modes import Modes
from mbla.solution.pushover.curve_rows import CurveEnd, CurveRow
from mbla.solution.pushover.pushover import Pushover
from mbla.solution.pushover.record import PushedRows, RowPoints
from mbla.solution.solution import (
    Checks,
    IterationRecord,
    Mechanics,
    ModelSize,
    PathByStiffness,
    PathPoint,
    ProgramRecord,
    Solution,
    Standing,
    StandingResult,
    Status,
)
from tests.results.rocking import asked, rocks

BOX_FACES = np.array(
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]], dtype=np.int64
)
TOWER_WEIGHT = 10.0
STEP = ReductionStep("parts", ReductionOutcome.APPLIED, 2, ProgramSize(12, 8, 80, 12), ProgramSize(12, 8, 80, 6))
G = 9.81
SHEET = np.array([[9.0, 0, 0], [9.0, 1, 0], [9.0, 1, 3], [9.0, 0, 3]])[::-1]
"""a surface at x = 9, seen from smaller x"""
ASSESSED = AssessmentSection.model_validate({"spectra": {"SLV": {"table": [[0.0, 0.2], [2.0, 0.1]]}}})
VERDICT = Assessment(
    "NTC 2018 with Circolare 7/2019",
    (
        Figure("", "a_0*", 0.7, "m/s2", "[C8.7.1.8]", "alpha_0 g/(e* FC): it begins"),
        Figure("SLV", "zeta", 0.9, "", "C8.7.1.2.1.7", "q a_g,0/a_g, by alpha_0 alone"),
    ),
    (Message("assessment-in-doubt", "the mechanism moves in space"),),
)


DECK = """\
# Tür und Turm – µ
mbla: 1
title: Tower and brick
materials: {stone: {density: "=5/9.81"}, dense: {density: "=20/9.81"}}
joints:
  dry: {friction: 0.65}
  strong: {friction: 0.5, cohesion: 1, tensile_strength: 2, compressive_strength: 3, dilatancy: "=atan(0.1)"}
contacts: {joint: dry}
blocks:
  - box: {group: base, material: stone, min: [-1, -1, 0], max: [2, 2, 1]}
  - box: {group: tower, material: stone, min: [0, 0, 1], max: [1, 1, 3]}
  - box: {group: brick, material: dense, min: [4, 0, 0], max: [5, 1, 0.5]}
supports: [{blocks: base}, {ground: {z: 0}}]
load_cases:
  push_x: {live: [{acceleration: [1, 0, 0]}]}
  fall: {live: [{acceleration: [1, 0, 0]}]}
  not_run: {live: [{acceleration: [1, 0, 0]}]}
"""
"""of the tower: it gives its blocks, interfaces and contact points"""
ROD = "ties: [{name: rod, through: [[0, 0.5, 1.5], [-1, 0.5, 1.5]], on: [tower, ground], capacity: 4}]\n"
"""section of the deck of the full results, for their tie"""
NOT_RUN = "".join(f"  {name}: {{live: [{{acceleration: [1, 0, 0]}}]}}\n" for name in ("table", "thrust"))
"""more load cases in it"""
ASKED = "push_x: {assessment: {spectra: {SLV: {table: [[0.0, 0.2], [2.0, 0.1]]}}}, "
"""beginning of their load case in it, for their assessment"""


def cuboids(lower: Any, upper: Any, groups: Any, densities: Any = 1.0) -> Blocks:
    """Blocks from lower and upper corners, (n, 3) each."""
    lower, upper = np.asarray(lower, float), np.asarray(upper, float)
    n = len(lower)
    pattern = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    vertices = (lower[:, None, :] + pattern * (upper - lower)[:, None, :]).reshape(-1, 3)
    loops = (BOX_FACES[None] + 8 * np.arange(n)[:, None, None]).reshape(-1)
    normals = np.tile([[0, 0, -1], [0, 0, 1], [0, -1, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0]], (n, 1)).astype(float)
    counter: dict[str, Any] = {}
    indices = [counter.setdefault(group, itertools.count()).__next__() for group in groups]
    return Blocks(
        vertices=vertices,
        vertex_start=8 * np.arange(n + 1),
        loops=loops,
        loop_start=4 * np.arange(6 * n + 1),
        face_start=6 * np.arange(n + 1),
        facet_of_face=np.arange(6 * n),
        face_normals=normals,
        convex=np.ones(n, dtype=bool),
        volumes=np.prod(upper - lower, axis=1),
        centroids=(lower + upper) / 2,
        added_masses=np.zeros(n),
        added_mass_points=(lower + upper) / 2,
        densities=np.broadcast_to(np.asarray(densities, float), (n,)).copy(),
        groups=tuple(groups),
        group_indices=np.array(indices, dtype=np.int64),
        labels=labels_of(n),
    )


def empty_report(notices: Any = ()) -> ContactReport:
    """A contact report with nothing in it."""
    pairs, numbers, rows = np.zeros((0, 2), np.int64), np.zeros(0), np.zeros(0, np.int64)
    return ContactReport(
        slivers=pairs,
        sliver_widths=numbers,
        near_misses=pairs,
        near_miss_gaps=numbers,
        overlaps=pairs,
        overlap_depths=numbers,
        overlap_swallows=np.zeros(0, dtype=bool),
        unchecked=pairs,
        isolated=rows,
        unsupported=(),
        fixed_contacts=0,
        open_interfaces=0,
        glued=pairs,
        held=rows,
        notices=tuple(notices),
    )


def horizontal_contacts(bodies: Any, rectangles: Any, report: Any = None) -> Contacts:
    """Interfaces with normal +z on rectangles (x0, x1, y0, y1, z), four contact points each."""
    corners = np.array(
        [[[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]] for x0, x1, y0, y1, z in rectangles], float
    )
    n = len(rectangles)
    areas = np.array([(x1 - x0) * (y1 - y0) for x0, x1, y0, y1, _ in rectangles], float)
    frame = np.array([[0.0, 0, 1], [1, 0, 0], [0, 1, 0]])
    return Contacts(
        bodies=np.array(bodies, dtype=np.int64),
        normals=np.tile([0.0, 0, 1], (n, 1)),
        areas=areas,
        centroids=corners.mean(axis=1),
        gaps=np.zeros(n),
        joints=np.zeros(n, dtype=np.int64),
        joint_names=("dry",),
        point_start=4 * np.arange(n + 1),
        outline=np.full(n, 4),
        points=corners.reshape(-1, 3),
        frames=np.tile(frame, (4 * n, 1, 1)),
        point_areas=np.repeat(areas / 4, 4),
        report=report or empty_report(),
    )


def tower_model() -> Model:
    """Base (fixed), tower, brick."""
    density = TOWER_WEIGHT / (2 * G)
    blocks = cuboids(
        [[-1, -1, 0], [0, 0, 1], [4, 0, 0]],
        [[2, 2, 1], [1, 1, 3], [5, 1, 0.5]],
        ("base", "tower", "brick"),
        [density, density, 4 * density],
    )
    weights = blocks.masses * G
    zeros = np.zeros((3, 6))
    dead, live = zeros.copy(), zeros.copy()
    dead[:, 2] = -weights
    live[:, 0] = weights
    weight = replace(without_forces("gravity (0, 0, -9.81) m/s2"), on_masses=True)
    push = replace(without_forces("acceleration (1, 0, 0) g on all blocks"), on_masses=True, in_g=True)
    cases = (
        LoadCase("push_x", dead, live, (weight,), (push,)),
        LoadCase("fall", dead, live, (weight,), (push,)),
        LoadCase("not_run", dead, live, (weight,), (push,)),
    )
    return Model(
        title="Tower and brick",
        units=Units(),
        blocks=blocks,
        fixed=np.array([True, False, False]),
        grounds=(
            Ground(np.zeros(3), np.array([0.0, 0, 1]), "dry", None, "ground z = 0"),
            Ground(np.array([9.0, 0, 0]), np.array([-1.0, 0, 0]), "strong", np.array([2]), "ground x = 9", SHEET),
        ),
        joints={"dry": Joint("dry", 0.65), "strong": Joint("strong", 0.5, 1.0, 2.0, 3.0, 0.1)},
        load_cases=cases,
        notices=(Notice("notice", "faces-turned-outwards", "faces of 1 block turned outwards"),),
    )


def tower_contacts() -> Contacts:
    """Base and tower, ground and brick."""
    warning = Notice("warning", "near-miss", "tower[0] and brick[0] nearly touch")
    return horizontal_contacts([[0, 1], [3, 2]], [(0, 1, 0, 1, 1), (4, 5, 0, 1, 0)], empty_report([warning]))


def tower_mechanics(load_factor: Any = 0.5) -> Mechanics:
    """Exact: the tower turns about its edge x = 1; live power W omega 1 = 1."""
    weight = TOWER_WEIGHT
    forces = np.zeros((8, 3))
    forces[[1, 2], 0] = weight / 2
    forces[[1, 2], 1] = -load_factor * weight / 2
    lever = load_factor * weight * 0.25  # the push on the brick at half its height of 0.5
    forces[4:, 0] = weight / 4 + np.array([-1, 1, 1, -1]) * lever / 2
    forces[4:, 1] = -load_factor * weight / 4
    omega = 1 / weight
    velocities = np.zeros((8, 3))
    velocities[[0, 3], 0] = omega
    mechanism = np.zeros((3, 6))
    mechanism[1] = [omega, 0, omega / 2, 0, omega, 0]  # at (-0.5, 0, 1) from the edge, turning about +y
    modes = np.zeros(8, dtype=np.int64)
    modes[[0, 3]] = 2
    return Mechanics(load_factor, forces, velocities, mechanism, modes)


def tower_results(flow_rule: str = "non_associative") -> Results:
    """One solved case, one without equilibrium, one not run."""
    model = tower_model()
    mechanics = tower_mechanics()
    associative = mechanics if flow_rule == "associative" else tower_mechanics(0.5)
    programs = (
        ProgramRecord(1, "associative", Status.SOLVED, 0.5, float("nan"), 12, 0.01, "mbla", "qdldl"),
        ProgramRecord(2, "published", Status.SOLVED, 0.5, 1e-6, 11, 0.01, "clarabel", "qdldl"),
    )
    iterations = tuple(IterationRecord(1, i, 0.5 + 0.1**i, 0.1**i, 1e-3, 1e-4, 0.9, 0.001 * i) for i in range(12))
    solution = Solution(
        flow_rule, Status.SOLVED, mechanics, associative, None, "", programs, iterations, 0.02, stress_blocks=True
    )
    checks = Checks(1e-12, 0.0, 0.0, 1e-11, 1.0, 1e-12, 0.5, 0.5, 0.0, True, ())
    certificate = np.zeros((3, 6))
    certificate[1] = [0, 0, -1, 0, 0, 0]
    nan = float("nan")
    none = Solution(
        flow_rule, Status.NO_EQUILIBRIUM, None, None, certificate, "the dead load cannot be carried", (), (), 0.01
    )
    nothing = Checks(nan, nan, nan, nan, nan, nan, nan, nan, nan, True, ())
    notices = (*model.notices, *tower_contacts().report.notices)
    return Results(
        deck=DeckRecord("tower.yaml", (("tower.yaml", DECK), ("b.yaml", "")), (), sha256_of([DECK, ""])),
        assembly=Assembly(model, tower_contacts()),
        cases=(
            CaseResult(model.load_cases[0], solution, checks, Status.SOLVED),
            CaseResult(model.load_cases[1], none, nothing, Status.NO_EQUILIBRIUM),
        ),
        notices=notices,
        provenance={"mbla": "0.1.0", "platform": "test"},
        settings={"flow_rule": flow_rule, "tolerance": "1e-08"},
        time={"read": 0.01, "contacts": 0.02, "solve": 0.8, "write": 0.1},
        exit_code=5,
        created="2025-01-01T00:00:00+00:00",
    )


PATH = (
    PathPoint(1, 0.5, 0.25, 0, 0, balanced=True),
    PathPoint(2, 3.0, 0.5, 2, 0, balanced=True),
    PathPoint(3, 4.0, 0.6, 2, 1, balanced=False),
    PathPoint(4, 9.5, 0.4, 2, 1, balanced=True),
)
"""A path of elastic joints that falls, with a step on the way that is not in balance."""


def modes() -> Modes:
    """One, of the three blocks."""
    return Modes(
        periods=np.array([0.2]),
        shapes=np.arange(18.0).reshape(1, 3, 6) / 18.0,
        masses=np.array([[0.7, 0.2, 0.1]]),
        moving=np.array([15.0, 15.0, 14.0]),
        default=1e7,
        stiffness=np.array([[1e7, 4e6], [2e7, 8e6]]),
        pressed=np.array([1.0, 0.5]),
        settlement=np.arange(18.0).reshape(3, 6) * 1e-6,
        loose=np.array([False, True, False]),
        slack=1,
        residual=1e-12,
        verified=True,
    )


def full_results() -> Results:
    """Every field of every record filled: nothing that a solver stage may say is missing, however unlikely together."""
    results = tower_results()
    case = results.cases[0]
    checks = replace(
        case.checks,
        tension_violation=1e-9,
        slip_residual=2e-9,
        least_load_factor=0.45,
        torsion_load_factor=0.42,
        elastic_residual=3e-9,
        failures=(Message("penetration", "x"),),
    )
    contacts = replace(results.contacts, solid_of_block=np.arange(len(results.model.blocks)))
    model = full_model(results.model)
    full = replace(case, load_case=model.load_cases[0], solution=full_solution(case.solution), checks=checks)
    files = (("stones.obj", b"v 0 0 0\n"), ("meshes/none.bin", b""), ("x.csv", b"\xff\x00"))
    sources = (("tower.yaml", DECK.replace("push_x: {", ASKED) + NOT_RUN + ROD), *results.deck.sources[1:])
    sha256 = sha256_of(text for _, text in sources)
    deck = replace(results.deck, sources=sources, sha256=sha256, files=files)
    assembly = Assembly(model, contacts)
    cases = (replace(full, assessment=VERDICT), results.cases[1])
    return replace(results, deck=deck, assembly=assembly, cases=cases, complete=False, not_done=("slide",))


def full_solution(solution: Solution) -> Solution:
    """A solution with all its fields."""
    mechanics = replace(
        tower_mechanics(),
        resultants=np.arange(12.0).reshape(2, 6),
        interface_motions=np.arange(24.0).reshape(2, 2, 6),
        tie_forces=np.array([3.0]),
        tie_rates=np.array([0.5]),
        remembered=tower_mechanics().contact_forces + 1.0,
        stiffness=np.full((len(tower_mechanics().contact_forces), 2), 2.0),
        crushed=np.arange(12.0).reshape(2, 6),
        tie_remembered=np.array([2.0]),
        tie_stiffness=np.array([4.0]),
    )
    with_tie = np.vstack([mechanics.contact_forces, [[3.0, 0, 0]]])
    return replace(
        solution,
        mechanics=mechanics,
        associative=replace(mechanics, load_factor=0.55),
        certificate=np.arange(18.0).reshape(3, 6),
        certificate_motions=np.arange(24.0).reshape(2, 2, 6),
        contact_model="convex",
        reason="the steps came to rest late",
        scheme="auto",
        remarks=(
            Message("elastic-path-rises", "the load still rises"),
            Message("tilt-by-steps", "one more"),
            *VERDICT.remarks,
        ),
        least=replace(mechanics, load_factor=0.45),
        torsion=replace(mechanics, load_factor=0.42),
        torsion_end="falls",
        level=replace(mechanics, load_factor=0.57),
        level_lock=np.arange(24.0, 51.0).reshape(9, 3),
        tolerance_requested=5e-3,
        standing=StandingResult(
            Standing.SELF_STRESS, 1, "the tower hangs between two walls", with_tie, mechanics.mechanism
        ),
        lock=np.arange(27.0).reshape(9, 3),
        path=PATH,
        path_end="falls",
        path_gain=0.02,
        path_last=0.4,
        path_by_stiffness=(PathByStiffness(0.2, 0.52), PathByStiffness(1.0, np.nan)),
        further=Further(
            pushover=Pushover(
                curve=(
                    CurveRow(
                        0,
                        0.0,
                        0.5,
                        25.0,
                        3.0,
                        0.0,
                        1e-9,
                        0.0,
                        0.0,
                        0.0,
                        0.0,
                        0.0,
                        0.0,
                        new_mechanism=False,
                        jumps=0,
                        unsolved=0,
                        debris=0,
                        broken=0,
                    ),
                    CurveRow(
                        1,
                        0.02,
                        0.4,
                        26.0,
                        2.0,
                        1e-4,
                        1e-9,
                        1e-8,
                        0.9,
                        0.1,
                        0.2,
                        0.05,
                        0.8,
                        new_mechanism=True,
                        jumps=1,
                        unsolved=1,
                        debris=1,
                        broken=1,
                    ),
                ),
                curve_end=CurveEnd.STEPS_DONE,
                curve_end_error=1e-3,
                curve_last_error=1e-2,
                rows=PushedRows(
                    load_factors=np.array([0.5, 0.4]),
                    shifts=np.stack([np.zeros((3, 3)), np.arange(9.0).reshape(3, 3) / 100.0]),
                    turns=np.stack([np.zeros((3, 3)), np.arange(9.0).reshape(3, 3) / 50.0]),
                    fallen=np.array([[False, False, False], [False, False, True]]),
                    energies=np.array([[0.0, 0.0, 0.0, 0.0, 0.0], [0.9, 0.1, 0.2, 0.05, 0.8]]),
                    errors=np.array([0.0, 1e-4]),
                    jumps=np.array([0, 1]),
                    unsolved=np.array([0, 1]),
                    point_start=np.array([0, 0, 2]),
                    points=RowPoints(
                        bodies=np.array([[0, 1], [-1, -1]]),
                        host=np.array([True, False]),
                        arms=np.arange(12.0).reshape(2, 2, 3),
                        frames=np.arange(18.0).reshape(2, 3, 3),
                        laws=np.array([1, 0]),
                        areas=np.array([[0.1, 0.2], [0.0, 0.3]]),
                        history=np.arange(6.0).reshape(2, 3),
                        forces=np.arange(6.0, 12.0).reshape(2, 3),
                    ),
                    stiffness=np.array([1e9, 4e8]),
                ),
            ),
            modes=modes(),
            modes_after=replace(modes(), periods=np.array([0.25]), pressed=np.array([0.5, 0.25])),
            geometric_safety=GeometricSafety(
                sizes=np.array([0.4, 0.3999]),
                pressed=np.array([100.0, 100.0]),
                load_factors=np.array([100.1, 99.9]),
                forces=np.arange(48.0).reshape(2, 8, 3),
                mechanisms=np.stack([mechanics.mechanism, 0.5 * mechanics.mechanism]),
                solves=6,
                verified=True,
            ),
            sensitivity=(
                Slope("joints.dry.friction", 0.6, "", 0.5, 0.6, Side.BOTH, ""),
                Slope("joints.dry.cohesion", 0.0, "N/m^2", 1.25e-5, 0.0, Side.ABOVE, ""),
                Slope(
                    "blocks.0.box.max.0", 4.0, "m", np.nan, np.nan, Side.NONE, "a small change is one of the contacts"
                ),
            ),
            time_history=rocks(),
            soil_range=(SoilPath(0.0, np.nan, "not_verified", "it was not seen"), SoilPath(1.0, 0.5, "solved", "")),
        ),
        size=ModelSize(2, 1, 3, 2, 4, 4),
        reductions=(STEP,),
        solver="mbla",
    )


def standing_at(number: int, count: int, point: Any, distance: float, behind: Any = ()) -> Travel:
    """A force of 1 N on the tower that travels, or the first axle of a vehicle along x; the others are off the path."""
    axles = np.array([0.0, *behind])
    points, forces = np.asarray(point, float) - axles[:, None] * [1.0, 0, 0], np.tile([0.0, 0, -1], (len(axles), 1))
    on = np.where(axles > 0, -1, 1)
    return Travel(TravelPosition("train", number, count, points, distance - axles, forces, on))


TIE = Ties(
    names=("rod[0]",),
    forms=("tie",),
    closed=np.array([1]),
    start=np.array([0, 2]),
    bodies=np.array([1, -1]),
    places=np.array([[0.0, 0, 1], [-1, 0, 1]]),
    pulls=np.array([[-1.0, 0, 0], [1, 0, 0]]),
    least=np.array([-1.0]),
    greatest=np.array([4.0]),
    prestress=np.array([2.0]),
    breaks_at=np.array([0.1]),
)


def full_model(model: Model) -> Model:
    """The tower with a load case for each question, and a guide."""
    arrays, n_bodies = np.arange(54.0).reshape(3, 3, 6), len(model.blocks) + len(model.grounds)
    pushover = Pushing(
        0.02,
        np.inf,
        -0.1,
        1,
        np.array([1]),
        np.array([1.0, 0.0, 0.0]),
        True,
        dead_levers=np.arange(27.0).reshape(3, 9),
        live_levers=np.arange(27.0, 54.0).reshape(3, 9),
        dead_following=np.arange(18.0).reshape(3, 6),
        live_following=np.arange(18.0, 36.0).reshape(3, 6),
        live_following_levers=np.arange(27.0).reshape(3, 9),
    )
    travel = Travel(replace(standing_at(2, 12, np.array([1.0, 2.0, 3.0]), 2.5).place, spread=True))
    angle = Angle(Tilt(np.array([0.0, 1.0, 0.0]), arrays[0], arrays[1], arrays[2], 12.5, False, np.inf))
    force = Force(
        Settlement(np.zeros(0, dtype=np.int64), np.zeros((0, 6)), False, "force", 3.0, 20.0, -1.0),
        Objective("thrust", "greatest", 0.5, np.arange(n_bodies) % 3 - 1, np.array([0]), np.array([0.0, 0.6, 0.8])),
    )
    not_run = model.load_cases[2]
    sinking = np.array([[0.0, 0, -1, 0, 0, 0]])
    settlement = Settlement(np.array([0]), sinking, False, "settlement of 1 block", 30.0, 20.0)
    ways = np.eye(6)[None] * np.array([1.0, 1, 1, 1, 1, 0])
    return replace(
        model,
        load_cases=(
            replace(model.load_cases[0], question=Reaction(settlement), assessment=ASSESSED),
            model.load_cases[1],
            replace(not_run, pushover=pushover, question=travel, time_history=asked()),
            replace(not_run, name="table", question=angle),
            replace(not_run, name="thrust", question=force),
        ),
        guides=Guides(np.array([2]), np.array([0]), ways, ("1 block held in rz",)),
        fill=CarriedFill(0.5 * model.blocks.added_masses, model.blocks.added_mass_points, ("soil: 1 m deep",)),
        ties=TIE,
    )


def same_findings(first: Results, second: Results) -> bool:
    """Whether two results are the same in all that is not the model: a result file has that by its deck."""
    return same(with_model_of(first, second), second)


def with_model_of(first: Results, second: Results) -> Results:
    """What was found of the first, with the model and the loads of the second."""
    cases = zip(first.cases, second.cases, strict=True)
    as_second = tuple(replace(own, load_case=other.load_case) for own, other in cases)
    return replace(first, assembly=second.assembly, cases=as_second)


def same(first: Any, second: Any) -> bool:
    """Deep equality of records, arrays (type, shape, values, nan equal to nan) and containers."""
    if isinstance(first, np.ndarray) or isinstance(second, np.ndarray):
        first, second = np.asarray(first), np.asarray(second)
        return (
            first.dtype == second.dtype
            and first.shape == second.shape
            and np.array_equal(first, second, equal_nan=True)
        )
    if hasattr(first, "__dataclass_fields__"):
        return type(first) is type(second) and all(
            same(getattr(first, field.name), getattr(second, field.name)) for field in fields(first) if field.compare
        )
    if isinstance(first, (tuple, list)) and isinstance(second, (tuple, list)):
        return len(first) == len(second) and all(map(same, first, second))
    if isinstance(first, dict):
        return list(first) == list(second) and all(same(first[key], second[key]) for key in first)
    if isinstance(first, float) and isinstance(second, float) and np.isnan(first):
        return bool(np.isnan(second))
    return bool(first == second)
