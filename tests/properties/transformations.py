"""The table of metamorphic checks: what is done to a scene, and how its load factor may move, with the reason.

Under associative flow the load factor is the value of a convex program, unique, and

- whatever states the same mechanics in another way leaves it (EQUAL);
- whatever admits more forces, or fewer motions, never lowers it (RISES): static and kinematic theorem;
- whatever admits fewer forces, or more motions, never raises it (FALLS).

Without normality the factor is not unique and none of the monotonic statements is a theorem: more friction, glue or
strength may lower the factor that a scheme comes to rest on. What remains is EQUAL up to the choice of a state
(:mod:`tests.properties.metamorphic`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.contacts import Contacts
from mbla.deck.loads import Load, LoadCaseSection
from mbla.deck.units import Units
from mbla.model import build_model
from mbla.model.ragged import items_of_rows
from tests.properties.additions import movable, split_in_two, with_far_part
from tests.properties.rigid_motions import in_other_units, moved_scene, renumbered, with_forces
from tests.properties.scenes import Scene, Solved, value_of, with_analysis, with_section


class Relation(StrEnum):
    """How the load factor may move."""

    EQUAL = "equal"
    RISES = "never lower"
    FALLS = "never higher"
    ENCLOSED = "between both polyhedra"


@dataclass(frozen=True)
class Transformation:
    """One row of the table.

    make    : the other scene from the scene and what came out of it; None where it does not apply
    reason  : why the relation holds
    ratio   : new load factor over the old one where they are equal but for scale
    any_flow : also tried without normality
    turn    : by which vectors turn
    """

    name: str
    relation: Relation
    reason: str
    make: Callable[[Scene, Solved], Scene | None]
    ratio: float = 1.0
    any_flow: bool = False
    turn: Callable[[Scene], FloatArray] | None = None


def rotation(axis: tuple[float, float, float], degrees: float) -> FloatArray:
    """Rodrigues' formula."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    cross, angle = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]), np.deg2rad(degrees)
    turn: FloatArray = np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross
    return turn


def _size(scene: Scene) -> float:
    return float(np.ptp(scene.model.blocks.vertices, axis=0).max())


def translate(scene: Scene, _: Solved) -> Scene:
    """By some lengths of the structure."""
    return moved_scene(scene, np.eye(3), _size(scene) * np.array([3.7, -2.3, 1.9]))


def rotate(scene: Scene, _: Solved) -> Scene | None:
    """With its loads; about the vertical where beds are told from heads, not where places are told by boxes."""
    if '"box"' in scene.section_text:
        return None
    return moved_scene(scene, turn_of(scene), np.zeros(3))


def turn_of(scene: Scene) -> FloatArray:
    """The rotation of ``rotate``."""
    level = '"bed"' in scene.section_text or '"head"' in scene.section_text
    return rotation((0, 0, 1), 33.0) if level else rotation((1, 2, -1), 71.0)


def reflection(_: Scene) -> FloatArray:
    """Of ``mirror``."""
    return np.diag([-1.0, 1.0, 1.0])


def mirror(scene: Scene, _: Solved) -> Scene:
    """In a plane across x: loads, moments, axes and guides with it."""
    return moved_scene(scene, reflection(scene), np.zeros(3))


def renumber(scene: Scene, _: Solved) -> Scene | None:
    """Blocks in a random order."""
    if '"index"' in scene.section_text or scene.model.interfaces is not None:
        return None
    order = np.random.default_rng(7).permutation(len(scene.model.blocks))
    return renumbered(scene, order)


def millimetres(scene: Scene, _: Solved) -> Scene:
    """Millimetres, kilonewtons, tonnes."""
    return in_other_units(scene, Units("mm", "kN", "t"))


def feet(scene: Scene, _: Solved) -> Scene:
    """Feet and pounds."""
    return in_other_units(scene, Units("ft", "lbf", "lb"))


