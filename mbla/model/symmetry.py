"""A model mirrored about a plane: the whole structure from the half that the deck gives.

With unit normal m and reflection R = I − 2 m mᵀ a block becomes its mirror image; a force F becomes R F, a moment M,
which is an axial vector, −R M, and so velocity and angular velocity. A block that the plane cuts in two becomes one
with its image: both without their faces on the plane.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.deck import Deck
from mbla.deck.sections.load_cases import LoadCaseSection
from mbla.deck.sections.supports import SymmetryPlane
from mbla.errors import DeckError, Finding, KeyPath, Notice
from mbla.model.applied_load import AppliedLoad
from mbla.model.fill import Fill
from mbla.model.guides import Guides
from mbla.model.join import halves_joined, polyhedra_of
from mbla.model.loads.gravity import with_gravity
from mbla.model.loads.load_kind import entries_of, load_kind
from mbla.model.model import Ground, LoadCase, Model, Pushing
from mbla.model.selectors import BlockSelection, check_overrides, select_blocks
from mbla.model.settlement import with_reference
from mbla.model.solids.blocks import BlockLabels, Blocks, carried_masses, join_labels
from mbla.model.solids.build import Labels, build_blocks, indices_in_groups
from mbla.model.solids.plane import plane_axes
from mbla.model.solids.polyhedra import join_polyhedra, take_polyhedra
from mbla.model.solids.ragged import row_maxima
from mbla.model.supports import plane_of
from mbla.model.ties.ties import OUTSIDE, Ties, joined_ties
from mbla.model.transform import AffineMap, moved, reflection
from mbla.model.wording import counted, named
from mbla.questions.reaction import Settlement

UNNAMED = "the plane of symmetry"
"""in words"""
ACROSS = 1e-9
"""component across the plane, relative to a vector, that is rounding"""


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
            for finding in _loads_across(deck, section, ("load_cases", name), mirror)
        ]
        _refuse(deck, findings)
        _refuse(deck, _cannot_mirror(deck, model, mirror, path))
        model = _mirrored(model, mirror, deck.contacts.tolerance)
    if deck.content.symmetry:
        selection = BlockSelection(model.blocks, fault_at=deck.fault_at)
        check_overrides(deck.contacts.overrides, selection)
        if selection.faults:
            raise DeckError(selection.faults)
    return model


def _refuse(deck: Deck, findings: Iterable[Finding]) -> None:
    """DeckError where there are findings."""
    if faults := [deck.fault_at(*finding) for finding in findings]:
        raise DeckError(faults)


def _loads_across(deck: Deck, section: LoadCaseSection, path: KeyPath, mirror: Mirror) -> Iterator[Finding]:
    """Loads on masses that are not their own mirror image, and kinds of loads that have no image."""
    dead = entries_of(section.dead or [], (*path, "dead"), deck.content.loads)
    live = entries_of(section.live or [], (*path, "live"), deck.content.loads)
    for entry in (*with_gravity(dead, path, deck.units), *live):
        kind = load_kind(entry) if entry.adds_up else None
        if entry.load.through is not None:
            message = "a load that spreads in fill may do so across a plane of symmetry: give the whole structure"
            yield Finding("symmetry-broken", message, *entry.path, "through")
        if kind is not None and kind.mirrored:
            continue
        message = f"is no load that can be mirrored about {mirror.label}: give the whole structure"
        if kind is not None and kind.vector is not None:
            value = np.array(kind.vector(entry.value))
            if abs(float(value @ mirror.normal)) <= ACROSS * np.abs(value).max():
                continue
            plane = mirror.label if mirror.label == UNNAMED else f"{UNNAMED} {mirror.label}"
            message = (
                f"acts across {plane}: the other half would have to be pushed the other way; give the whole structure"
            )
        yield Finding("symmetry-broken", message, *entry.path, entry.kind)


def _cannot_mirror(deck: Deck, model: Model, mirror: Mirror, path: KeyPath) -> Iterator[Finding]:
    """Supports and forces that have no image."""
    near = deck.contacts.tolerance * float(model.blocks.sizes.min())
    for ground in model.grounds:
        along = abs(float(ground.normal @ mirror.normal)) > 1.0 - ACROSS
        if along and abs(float((ground.point - mirror.point) @ mirror.normal)) <= near:
            yield Finding("symmetry-broken", f"{ground.label} lies in it: what is mirrored is not held there", *path)
    guided = model.guides.blocks[mirror.halves[model.guides.blocks]]
    if len(guided):
        them = named(guided, model.blocks.name)
        message = f"{them} cannot be guided and halved: by symmetry it moves in the plane only"
        yield Finding("symmetry-broken", message, *path, "halves")
    for number, section in enumerate(deck.content.ties):
        if section.ring is not None:
            words = "goes round the whole structure: give that, or the half of it with `through`, from ground to ground"
            yield Finding("symmetry-broken", f"{words} in the plane", "ties", number, "ring")
    for name in dict.fromkeys(case.deck_name for case in model.load_cases if not case.question.collapses):
        message = "a force through a cut of one half is no question of the other: give the whole structure"
        yield Finding("symmetry-broken", message, "load_cases", name, "objective")
    for case in model.load_cases:
        across = np.zeros_like(mirror.halves)
        for load in (case.dead_load, case.live_load):
            across |= np.abs(load[:, :3] @ mirror.normal) > ACROSS * np.abs(load[:, :3]).max(initial=0.0)
        if (cut := np.flatnonzero(across & mirror.halves)).size and case.question.multiplies:
            message = (
                f"a load acts across {mirror.label} on {named(cut, model.blocks.name)}, which is cut by it: the other "
                "half is loaded the other way, and nothing is left of it"
            )
            yield Finding("symmetry-broken", message, "load_cases", case.name)
        question, halved = case.question, mirror.halves[case.question.giving_way]
        if halved.any():
            moved = question.ways[halved]
            if question.kind == "moment" or np.any(np.abs(moved[:, :3] @ mirror.normal) > ACROSS):
                message = (
                    "a support that the plane of symmetry cuts can only give way along that plane, without turning"
                )
                yield Finding("symmetry-broken", message, "load_cases", case.name, "settlement")


def _mirrored(model: Model, mirror: Mirror, tolerance: float) -> Model:
    """The model with its image."""
    blocks, others = model.blocks, np.flatnonzero(~mirror.halves)
    own = polyhedra_of(blocks)
    image = moved(own, mirror.reflection)
    joined = halves_joined(own, image, mirror.halves, mirror.point, mirror.normal, tolerance * blocks.sizes)
    polyhedra = join_polyhedra([joined, take_polyhedra(image, others)])
    built = build_blocks(polyhedra, _labels(model, others), tolerance)
    assert not built.defects, "images of sound blocks are sound"
    centroids = built.blocks.centroids
    text = (
        f"mirrored about {mirror.label}: {counted(len(blocks), 'block')} given, {counted(len(others), 'image')} added"
        + (f", {counted(int(mirror.halves.sum()), 'block')} joined with its other half" if mirror.halves.any() else "")
    )
    added = blocks.added_masses, blocks.added_mass_points
    masses, points = _both_masses(built.blocks, *added, mirror)
    fill = model.fill
    if fill is not None:
        of_fill = _both_masses(built.blocks, fill.masses, fill.points, mirror)
        fill = Fill(*of_fill, tuple(f"{words}; with its mirror image twice as much" for words in fill.words))
    return replace(
        model,
        blocks=replace(built.blocks, added_masses=masses, added_mass_points=points),
        fill=fill,
        fixed=np.concatenate([model.fixed, model.fixed[others]]),
        grounds=_grounds(model.grounds, mirror),
        guides=_guides(model.guides, mirror),
        ties=_ties(model.ties, mirror),
        load_cases=tuple(_load_case(case, model, mirror, centroids) for case in model.load_cases),
        notices=(*model.notices, Notice("notice", "mirrored", text)),
        mirrors=(*model.mirrors, (*mirror.normal.tolist(), float(mirror.normal @ mirror.point))),
    )


def _both_masses(
    joined: Blocks, masses: FloatArray, points: FloatArray, mirror: Mirror
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
    return Labels(groups, indices_in_groups(groups), densities, join_labels([blocks.labels, images]))


def _grounds(grounds: Sequence[Ground], mirror: Mirror) -> tuple[Ground, ...]:
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


def _own_image(ground: Ground, mirror: Mirror) -> bool:
    """Whether a surface that ends lies across the mirror, alike on both sides."""
    assert ground.outline is not None  # who calls knows
    if abs(float(ground.normal @ mirror.normal)) > ACROSS:
        return False
    axes = plane_axes(ground.normal[None])[0]
    image = mirror.reflection.points(ground.outline)
    one, other = (shapely.Polygon((corners - ground.point) @ axes.T) for corners in (ground.outline, image))
    return bool(shapely.symmetric_difference(one, other).area <= ACROSS * one.area)


def _guides(guides: Guides, mirror: Mirror) -> Guides:
    if not len(guides):
        return guides
    return Guides(
        np.concatenate([guides.blocks, mirror.image_of[guides.blocks]]),
        np.concatenate([guides.bodies, guides.n_bodies + guides.bodies]),
        np.concatenate([guides.motions, mirror.motions(guides.motions)]),
        guides.words,
    )


def _ties(ties: Ties, mirror: Mirror) -> Ties:
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


def _load_case(case: LoadCase, model: Model, mirror: Mirror, centroids: FloatArray) -> LoadCase:
    """Loads on blocks and images; on a block that is joined with its other half, of both about the common centroid."""
    count, own = len(model.blocks), model.blocks.centroids

    def both(load: FloatArray) -> FloatArray:
        moved = load.copy()
        moved[:, 3:] += np.cross(own - centroids[:count], load[:, :3])
        total = np.zeros((len(centroids), 6))
        total[:count] = moved
        np.add.at(total, mirror.image_of, mirror.motions(moved))
        return total

    def both_levers(levers: FloatArray, load: FloatArray) -> FloatArray:
        matrix = mirror.reflection.matrix
        moved = levers.reshape(-1, 3, 3) + (own - centroids[:count])[:, :, None] * load[:, None, :3]
        total = np.zeros((len(centroids), 3, 3))
        total[:count] = moved
        np.add.at(total, mirror.image_of, matrix @ moved @ matrix.T)
        return total.reshape(-1, 9)

    def whole(load: AppliedLoad) -> AppliedLoad:
        own_part = np.zeros((count, 15))
        own_part[load.blocks] = load.wrenches
        acted_on = np.union1d(load.blocks, mirror.image_of[load.blocks])
        both_parts = np.hstack([both(own_part[:, :6]), both_levers(own_part[:, 6:], own_part)])
        return replace(load, blocks=acted_on, wrenches=both_parts[acted_on])

    dead, live = (tuple(map(whole, loads)) for loads in (case.dead, case.live))
    push = None if case.pushover is None else _pushing(case.pushover, case, mirror, both, both_levers)
    mirrored = replace(
        case, dead_load=both(case.dead_load), live_load=both(case.live_load), dead=dead, live=live, pushover=push
    )
    if case.settlement is None:
        return mirrored
    return with_reference(replace(mirrored, settlement=_settlement(case.settlement, mirror)), np.nan)


def _pushing(
    push: Pushing,
    case: LoadCase,
    mirror: Mirror,
    both: Callable[[FloatArray], FloatArray],
    both_levers: Callable[[FloatArray, FloatArray], FloatArray],
) -> Pushing:
    """What is pushed, and the loads as they turn, of both halves."""
    return replace(
        push,
        blocks=np.concatenate([push.blocks, mirror.image_of[push.blocks[~mirror.halves[push.blocks]]]]),
        dead_levers=both_levers(push.dead_levers, case.dead_load - push.dead_following),
        live_levers=both_levers(push.live_levers, case.live_load - push.live_following),
        dead_following=both(push.dead_following),
        live_following=both(push.live_following),
        live_following_levers=both_levers(push.live_following_levers, push.live_following),
    )


def _settlement(settlement: Settlement, mirror: Mirror) -> Settlement:
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


@dataclass(frozen=True)
class Mirror:
    """A plane and what it does to a model.

    point, normal : (3,)
    label    : ``x = 0``
    halves   : (n,) blocks that it cuts in two
    image_of : (n,) block that is the image of each, itself for halves
    """

    point: FloatArray
    normal: FloatArray
    label: str
    halves: BoolArray
    image_of: IntArray

    @cached_property
    def reflection(self) -> AffineMap:
        """R about the plane."""
        return reflection(self.point, self.normal)

    def motions(self, values: FloatArray) -> FloatArray:
        """Images of velocities and angular velocities, or of forces and moments, in the second axis of (n, 6, ...)."""
        matrix, none = self.reflection.matrix, np.zeros((3, 3))
        both = np.block([[matrix, none], [none, -matrix]])
        return np.asarray(np.einsum("ij,nj...->ni...", both, values))


def find_mirror(deck: Deck, model: Model, plane: SymmetryPlane, path: KeyPath) -> Mirror:
    """The plane as it stands to the blocks; raises DeckError where blocks reach across it."""
    blocks, (point, normal, label) = model.blocks, plane_of(plane)
    label = label or UNNAMED
    heights = (blocks.vertices - point) @ normal
    allowed = deck.contacts.tolerance * blocks.sizes
    above, below = (row_maxima(sign * heights, blocks.vertex_start) for sign in (1.0, -1.0))
    if np.sum(below > allowed) > np.sum(above > allowed):
        normal, heights, above, below = -normal, -heights, below, above
    across = np.flatnonzero(below > allowed)
    if len(across):
        message = (
            f"blocks reach across {label}: {named(across, blocks.name)}; give the blocks on one side, and of "
            "one that the plane cuts its half, named by halves"
        )
        _refuse(deck, [Finding("symmetry-broken", message, *path)])
    halves = np.zeros(len(blocks), dtype=bool)
    if plane.halves is not None:
        selection = BlockSelection(blocks, fault_at=deck.fault_at)
        chosen = select_blocks(plane.halves, (*path, "halves"), selection)
        if chosen is None:
            raise DeckError(selection.faults)
        on_plane = row_maxima(np.abs(heights[blocks.loops]), blocks.loop_start) <= allowed[blocks.block_of_face]
        cut = np.bincount(blocks.block_of_face[on_plane], minlength=len(blocks)) > 0
        loose = chosen[~cut[chosen]]
        if len(loose):
            message = f"without a face on {label}, where the other half would join: {named(loose, blocks.name)}"
            _refuse(deck, [Finding("symmetry-broken", message, *path, "halves")])
        halves[chosen] = True
    image_of = np.arange(len(blocks))
    image_of[~halves] = len(blocks) + np.arange(int((~halves).sum()))
    return Mirror(point, normal, label, halves, image_of)
