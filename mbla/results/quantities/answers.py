"""Answers of a solution: forces and velocities at a load factor, by a flow rule each, as the solver claims them."""

from __future__ import annotations

from collections.abc import Callable

from mbla.arrays import FloatArray
from mbla.results.collapse.collapse import Collapse, collapse_of
from mbla.results.quantities.group import Field, Group
from mbla.results.quantities.quantity import Quantity
from mbla.results.record.scene import Scene
from mbla.solution.solution import Mechanics
from mbla.solution.verification.verify import residual_of

MOTIONS = ("torsion_motions", "crushing_motions")
"""motions of interfaces, in the order in which they are stacked"""


def _associative(scene: Scene) -> Mechanics | None:
    """None where it is the answer of the deck's own flow rule: the file does not hold it twice."""
    solution = scene.solved.solution
    own = solution.flow_rule == "associative" and solution.associative is solution.mechanics
    return None if own else solution.associative


ANSWERS: dict[str, tuple[str, str, Callable[[Scene], Mechanics | None]]] = {
    "mechanics": ("", "by the deck's flow rule", lambda scene: scene.solved.solution.mechanics),
    "associative": ("/associative", "by the associative flow rule, where that is not the deck's", _associative),
    "least": (
        "/least",
        "the least of the states of rigid joints that a search found",
        lambda scene: scene.solved.solution.least,
    ),
    "torsion": (
        "/torsion",
        "on the path of elastic joints with torsion of uniform pressure",
        lambda scene: scene.solved.solution.torsion,
    ),
    "level": (
        "/level",
        "of the level table with the load across, by the associative flow rule",
        lambda scene: scene.solved.solution.level,
    ),
}
"""by its name in a solution: group below the load case, whose forces and velocities it has, and where it is"""


def _declared(answer: str) -> dict[str, Quantity]:
    group, whose, of = ANSWERS[answer]
    place = Group[Mechanics](of, file=f"cases/*{group}", part=answer)
    fields = place.fields(
        Mechanics,
        load_factor=Field(f"load factor, {whose}"),
        contact_forces=Field(
            "contact force N, T1, T2 on body b in the point's frame, compression positive",
            "point direction",
            unit="force",
        ),
        contact_velocities=Field(
            "velocity of body b relative to a in the point's frame, opening positive",
            "point direction",
            unit="velocity",
        ),
        mechanism=Field(
            "velocity and angular velocity about the centroid, live load power = 1",
            "block component",
            unit="velocities",
        ),
        modes=Field("contact mode: 0 stick, 1 slide, 2 open, 3 crush", "point"),
        resultants=Field(
            "convex contact model: N, T1, T2 and moments about normal, tangent 1, tangent 2 at the centroid, on body b",
            "interface component",
            unit="load",
            part="{} resultants",
        ),
        tie_forces=Field(
            "force of ties, tension positive; nan: between what does not move",
            "tie",
            unit="force",
            rule="open",
            part="{} ties",
        ),
        tie_rates=Field("elongation rates of ties", "tie", unit="velocity", rule="open", part="{} ties"),
        remembered=Field(
            "path of elastic joints: N, T1, T2 that a joint would have if it did not move in the step of "
            "this state; that the history is that of the loading mbla verify checks with --again alone",
            "point direction",
            unit="force",
            part="{} history",
            unverified="history",
        ),
        stiffness=Field(
            "path of elastic joints: normal and shear stiffness in that step, force lost for a velocity",
            "point spring",
            unit="stiffness",
            part="{} history",
            unverified="history",
        ),
        crushed=Field(
            "path of elastic joints: motion by which interfaces that crush had done so before the step of "
            "this state, over its length",
            "interface component",
            unit="velocities",
            part="{} crushed",
            unverified="history",
        ),
        tie_remembered=Field(
            "the same of ties, as points between their ends, compression positive",
            "tie",
            unit="force",
            rule="open",
            part="{} history of ties",
            unverified="history",
        ),
        tie_stiffness=Field(
            "stiffness of ties in that step",
            "tie",
            unit="stiffness",
            rule="open",
            part="{} history of ties",
            unverified="history",
        ),
    )
    _declare_motions(place, answer)
    _declare_residual(answer)
    return fields


def _declare_motions(place: Group[Mechanics], answer: str) -> None:
    @place.quantity(dims="interface component", unit="velocities", part="{} resultants")
    def torsion_motions(mechanics: Mechanics) -> FloatArray | None:
        """Convex contact model: motion of the interface that torsion allows it, dual to the resultants."""
        return None if mechanics.interface_motions is None else mechanics.interface_motions[:, 0]

    @place.quantity(dims="interface component", unit="velocities", part="{} resultants")
    def crushing_motions(mechanics: Mechanics) -> FloatArray | None:
        """Convex contact model: motion of the interface that crushing allows it, dual to the resultants."""
        return None if mechanics.interface_motions is None else mechanics.interface_motions[:, 1]


def _declare_residual(answer: str) -> None:
    group, _, of = ANSWERS[answer]
    place = Group[Scene](lambda scene: None if of(scene) is None else scene, file=f"cases/*{group}", part=answer)

    @place.quantity(rule="open")
    def residual(scene: Scene) -> float:
        """By how much these forces and velocities violate the joint law at most, nan where nothing moves."""
        return residual_of(scene.assembly, scene.solved.load_case, scene.solved.solution, answer)


OWN = {answer: _declared(answer) for answer in ANSWERS}["mechanics"]
"""of the answer by the deck's flow rule"""


def claimed_collapse(scene: Scene) -> Collapse | None:
    """What follows from the mechanism that the solver claims, a result or not."""
    case = scene.solved
    mechanics = case.solution.mechanics
    return None if mechanics is None else collapse_of(scene.assembly, case.load_case, mechanics)


_SOLVED = Group[Scene](lambda scene: scene, file="cases/*")


@_SOLVED.quantity(dims="interface component", unit="motion", part="certificate motions")
def certificate_torsion_motions(scene: Scene) -> FloatArray | None:
    """Convex contact model: motion of the interfaces by torsion that belongs to the certificate."""
    motions = scene.solved.solution.certificate_motions
    return None if motions is None else motions[:, 0]


@_SOLVED.quantity(dims="interface component", unit="motion", part="certificate motions")
def certificate_crushing_motions(scene: Scene) -> FloatArray | None:
    """Convex contact model: motion of the interfaces by crushing that belongs to the certificate."""
    motions = scene.solved.solution.certificate_motions
    return None if motions is None else motions[:, 1]


@_SOLVED.quantity(dims="carrier direction", unit="force", part="lock")
def lock(scene: Scene) -> FloatArray | None:
    """Unbounded: contact forces."""
    return scene.solved.solution.lock


LEVEL = Group[Scene](lambda scene: scene, file="cases/*/level")


@LEVEL.quantity(dims="carrier direction", unit="force", part="level lock", name="lock")
def level_lock(scene: Scene) -> FloatArray | None:
    """Level table: contact forces."""
    return scene.solved.solution.level_lock