def taken(contacts: Contacts, rows: IntArray) -> Contacts:
    """Some of the interfaces, in the order given."""
    points = items_of_rows(contacts.point_start, rows)
    return replace(
        contacts,
        bodies=contacts.bodies[rows],
        normals=contacts.normals[rows],
        areas=contacts.areas[rows],
        centroids=contacts.centroids[rows],
        gaps=contacts.gaps[rows],
        joints=contacts.joints[rows],
        point_start=starts(np.diff(contacts.point_start)[rows]),
        outline=contacts.outline[rows],
        points=contacts.points[points],
        frames=contacts.frames[points],
        point_areas=contacts.point_areas[points],
    )


def reverse_interfaces(scene: Scene, _: Solved) -> Scene:
    """The last interface first."""
    return replace(scene, change=lambda contacts: taken(contacts, np.arange(len(contacts))[::-1]))


def open_an_interface(scene: Scene, solved: Solved) -> Scene | None:
    """One interface less, a random one."""
    if len(solved.contacts) < 2 or scene.model.mirrors:
        return None
    lost = int(np.random.default_rng(11).integers(len(solved.contacts)))
    return replace(scene, change=lambda contacts: taken(contacts, np.delete(np.arange(len(contacts)), lost)))


def _unloaded_by_scale(scene: Scene) -> bool:
    return any(case.settlement is not None or case.tilt is not None for case in scene.model.load_cases)


def live_load_times(scale: float) -> Callable[[Scene, Solved], Scene | None]:
    """A stronger live load."""

    def make(scene: Scene, _: Solved) -> Scene | None:
        if _unloaded_by_scale(scene):
            return None
        cases = tuple(replace(case, live_load=scale * case.live_load) for case in scene.model.load_cases)
        return replace(scene, model=replace(scene.model, load_cases=cases))

    return make


PARTS_OF_A_LOAD = (0.3, 0.7)
"""factors of the two named loads that a load is divided into"""


def named_loads(scene: Scene, _: Solved) -> Scene | None:
    """In the deck: every load of every list as two named ones with a share each, and each list the two together.

    Loads at one position after another, and a table that tilts, are whole; a support that gives way has no live loads.
    """
    content = scene.deck.content
    kept = {case.name for case in scene.model.load_cases}
    if not kept <= set(content.load_cases) or any(_cannot_be_shared(case) for case in content.load_cases.values()):
        return None
    named, cases = dict(content.loads), {}
    for name, case in content.load_cases.items():
        lists = {side: loads for side in ("dead", "live") if (loads := getattr(case, side))}
        both = {side: [Load(loads=f"{name}_{side}_{part}") for part in range(2)] for side in lists}
        for side, loads in lists.items():
            for part, share in enumerate(PARTS_OF_A_LOAD):
                shared = [load.model_copy(update={"factor": share * load.factor}) for load in loads]
                named[f"{name}_{side}_{part}"] = shared
        cases[name] = case.model_copy(update=both)
    deck = replace(scene.deck, content=content.model_copy(update={"loads": named, "load_cases": cases}))
    model = build_model(deck)
    chosen = tuple(case for case in model.load_cases if case.name in kept)
    return replace(scene, deck=deck, model=replace(model, load_cases=chosen))


def _cannot_be_shared(case: LoadCaseSection) -> bool:
    return any(load.travel is not None or load.tilt is not None for load in case.live or [])


def heavier(scene: Scene, _: Solved) -> Scene:
    """All densities, forces and strengths times 37: accelerations stay as they are."""
    blocks = scene.model.blocks
    blocks = replace(blocks, densities=37.0 * blocks.densities, added_masses=37.0 * blocks.added_masses)
    return replace(scene, model=with_forces(replace(scene.model, blocks=blocks), 37.0, 37.0, 37.0, 1.0))


def strengthless(scene: Scene, solved: Solved) -> bool:
    """No joint in use has cohesion, tensile or limited compressive strength."""
    used = [scene.model.joints[name] for name in solved.contacts.joint_names if name in scene.model.joints]
    return not any(j.cohesion or j.tensile_strength or np.isfinite(j.compressive_strength) for j in used)


