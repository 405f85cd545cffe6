"""What a picture shows of a load case, found once for all kinds of picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.results.collapse.collapse import NOTABLE, Collapse, Failure, failure_of, fall_of
from mbla.results.collapse.interface_modes import InterfaceMotion, within_soil
from mbla.results.collapse.joint_planes import cluster_joints
from mbla.results.collapse.motion import (
    drawn_motion,
    history_motion,
    largest_displacements,
    moved_vertices,
    peak_state,
)
from mbla.results.collapse.thrust import points_to_draw
from mbla.results.force_range import other_end
from mbla.results.listing.places import counted_soils
from mbla.results.listing.sections.mechanism_words import mechanism_summary
from mbla.results.listing.text import counted, number
from mbla.results.listing.verdict_words import verdict
from mbla.results.outcome import history_of, result_of
from mbla.results.pictures.geometry import Slab, ground_slabs
from mbla.results.pictures.marks.marks import outer_rows
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import FIXED_BLOCK, REST, SLOW
from mbla.results.record.scene import Scene
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Mechanics, Status

SEEN = 2e-3
"""displacement over the size of the model that is seen in a picture of it"""


@dataclass(frozen=True)
class PictureScene(Scene):
    """One load case as it is drawn; also what is no result, ``is_result`` says which.

    drawn : (n_blocks, 6) displacement and rotation of each block as drawn, m and rad; zero in pictures at rest
    shown_cases : those whose loads a picture of the model shows
    moment : of a structure in time, when that is and how it is drawn, in words
    """

    case: CaseResult
    results: Results
    drawn: FloatArray
    shown_cases: tuple[CaseResult, ...] = ()
    moment: str = ""

    @property
    def mechanics(self) -> Mechanics | None:
        """Forces and velocities to draw."""
        return self.case.solution.mechanics

    @cached_property
    def motion(self) -> FloatArray:
        """Displacement and rotation of each block as drawn, (n_blocks, 6) m and rad."""
        return self.drawn

    def moved_to(self, scale: float) -> PictureScene:
        """The same moved by a multiple of the usual displacements."""
        drawn = scale * drawn_motion(self.model, self.case)
        return replace(self, drawn=drawn, moment=_moment(self.case, drawn))

    @property
    def is_result(self) -> bool:
        """Whether forces and mechanism are a result of the case; else the picture must say that they are not."""
        return result_of(self.case) is not None or history_of(self.case) is not None

    @cached_property
    def size(self) -> float:
        """Diagonal of the box around the model, m."""
        return float(np.linalg.norm(np.ptp(self.model.blocks.vertices, axis=0)))

    @cached_property
    def moved(self) -> FloatArray:
        """Vertices as moved, (n_vertices, 3) m."""
        return moved_vertices(self.model.blocks, self.motion)

    @cached_property
    def displaced(self) -> BoolArray:
        """Blocks that are seen to have moved, (n_blocks,): those that are drawn where they were, too."""
        return np.asarray(largest_displacements(self.model.blocks, self.motion) > SEEN * self.size)

    @cached_property
    def _moving(self) -> tuple[Collapse, Mechanics] | None:
        """The mechanism, or the motion that shows a lack of equilibrium; None where there is neither."""
        if self.collapse is not None and self.mechanics is not None:
            return self.collapse, self.mechanics
        motion = self.case.solution.certificate
        return None if motion is None else fall_of(self.assembly, self.case.load_case, motion)

    @cached_property
    def failure(self) -> Failure | None:
        """Clusters, hinge lines, sliding planes and cracks of what is drawn, numbered as in the listing."""
        return None if self._moving is None else failure_of(self.model, self.contacts, *self._moving)

    @cached_property
    def apart(self) -> BoolArray:
        """Interfaces at which parts of the listing move against each other notably, (n_interfaces,)."""
        if self._moving is None:
            return np.zeros(len(self.contacts), dtype=bool)
        joints = cluster_joints(self.model, self.contacts, self.clusters, self._moving[1])
        return np.asarray(joints.between & (joints.shares >= NOTABLE))

    @property
    def clusters(self) -> IntArray:
        """Part of the listing that each block is in, 0 at rest, (n_blocks,)."""
        return np.zeros(len(self.model.blocks), dtype=np.int64) if self.failure is None else self.failure.clusters

    @property
    def slow(self) -> BoolArray:
        """Blocks that move although they are in no part of the listing, (n_blocks,): less than the few parts there."""
        if self._moving is None:
            return np.zeros(len(self.model.blocks), dtype=bool)
        return np.asarray((self.clusters == 0) & (self._moving[0].parts > 0))

    @property
    def joint_motion(self) -> InterfaceMotion | None:
        """What each interface does in what is drawn."""
        return None if self._moving is None else self._moving[0].interfaces

    @cached_property
    def dead_load(self) -> FloatArray:
        """Dead load on blocks about their centroids, (n_blocks, 6), without the reaction that holds a support."""
        loads = self.case.load_case.dead_load.copy()
        loads[self.case.load_case.question.giving_way] = 0.0
        return loads

    @cached_property
    def other_end(self) -> PictureScene | None:
        """Of a force whose least value is drawn the greatest, and the other way round; None where there is none."""
        other = other_end(self.results.cases, self.case)
        if other is None or other.solution.mechanics is None:
            return None
        return PictureScene(self.assembly, other, self.results, np.zeros_like(self.motion), self.shown_cases)

    @property
    def forces(self) -> FloatArray | None:
        """Contact forces to draw, (n_points, 3) N: at the load factor, else those that lock or carry the dead load."""
        solution = self.case.solution
        if solution.mechanics is not None:
            return solution.mechanics.contact_forces
        found = solution.lock
        if found is None and solution.standing is not None:
            found = solution.standing.forces
        return None if found is None else found[: len(self.contacts.points)]

    @property
    def force_words(self) -> str:
        """What these forces are."""
        if self.mechanics is not None:
            return f"{self.case.load_case.question.forces_drawn}; others may be possible"
        if self.forces is None:
            return "no contact forces to draw: none were found that carry the loads"
        if self.case.solution.lock is not None:
            return "contact forces that balance the live load alone: any multiple of it is carried"
        return "contact forces under the dead load alone"

    @cached_property
    def thrust_points(self) -> FloatArray:
        """Where resultants are drawn, (n_interfaces, 3) m; those outside their joint at its edge."""
        assert self.thrust is not None  # asked for where there are forces
        return points_to_draw(self.contacts, self.thrust)

    @cached_property
    def slabs(self) -> list[Slab]:
        """Slabs under each ground that something stands on."""
        rows = range(len(self.model.grounds))
        return [slab for row in rows for slab in ground_slabs(self.model, self.contacts, row, self.size)]

    def words_of(self, kind: str) -> list[str]:
        """Title, and for all but the model the outcome of the case and what the picture shows, one line each."""
        case, model = self.case, self.model
        title = model.title or self.results.deck.name
        if kind == "model":
            units, cells = model.units, model.soil_of_block >= 0
            blocks, free = counted(int((~cells).sum()), "block"), int((~cells[model.free]).sum())
            soils = "".join(f", {words}" for words in counted_soils(model))
            weight = f"weight {number(model.total_weight)} {units.force}"
            return [title, f"{blocks}, {free} free{soils}; {weight}"]
        lines = [title, f"load case {case.load_case.name}: {verdict(model, case)}"]
        if kind == "forces":
            lines.append(self.force_words + self._unpressed_words())
        elif self.collapse is not None and self.failure is not None:
            lines.append(mechanism_summary(model, self.collapse, self.failure))
        elif case.solution.certificate is not None:
            lines.append("drawn: the motion in which the dead load does more work than the joints take")
        elif self.moment:
            lines.append(self.moment)
        else:
            lines.append("drawn at rest: there is no mechanism")
        return lines

    def _unpressed_words(self) -> str:
        """How many forces have no point of application in their joint, and so are not in the picture."""
        if self.thrust is None:
            return ""
        count = int((self.thrust.unpressed & ~within_soil(self.model, self.contacts)).sum())
        return f"; not drawn: {counted(count, 'joint')} in tension or shear without compression" if count else ""

    def mark_of(self, kind: str) -> str:
        """What a reader must not overlook: that figures are not verified, or no result; empty where they are."""
        status = self.case.status
        if kind == "model" or status in (Status.SOLVED, Status.UNBOUNDED, Status.NO_EQUILIBRIUM):
            return "" if kind == "model" or self.is_result or self.mechanics is None else "NO RESULT: no collapse load"
        if status is Status.APPROXIMATE and self.case.load_case.time_history is not None:
            return f"APPROXIMATE: {self.case.solution.reason}"
        if status is Status.APPROXIMATE and self.is_result:
            return "APPROXIMATE: residuals are larger than for a solved case"
        return "NOT VERIFIED: no result" if self.mechanics is None else "NOT VERIFIED: no result, the best iterate"


def _moment(case: CaseResult, drawn: FloatArray) -> str:
    """When a structure in time is displaced as drawn, and how many times that is; empty for others."""
    found = case.solution.further.time_history
    if found.frames is None or case.solution.certificate is not None:
        return ""
    state = peak_state(found)
    true, most = history_motion(found.frames, state), float(np.abs(drawn).max(initial=0.0))
    times = most / max(float(np.abs(true).max(initial=0.0)), 1e-300)
    how = "true displacements" if abs(times - 1.0) < 1e-6 else f"{times:.3g} times its displacements"
    return f"drawn: at {found.frames.times[state]:.4g} s, {how}"


def bounding_edges(scene: PictureScene, edges: IntArray) -> IntArray:
    """Of edges, (n, 2) vertices, all of blocks, and of cells of soil those that bound it or a part of it that moves."""
    blocks = scene.model.blocks
    owners = blocks.block_of_vertex[edges[:, 0]]
    soil, parts = scene.model.soil_of_block[owners], scene.clusters[owners] * bool(scene.motion.any())
    drawn, cells = soil < 0, np.flatnonzero(soil >= 0)
    if len(cells):
        within = np.column_stack([soil[cells], parts[cells]])
        drawn[cells] = outer_rows(blocks.vertices[edges[cells]], scene.size, within)
    return np.asarray(edges[drawn])


def scene_of(results: Results, case: CaseResult, options: PictureOptions, kind: str) -> PictureScene:
    """A case as a picture of that kind shows it: moved in a picture of the mechanism, at rest in others."""
    shown = [each for each in results.cases if options.case in (None, each.load_case.name, each.load_case.deck_name)]
    scene = PictureScene(results.assembly, case, results, np.zeros((len(results.model.blocks), 6)), tuple(shown))
    return scene.moved_to(options.scale) if kind == "mechanism" else scene


def part_colours(scene: PictureScene, palette: Sequence[str]) -> list[str]:
    """Colour of each block by the part of the listing that it moves with; stone at rest, grey if fixed."""
    parts, slow, fixed = scene.clusters.tolist(), scene.slow.tolist(), scene.model.fixed.tolist()
    still = [SLOW if moves else REST for moves in slow]
    moving = [palette[(part - 1) % len(palette)] if part else rest for part, rest in zip(parts, still, strict=True)]
    return [FIXED_BLOCK if held else colour for held, colour in zip(fixed, moving, strict=True)]


MOST_GROUPS = 12
"""groups that a legend names"""


def named_groups(of_group: Mapping[str, str]) -> tuple[list[tuple[str, str]], str]:
    """Groups with their colours that a legend names, and how many more there are in words."""
    left = len(of_group) - MOST_GROUPS
    return list(of_group.items())[:MOST_GROUPS], f"and {counted(left, 'more group')}" if left > 0 else ""
