"""What a picture shows of a load case, found once for all kinds of picture."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.clusters import clusters_of
from mbla.results.collapse.collapse import Collapse, Failure, collapse_of, failure_of, fall_of
from mbla.results.collapse.finite_motion import finite_motion
from mbla.results.collapse.force_freedom import ForceFreedom, force_freedom
from mbla.results.collapse.interface_modes import InterfaceMotion
from mbla.results.collapse.motion import moved_contact_points, moved_vertices
from mbla.results.collapse.rigid_parts import rigid_parts
from mbla.results.collapse.thrust import Thrust, points_to_draw, thrust_lines, thrust_of
from mbla.results.collapse.torsion_use import torsion_use
from mbla.results.listing.mechanism_words import mechanism_summary
from mbla.results.listing.text import counted, number
from mbla.results.listing.verdict_words import verdict
from mbla.results.outcome import result_of
from mbla.results.pictures.geometry import ground_slab
from mbla.results.pictures.options import PictureOptions
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Mechanics, Status

OUTSIDE_WORDS = "outside the joint (tension), drawn at its edge"


@dataclass(frozen=True)
class Scene:
    """One load case as it is drawn.

    motion : (n_blocks, 6) displacement and rotation of each block as drawn, m and rad; zero in pictures at rest
    shown_cases : those whose loads a picture of the model shows
    """

    results: Results
    case: CaseResult
    motion: FloatArray
    shown_cases: tuple[CaseResult, ...] = ()

    def with_case(self, case: CaseResult) -> Scene:
        """The same scene with another load case."""
        return replace(self, case=case)

    @cached_property
    def model(self) -> Model:
        """The model as it may move under the load case."""
        return self.results.model.of_case(self.case.load_case)

    @property
    def contacts(self) -> Contacts:
        """Of the model."""
        return self.results.contacts

    @property
    def mechanics(self) -> Mechanics | None:
        """Forces and velocities to draw, whether they are a result or not; ``is_result`` says which."""
        return self.case.solution.mechanics

    @property
    def is_result(self) -> bool:
        """Whether forces and mechanism are a result of the case; else the picture must say that they are not."""
        return result_of(self.case) is not None

    @cached_property
    def size(self) -> float:
        """Diagonal of the box around the model, m."""
        return float(np.linalg.norm(np.ptp(self.model.blocks.vertices, axis=0)))

    @cached_property
    def moved(self) -> FloatArray:
        """Vertices as moved, (n_vertices, 3) m."""
        return moved_vertices(self.model.blocks, self.motion)

    @cached_property
    def contact_sides(self) -> tuple[FloatArray, FloatArray]:
        """Contact points as moved with body a and with body b, (n_points, 3) m each."""
        sides = [moved_contact_points(self.model, self.contacts, self.motion, side) for side in (0, 1)]
        return sides[0], sides[1]

    @cached_property
    def collapse(self) -> Collapse | None:
        """Modes, parts and work of the mechanism; None without one."""
        if self.mechanics is None:
            return None
        return collapse_of(self.model, self.contacts, self.case.load_case, self.mechanics)

    @cached_property
    def failure(self) -> Failure | None:
        """Clusters, hinge lines, sliding planes and cracks, numbered as in the listing; None without a mechanism."""
        if self.mechanics is None or self.collapse is None:
            return None
        return failure_of(self.model, self.contacts, self.collapse, self.mechanics)

    @cached_property
    def clusters(self) -> IntArray:
        """Part of the listing that each block is in, 0 at rest, (n_blocks,); found alike without equilibrium."""
        if self.failure is not None:
            return self.failure.main.of_block
        motion = self.case.solution.certificate
        if motion is None or self.mechanics is not None:
            return np.zeros(len(self.model.blocks), dtype=np.int64)
        exact = rigid_parts(self.model, self.contacts, motion)
        return clusters_of(self.model, self.contacts, exact, motion).of_block

    @cached_property
    def joint_motion(self) -> InterfaceMotion | None:
        """What each interface does in what is drawn, a mechanism or the motion that shows a lack of equilibrium."""
        if self.collapse is not None:
            return self.collapse.interfaces
        motion = self.case.solution.certificate
        return None if motion is None else fall_of(self.model, self.contacts, motion)[0].interfaces

    @cached_property
    def dead_load(self) -> FloatArray:
        """Dead load on blocks about their centroids, (n_blocks, 6), without the reaction that holds a support."""
        load_case = self.case.load_case
        if load_case.settlement is None:
            return load_case.dead_load
        loads = load_case.dead_load.copy()
        loads[load_case.settlement.blocks] = 0.0
        return loads

    @cached_property
    def forces(self) -> tuple[FloatArray | None, str]:
        """Contact forces to draw, (n_points, 3) N, and what they are; None where there are none."""
        solution = self.case.solution
        if solution.mechanics is not None:
            gives = self.case.load_case.settlement is not None
            besides = "as the support gives way" if gives else "and live load times load factor"
            return solution.mechanics.contact_forces, f"contact forces under dead load {besides}"
        if solution.lock is not None:
            return solution.lock, "contact forces that balance the live load alone: any multiple of it is carried"
        if solution.standing is not None and solution.standing.forces is not None:
            return solution.standing.forces, "contact forces under the dead load alone"
        return None, "no contact forces to draw: none were found that carry the loads"

    @cached_property
    def thrust(self) -> Thrust | None:
        """Resultants of the interfaces and where they act; None without forces."""
        forces = self.forces[0]
        return None if forces is None else thrust_of(self.model, self.contacts, forces)

    @cached_property
    def thrust_points(self) -> FloatArray:
        """Where resultants are drawn, (n_interfaces, 3) m; those outside their joint at its edge."""
        assert self.thrust is not None  # asked for where there are forces
        return points_to_draw(self.contacts, self.thrust)

    @cached_property
    def joint_use(self) -> FloatArray | None:
        """Shear and torsion over what each interface carries of both, (n_interfaces,); None without forces."""
        forces = self.forces[0]
        if forces is None:
            return None
        return torsion_use(self.model, self.contacts, forces, self.case.solution.contact_model)

    @cached_property
    def force_freedom(self) -> ForceFreedom | None:
        """How far the forces are unique; None where there is no result or it was not determined."""
        solution = self.case.solution
        if not self.is_result or solution.mechanics is None:
            return None
        dimension = 3 if solution.size is None else solution.size.dimension
        found = force_freedom(self.model, self.contacts, solution.mechanics, dimension)
        return None if isinstance(found, str) else found

    @cached_property
    def thrust_lines(self) -> list[FloatArray]:
        """Points of each line of thrust in their order, (n, 3) m each."""
        if self.thrust is None:
            return []
        return [self.thrust_points[row] for row in thrust_lines(self.model, self.contacts, self.thrust)]

    @cached_property
    def slabs(self) -> list[FloatArray]:
        """Corners of the slab under each ground plane that something stands on, (8, 3) each."""
        rows = range(len(self.model.grounds))
        slabs = [ground_slab(self.model, self.contacts, row, self.size) for row in rows]
        return [corners for corners in slabs if corners is not None]

    def words_of(self, kind: str) -> list[str]:
        """Title, and for all but the model the outcome of the case and what the picture shows, one line each."""
        case, model = self.case, self.model
        title = model.title or self.results.deck.name
        if kind == "model":
            units, free = model.units, len(model.free)
            weight = f"weight {number(model.total_weight)} {units.force}"
            return [title, f"{counted(len(model.blocks), 'block')}, {free} free; {weight}"]
        lines = [title, f"load case {case.load_case.name}: {verdict(model, case)}"]
        if kind == "forces":
            lines.append(self.forces[1] + self._unpressed_words() + self._freedom_words())
        elif self.collapse is not None and self.failure is not None:
            lines.append(mechanism_summary(model, self.collapse, self.failure))
        elif case.solution.certificate is not None:
            lines.append("drawn: the motion in which the dead load does more work than the joints take")
        else:
            lines.append("drawn at rest: there is no mechanism")
        return lines

    def _unpressed_words(self) -> str:
        """How many forces have no point of application in their joint, and so are not in the picture."""
        count = 0 if self.thrust is None else int(self.thrust.unpressed.sum())
        return f"; not drawn: {counted(count, 'joint')} in tension or shear without compression" if count else ""

    def _freedom_words(self) -> str:
        """Whether forces other than these would do; nothing of forces that are no result."""
        solution, mechanics = self.case.solution, self.mechanics
        if mechanics is None:
            return "" if self.forces[0] is None else "; others may do so too"
        if not self.is_result:
            return ""
        freedom = self.force_freedom
        if freedom is None:
            return "; one possible state: whether there are others was not determined"
        if freedom.degree == 0:
            return "; unique" + ("" if solution.flow_rule == "associative" else " in this mechanism")
        known = int(freedom.determined.sum())
        return (
            f"; one possible state: they may vary in up to {counted(freedom.degree, 'way')}, "
            f"{known} of {counted(len(self.contacts), 'resultant')} are unique"
        )

    def mark_of(self, kind: str) -> str:
        """What a reader must not overlook: that figures are not verified, or no result; empty where they are."""
        status = self.case.status
        if kind == "model" or status in (Status.SOLVED, Status.UNBOUNDED, Status.NO_EQUILIBRIUM):
            return "" if kind == "model" or self.is_result or self.mechanics is None else "NO RESULT: no collapse load"
        if status is Status.APPROXIMATE and self.is_result:
            return "APPROXIMATE: residuals are larger than for a solved case"
        return (
            "NOT VERIFIED: no result"
            if self.mechanics is None
            else "NOT VERIFIED: no result, the best that was reached"
        )


def motion_as_drawn(results: Results, case: CaseResult, scale: float) -> FloatArray:
    """Displacement and rotation of each block, (n_blocks, 6) m and rad, at a multiple of the usual size."""
    return finite_motion(results.model.of_case(case.load_case), results.contacts, case, scale)


def scene_of(results: Results, case: CaseResult, options: PictureOptions, kind: str) -> Scene:
    """A case as a picture of that kind shows it: moved in a picture of the mechanism, at rest in others."""
    motion = motion_as_drawn(results, case, options.scale)
    shown = [each for each in results.cases if options.case in (None, each.load_case.name, each.load_case.deck_name)]
    return Scene(results, case, motion if kind == "mechanism" else np.zeros_like(motion), tuple(shown))


# --- Tints of the parts that move: neighbours get different ones, however many parts there are ----------------------


def tint_of_part(scene: Scene, parts: IntArray, n_tints: int) -> IntArray:
    """Tint of each part, (n_parts,), heaviest first: its own, or of too many parts the first that no neighbour has.

    parts : (n_blocks,) part of each block, 0 at rest
    """
    count = int(parts.max(initial=0)) + 1
    if count - 1 <= n_tints:
        return np.maximum(np.arange(count) - 1, 0)
    node = np.append(parts, np.zeros(len(scene.model.grounds), dtype=np.int64))
    pairs = np.unique(np.sort(node[scene.contacts.bodies], axis=1), axis=0)
    neighbours: list[list[int]] = [[] for _ in range(count)]
    for first, second in pairs.tolist():
        if 0 < first < second:
            neighbours[second].append(first)
    tints = np.zeros(count, dtype=np.int64)
    for part in range(1, count):
        taken = {int(tints[other]) for other in neighbours[part]}
        free = [tint for tint in range(n_tints) if tint not in taken]
        tints[part] = free[0] if free else part % n_tints
    return tints