def refine(scene: Scene, solved: Solved) -> Scene | None:
    """Edges in two parts, points inside."""
    points = scene.deck.contacts.points
    if scene.deck.analysis.contact_model == "convex" or points.spacing is not None or scene.model.mirrors:
        return None
    if not strengthless(scene, solved):
        return None
    return with_section(scene, points=points.model_copy(update={"per_edge": 2 * (points.per_edge or 1)}))


def refine_with_strength(scene: Scene, solved: Solved) -> Scene | None:
    """The same where joints have strengths."""
    points = scene.deck.contacts.points
    if scene.deck.analysis.contact_model == "convex" or points.spacing is not None or scene.model.mirrors:
        return None
    if strengthless(scene, solved):
        return None
    return with_section(scene, points=points.model_copy(update={"per_edge": 2 * (points.per_edge or 1)}))


def split(askew: float) -> Callable[[Scene, Solved], Scene | None]:
    """One block as two that are glued; not where the division of an interface changes what it bears."""

    def make(scene: Scene, solved: Solved) -> Scene | None:
        points = scene.deck.contacts.points
        if scene.deck.analysis.contact_model == "convex" or not strengthless(scene, solved):
            return None
        if points.inset or points.rounding:
            return None
        return split_in_two(scene, askew)

    return make


def with_joints(change: Callable[..., dict[str, Any]]) -> Callable[[Scene, Solved], Scene | None]:
    """Other joint laws; ``change`` gets the law and the mean stress in the joints."""

    def make(scene: Scene, solved: Solved) -> Scene | None:
        loads = np.linalg.norm(scene.model.load_cases[0].dead_load[:, :3], axis=1)
        if not len(solved.contacts) or not scene.model.joints:
            return None
        stress = float(loads.mean() / solved.contacts.areas.mean()) or 1.0
        joints = {name: replace(joint, **change(joint, stress)) for name, joint in scene.model.joints.items()}
        return replace(scene, model=replace(scene.model, joints=joints))

    return make


def far_part(scene: Scene, _: Solved) -> Scene | None:
    """Base and block 20 lengths away, no live load on them."""
    return with_far_part(scene, None)


def part_at_rest(scene: Scene, solved: Solved) -> Scene | None:
    """The same under live load that moves it at twice the load factor."""
    factors = tuple(2.0 * value_of(case) for case in solved.cases)
    if not all(np.isfinite(factors)) or min(factors) < 1e-6 or _unloaded_by_scale(scene):
        return None
    return with_far_part(scene, factors)


def fix_a_block(scene: Scene, solved: Solved) -> Scene | None:
    """One free block more that does not move, a random one; not where glue would hold others with it."""
    model = scene.model
    if solved.contacts.solid_of_block is not None:
        return None
    free = np.sort(movable(model))
    if len(free) < 2 or model.mirrors:
        return None
    block = int(np.random.default_rng(13).choice(free))
    fixed = model.fixed.copy()
    fixed[block] = True
    rest = ~fixed
    if not all(np.abs(case.live_load[rest]).max(initial=0.0) > 0 or case.settlement for case in model.load_cases):
        return None
    return replace(scene, model=replace(model, fixed=fixed))


def unreduced(scene: Scene, _: Solved) -> Scene:
    """Nothing left out before the solver."""
    switches = scene.deck.analysis.reductions
    off = switches.model_copy(update=dict.fromkeys(type(switches).model_fields, False))
    return with_analysis(scene, reductions=off)


def static_form(scene: Scene, _: Solved) -> Scene | None:
    """Forces for unknowns."""
    return None if scene.deck.analysis.contact_model == "convex" else with_analysis(scene, form="static")


def other_solver(scene: Scene, solved: Solved) -> Scene | None:
    """Clarabel in place of the program's own method, or the other way round."""
    if scene.deck.analysis.contact_model == "convex":
        return None
    taken_before = {program.solver for case in solved.cases for program in case.solution.programs}
    return with_analysis(scene, solver="mbla" if "clarabel" in taken_before else "clarabel")


def convex_model(scene: Scene, _: Solved) -> Scene | None:
    """Conditions on resultants beside those on points."""
    points = scene.deck.contacts.points
    if scene.deck.analysis.contact_model == "convex" or points != type(points)():
        return None
    return with_analysis(scene, contact_model="convex")


