"""Columns of blocks: what each is, what acts on it, and how it moves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.deck.sections.selectors import POSITIONS
from mbla.results.record.quantity import Quantity, flag, real, text, whole
from mbla.results.record.scene import FIGURES, FIGURES_TOLD, Column, Scene, Values, as_text, column, figures, masked

BLOCKS = "table blocks frames"
"""files of what an animation has too"""
FIGURES_HERE = replace(FIGURES_TOLD, dims=("block",))


def names_of(texts: tuple[str, ...]) -> list[str]:
    """Names in the order of their numbers, as the result file has them."""
    return sorted(set(texts))


def numbers_of(texts: tuple[str, ...]) -> Values:
    """The number of each item's name."""
    row = {name: number for number, name in enumerate(names_of(texts))}
    return np.array([row[name] for name in texts], dtype=np.int64)


def _of_blocks(quantity: Quantity) -> Quantity:
    return replace(quantity, place="blocks")


def _all(scene: Scene) -> Values:
    return np.arange(len(scene.model.blocks))


def _settles(scene: Scene) -> Values | None:
    settlement = None if scene.case is None else scene.case.load_case.settlement
    return np.isin(_all(scene), [] if settlement is None else settlement.blocks)


def _load(name: str) -> Column:
    return column(f"cases/*/{name}", lambda scene: None if scene.case is None else getattr(scene.case.load_case, name))


def _position(name: str) -> Column:
    words = f"number of the {name} in its item, from 0; none: empty, in meshes -1"

    def values(scene: Scene) -> Values | None:
        numbers = masked(scene.model.blocks.labels.position(name))
        return None if np.ma.getmaskarray(numbers).all() else numbers

    return column(_of_blocks(whole(name, words, "block")), values, BLOCKS)


def _largest(name: str, words: str) -> Column:
    """Largest value over the interfaces of each block; nan where none has one."""

    def values(scene: Scene) -> Values | None:
        thrust = scene.thrust
        if thrust is None or scene.torsion_use is None:
            return None
        found = scene.torsion_use if name == "torsion_use" else getattr(thrust, name)
        largest = np.full(len(scene.model.blocks) + len(scene.model.grounds), -np.inf)
        known = ~np.isnan(found)
        for side in (0, 1):
            np.maximum.at(largest, scene.contacts.bodies[known, side], found[known])
        return np.where(np.isneginf(largest), np.nan, largest)[: len(scene.model.blocks)]

    quantity = real(f"largest_{name}", f"largest {words} of the interfaces of the block", "1", "block")
    return column(_of_blocks(quantity), values, "blocks")


def _members(scene: Scene) -> Values | None:
    members = scene.model.blocks.labels.members
    return numbers_of(members) if any(members) else None


BLOCK_COLUMNS: tuple[Column, ...] = (
    column(_of_blocks(whole("block", "number of the block, from 0", "block")), _all, BLOCKS),
    column(
        _of_blocks(text("block_name", "group and index, as selectors write it", "block")),
        lambda scene: as_text([scene.model.blocks.name(block) for block in range(len(scene.model.blocks))]),
    ),
    column(
        "model/groups",
        lambda scene: numbers_of(scene.model.blocks.groups),
        BLOCKS,
        lambda scene: names_of(scene.model.blocks.groups),
    ),
    column("model/group_indices", lambda scene: scene.model.blocks.group_indices),
    column("model/members", _members, BLOCKS, lambda scene: names_of(scene.model.blocks.labels.members)),
    *(_position(name) for name in POSITIONS),
    column("model/centroids", lambda scene: scene.model.blocks.centroids),
    column("model/volumes", lambda scene: scene.model.blocks.volumes),
    column("model/densities", lambda scene: scene.model.blocks.densities),
    column("model/added_masses", lambda scene: scene.model.blocks.added_masses),
    column("model/weights", lambda scene: scene.model.weights, "table blocks"),
    column("model/fixed", lambda scene: scene.model.fixed, BLOCKS),
    column(
        _of_blocks(flag("guided", "1 where it moves in given ways only, as in a support that gives way", "block")),
        lambda scene: np.isin(_all(scene), scene.model.guides.blocks),
        "table blocks",
    ),
    column(_of_blocks(flag("settles", "1 where it belongs to the support that gives way", "block")), _settles),
    column("contacts/solid_of_block", lambda scene: scene.contacts.solid_of_block),
    _load("dead_load"),
    _load("live_load"),
    column(_of_blocks(FIGURES_HERE), figures(lambda scene: len(scene.model.blocks)), "table", lambda _: FIGURES),
    column("cases/*/mechanism", lambda scene: None if scene.mechanics is None else scene.mechanics.mechanism),
    column("cases/*/parts", lambda scene: scene.parts if scene.case is None or scene.moves else None, BLOCKS),
    column("cases/*/certificate", lambda scene: scene.certificate),
    column(
        _of_blocks(real("drawn_displacements", "displacement of the centroid as drawn", "length", "block axis")),
        lambda scene: scene.motion[:, :3],
        "blocks",
    ),
    column(
        _of_blocks(real("drawn_rotations", "rotation vector as drawn", "radian", "block axis")),
        lambda scene: scene.motion[:, 3:],
        "blocks",
    ),
    _largest("eccentricity", "eccentricity of the resultants"),
    _largest("friction_use", "use of friction and cohesion by shear"),
    _largest("torsion_use", "use of friction and cohesion by shear and torsion"),
)
