"""A model mirrored about a plane: the whole structure from the half that the deck gives.

With unit normal m and reflection R = I − 2 m mᵀ a block becomes its mirror image; a force F becomes R F, a moment M,
which is an axial vector, −R M, and so velocity and angular velocity. A block that the plane cuts in two becomes one
with its image: both without their faces on the plane.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray
from mbla.deck.deck import Deck
from mbla.errors import DeckError, KeyPath, Notice
from mbla.model.applied_load import AppliedLoad, joined_patches
from mbla.model.fill.fill import CarriedFill
from mbla.model.join import polyhedra_of
from mbla.model.model import Ground, LoadCase, Model, Pushing
from mbla.model.motion.time_history import TimeHistory
from mbla.model.selectors import BlockSelection, check_overrides
from mbla.model.settlement import with_reference
from mbla.model.solids.blocks import BlockLabels, Blocks, carried_masses, join_labels
from mbla.model.solids.build import Labels, build_blocks
from mbla.model.solids.plane import plane_axes
from mbla.model.solids.polyhedra import join_polyhedra, take_polyhedra
from mbla.model.supports.guides import Guides
from mbla.model.symmetry.halves import halves_joined
from mbla.model.symmetry.mirror import ACROSS, ModelMirror, find_mirror, refuse
from mbla.model.symmetry.refusals import cannot_mirror, loads_across
from mbla.model.ties.ties import OUTSIDE, Ties, joined_ties
from mbla.model.transform import moved
from mbla.model.wording import counted
from mbla.questions.reaction import Reaction, Settlement


def with_images(deck: Deck, model: Model) -> Model:
    """The model mirrored about every plane of the deck in turn.

    Raises DeckError for what keeps a plane from mirroring the model.
    """
    for number, plane in enumerate(deck.content.symmetry):
        path: KeyPath = ("symmetry", number)
        mirror = find_mirror(deck, model, plane, path)
        findings = [
            finding
            for name, section in deck.content.load_cases.items()
            for finding in loads_across(deck, section, ("load_cases", name), mirror)
        ]
        refuse(deck, findings)
        refuse(deck, cannot_mirror(deck, model, mirror, path))
        model = _mirrored(model, mirror, deck.contacts.tolerance)
    if deck.content.symmetry:
        selection = BlockSelection(model.blocks, fault_at=deck.fault_at)
        check_overrides(deck.contacts.overrides, selection)
        if selection.faults:
            raise DeckError(selection.faults)
    return model


def _mirrored(model: Model, mirror: ModelMirror, tolerance: float) -> Model:
    """The model with its image."""
    blocks, others = model.blocks, np.flatnonzero(~mirror.halves)
    own = polyhedra_of(blocks)
    image = moved(own, mirror.reflection)
    joined = halves_joined(own, image, mirror.halves, mirror.point, mirror.normal, tolerance * blocks.sizes)
    polyhedra = join_polyhedra([joined, take_polyhedra(image, others)])
    built = build_blocks(polyhedra, _labels(model, others), tolerance)
    assert not built.defects, "images of sound blocks are sound"
    both = _OnBoth(mirror, blocks.centroids - built.blocks.centroids[: len(blocks)], len(built.blocks))
    text = (
        f"mirrored about {mirror.label}: {counted(len(blocks), 'block')} given, {counted(len(others), 'image')} added"
        + (f", {counted(int(mirror.halves.sum()), 'block')} joined with its other half" if mirror.halves.any() else "")
    )
    added = blocks.added_masses, blocks.added_mass_points
    masses, points = _both_masses(built.blocks, *added, mirror)
    fill = model.fill
    if fill is not None:
        of_fill = _both_masses(built.blocks, fill.masses, fill.points, mirror)
        fill = CarriedFill(*of_fill, tuple(f"{words}; with its mirror image twice as much" for words in fill.words))
    return replace(
        model,
        blocks=replace(built.blocks, added_masses=masses, added_mass_points=points),
        fill=fill,
        fixed=np.concatenate([model.fixed, model.fixed[others]]),
        grounds=_grounds(model.grounds, mirror),
        guides=_guides(model.guides, mirror),
        ties=_ties(model.ties, mirror),
        load_cases=tuple(_load_case(case, both) for case in model.load_cases),
        notices=(*model.notices, Notice("notice", "mirrored", text)),
        mirrors=(*model.mirrors, (*mirror.normal.tolist(), float(mirror.normal @ mirror.point))),
    )


def _both_masses(
    joined: Blocks, masses: FloatArray, points: FloatArray, mirror: ModelMirror
) -> tuple[FloatArray, FloatArray]:
    """Masses (n,) at points (n, 3) on blocks and on their images; those of both halves on a block joined of two."""
    rows = np.concatenate([np.arange(len(masses)), mirror.image_of])
    both = np.concatenate([points, mirror.reflection.points(points)])
    return carried_masses(joined.centroids, rows, np.tile(masses, 2), both)


def _labels(model: Model, others: IntArray) -> Labels:
    """Names of blocks and images: images go on counting in the groups of their originals."""
    blocks = model.blocks
    groups = (*blocks.groups, *(blocks.groups[b] for b in others.tolist()))
    images = BlockLabels(tuple(blocks.labels.members[b] for b in others.tolist()), blocks.labels.positions[others])
    densities = np.concatenate([blocks.densities, blocks.densities[others]])
    strengths = None if blocks.strengths is None else np.concatenate([blocks.strengths, blocks.strengths[others]])
    return Labels(groups, densities, join_labels([blocks.labels, images]), strengths)


def _grounds(grounds: Sequence[Ground], mirror: ModelMirror) -> tuple[Ground, ...]:
    """Planes across the mirror carry images too; others, and surfaces that end, have an image of their own."""
    result, images = [], []
    for ground in grounds:
        carried = None if ground.blocks is None else mirror.image_of[ground.blocks]
        across = abs(float(ground.normal @ mirror.normal)) <= ACROSS and ground.outline is None
        if across or (ground.outline is not None and _own_image(ground, mirror)):
            both = None if ground.blocks is None else np.union1d(ground.blocks, carried)  # type: ignore[arg-type]
            result.append(replace(ground, blocks=both))
            continue
        result.append(ground)
        point, normal = mirror.reflection.points(ground.point), mirror.reflection.directions(ground.normal)
        outline = None if ground.outline is None else mirror.reflection.points(ground.outline)[::-1].copy()
        images.append(Ground(point, normal, ground.joint, carried, f"image of {ground.label}", outline))
    return (*result, *images)


def _own_image(ground: Ground, mirror: ModelMirror) -> bool:
    """Whether a surface that ends lies across the mirror, alike on both sides."""
    assert ground.outline is not None  # who calls knows
    if abs(float(ground.normal @ mirror.normal)) > ACROSS:
        return False
    axes = plane_axes(ground.normal[None])[0]
    image = mirror.reflection.points(ground.outline)
    one, other = (shapely.Polygon((corners - ground.point) @ axes.T) for corners in (ground.outline, image))
    return bool(shapely.symmetric_difference(one, other).area <= ACROSS * one.area)


def _guides(guides: Guides, mirror: ModelMirror) -> Guides:
    if not len(guides):
        return guides
    return Guides(
        np.concatenate([guides.blocks, mirror.image_of[guides.blocks]]),
        np.concatenate([guides.bodies, guides.n_bodies + guides.bodies]),
        np.concatenate([guides.motions, mirror.motions(guides.motions)]),
        guides.words,
    )


def _ties(ties: Ties, mirror: ModelMirror) -> Ties:
    """Ties and their images, but of those that lie in the plane; one that crosses it is given as its half to ground."""
    if not len(ties):
        return ties
    heights = np.abs((ties.places - mirror.point) @ mirror.normal)
    size = float(np.ptp(ties.places, axis=0).max()) or 1.0
    outside = np.bincount(ties.tie_of_point, heights > ACROSS * size, len(ties)) > 0
    images = ties.take(np.flatnonzero(outside))
    reflection = mirror.reflection
    bodies = np.append(mirror.image_of, OUTSIDE)[images.bodies]
    names = tuple(f"image of {name}" for name in images.names)
    places, pulls = reflection.points(images.places), images.pulls @ reflection.matrix.T
    return joined_ties([ties, replace(images, names=names, bodies=bodies, places=places, pulls=pulls)])


@dataclass(frozen=True)
class _OnBoth:
    """Loads on n blocks as loads on them and their images; where two are joined, about the common centroid.

    shift : (n, 3) from the centroids of the mirrored structure to those of the blocks given
    count : blocks of the mirrored structure
    """

    mirror: ModelMirror
    shift: FloatArray
    count: int

    def loads(self, loads: FloatArray) -> FloatArray:
        """Forces and moments, (count, 6) from (n, 6)."""
        moved = loads.copy()
        moved[:, 3:] += np.cross(self.shift, loads[:, :3])
        return self._with_images(moved, self.mirror.motions(moved))

    def levers(self, levers: FloatArray, loads: FloatArray) -> FloatArray:
        """Levers of loads, (count, 9) from (n, 9)."""
        matrix = self.mirror.reflection.matrix
        moved = levers.reshape(-1, 3, 3) + self.shift[:, :, None] * loads[:, None, :3]
        return self._with_images(moved.reshape(-1, 9), (matrix @ moved @ matrix.T).reshape(-1, 9))

    def _with_images(self, own: FloatArray, images: FloatArray) -> FloatArray:
        total = np.zeros((self.count, own.shape[1]))
        total[: len(own)] = own
        np.add.at(total, self.mirror.image_of, images)
        return total

    def applied(self, load: AppliedLoad) -> AppliedLoad:
        """A single load."""
        own = np.zeros((len(self.shift), 15))
        own[load.blocks] = load.wrenches
        acted_on = np.union1d(load.blocks, self.mirror.image_of[load.blocks])
        both = np.hstack([self.loads(own[:, :6]), self.levers(own[:, 6:], own)])
        stands, reflection = load.patches, self.mirror.reflection
        images = replace(
            stands,
            corners=reflection.points(stands.corners),
            forces=stands.forces @ reflection.matrix.T,
            blocks=self.mirror.image_of[stands.blocks],
        )
        patches = joined_patches([stands, images])
        return replace(load, blocks=acted_on, wrenches=both[acted_on], patches=patches)

    def pushing(self, push: Pushing, case: LoadCase) -> Pushing:
        """What is pushed, and the loads as they turn."""
        apart = push.blocks[~self.mirror.halves[push.blocks]]
        return replace(
            push,
            blocks=np.concatenate([push.blocks, self.mirror.image_of[apart]]),
            dead_levers=self.levers(push.dead_levers, case.dead_load - push.dead_following),
            live_levers=self.levers(push.live_levers, case.live_load - push.live_following),
            dead_following=self.loads(push.dead_following),
            live_following=self.loads(push.live_following),
            live_following_levers=self.levers(push.live_following_levers, push.live_following),
        )

    def in_time(self, history: TimeHistory, case: LoadCase) -> TimeHistory:
        """Forces over time, dead loads as they turn, and kinematic blocks with their images.

        Motion of the base is along the plane. What is recorded stays on the side that the deck gives.
        """
        n_given, n_both = len(self.shift), self.count

        def wrenches(given: FloatArray) -> FloatArray:
            return np.hstack([self.loads(given[:, :6]), self.levers(given[:, 6:], given)])

        def numbered(bodies: IntArray) -> IntArray:
            return np.asarray(np.where(bodies < n_given, bodies, bodies - n_given + n_both))

        return replace(
            history,
            forces=tuple(replace(force, wrenches=wrenches(force.wrenches)) for force in history.forces),
            interfaces=tuple(replace(each, bodies=numbered(each.bodies)) for each in history.interfaces),
            rigid=tuple(each for blocks in history.rigid for each in self._as_one(blocks)),
            dead_levers=self.levers(history.dead_levers, case.dead_load - history.dead_following),
            dead_following=self.loads(history.dead_following),
        )

    def _as_one(self, blocks: IntArray) -> list[IntArray]:
        """A kinematic block and its image; one where the plane cuts a block of it."""
        images = self.mirror.image_of[blocks]
        return [np.union1d(blocks, images)] if self.mirror.halves[blocks].any() else [blocks, np.sort(images)]


def _load_case(case: LoadCase, both: _OnBoth) -> LoadCase:
    """The load case on blocks and images."""
    mirrored = replace(
        case,
        dead_load=both.loads(case.dead_load),
        live_load=both.loads(case.live_load),
        dead=tuple(map(both.applied, case.dead)),
        live=tuple(map(both.applied, case.live)),
        pushover=None if case.pushover is None else both.pushing(case.pushover, case),
        time_history=None if case.time_history is None else both.in_time(case.time_history, case),
    )
    if isinstance(case.question, Reaction):
        settling = Reaction(_settlement(case.question.settlement, both.mirror))
        return with_reference(replace(mirrored, question=settling), np.nan)
    return mirrored


def _settlement(settlement: Settlement, mirror: ModelMirror) -> Settlement:
    """The support with its image, which moves as far."""
    apart = ~mirror.halves[settlement.blocks]
    images = mirror.motions(settlement.motions)[apart]
    return replace(
        settlement,
        blocks=np.concatenate([settlement.blocks, mirror.image_of[settlement.blocks[apart]]]),
        motions=np.concatenate([settlement.motions, images]),
        unit=2.0 * settlement.unit,
        words=f"{settlement.words}, with its mirror image",
    )