def polyhedra(scene: Scene, _: Solved) -> Scene | None:
    """Octagons inside and outside of the cone."""
    if scene.deck.analysis.contact_model == "convex" or any(c.settlement or c.tilt for c in scene.model.load_cases):
        return None
    return with_analysis(scene, friction_cone="polyhedral")


E_, R_, F_ = Relation.EQUAL, Relation.RISES, Relation.FALLS
TABLE = (
    Transformation("translate", E_, "statics knows no origin", translate),
    Transformation("rotate with gravity", E_, "statics knows no axes", rotate, any_flow=True, turn=turn_of),
    Transformation(
        "mirror", E_, "forces mirror as vectors, moments as axial vectors", mirror, any_flow=True, turn=reflection
    ),
    Transformation("renumber blocks", E_, "names carry nothing", renumber, any_flow=True),
    Transformation("units mm, kN, t", E_, "a load factor has no unit", millimetres, any_flow=True),
    Transformation("units ft, lbf, lb", E_, "a load factor has no unit", feet),
    Transformation("reverse the order of interfaces", E_, "sums do not know their order", reverse_interfaces),
    Transformation("live load times 8", E_, "the factor is inversely proportional", live_load_times(8.0), 0.125, True),
    Transformation(
        "every load as two named loads, combined", E_, "loads add up, whatever they are called", named_loads
    ),
    Transformation(
        "densities, forces, strengths times 37", E_, "equilibrium and yield are homogeneous", heavier, any_flow=True
    ),
    Transformation(
        "split a block into two glued",
        E_,
        "a rigid body is its parts; the corners of a divided interface have the same hull as before, "
        "and without strengths only the hull of the contact points counts",
        split(0.0),
        any_flow=True,
    ),
    Transformation("split it askew", E_, "the same", split(0.35)),
    Transformation(
        "refine contact points, no strengths",
        E_,
        "a force at a point within the hull is a sum of forces of the same direction at its corners: the cone of all "
        "is the same. In torsion too: it may still gather at the corners",
        refine,
        any_flow=True,
    ),
    Transformation(
        "refine contact points, strengths",
        F_,
        "each share of area of a point comes from the corners around it, so that the corners bear what the refined "
        "points bear; a theorem for triangles and parallelograms, whose corner shares the moments alone decide",
        refine_with_strength,
    ),
    Transformation("add a part far away", E_, "what nothing loads does not move", far_part, any_flow=True),
    Transformation("add a part that stays at rest", E_, "the weakest part decides", part_at_rest),
    Transformation("without reductions", E_, "reductions are exact", unreduced),
    Transformation("static form", E_, "strong duality", static_form),
    Transformation("another cone solver", E_, "the optimum is one", other_solver),
    Transformation("friction times 1.2", R_, "a wider cone", with_joints(lambda j, _: {"friction": 1.2 * j.friction})),
    Transformation(
        "cohesion added", R_, "more shear is borne", with_joints(lambda j, s: {"cohesion": j.cohesion + 0.1 * s})
    ),
    Transformation(
        "tensile strength added, with the cohesion it asks for",
        R_,
        "tension is borne",
        with_joints(
            lambda j, s: {
                "tensile_strength": j.tensile_strength + 0.1 * s,
                "cohesion": j.cohesion + 0.1 * s * j.friction,
            }
        ),
    ),
    Transformation(
        "compressive strength lowered",
        F_,
        "less compression is borne",
        with_joints(lambda j, s: {"compressive_strength": 0.8 * min(j.compressive_strength, 50.0 * s)}),
    ),
    Transformation("fix a block", R_, "fewer motions", fix_a_block),
    Transformation("open an interface", F_, "one force less", open_an_interface),
    Transformation("convex contact model", F_, "conditions on resultants are added to those on points", convex_model),
    Transformation(
        "friction octagons", Relation.ENCLOSED, "inscribed polyhedron, cone, circumscribed polyhedron", polyhedra
    ),
)
