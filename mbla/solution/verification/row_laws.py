"""Joint laws of contact points of a structure that moves, held against those of its deck.

Two bodies that touch as built have the laws of their interfaces there. Of two that meet only on the way, or elsewhere
where laws go by place, the deck says the law: that of the ground, of all contacts, of soil, or of any override.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.deck.sections.contacts import ContactsSection
from mbla.model.model import LoadCase, Model
from mbla.solution.pushover.record import PushedRows
from mbla.solution.time_history.frames import Frames
from mbla.solution.verification.in_time.bodies import solids_of


def row_of_another_law(assembly: Assembly, section: ContactsSection, case: LoadCase, rows: PushedRows) -> int | None:
    """The first row with a point whose joint law its deck does not give, or whose bodies are not there, or None."""
    on = rows.points.bodies[:, 0] >= 0
    label = assembly.glued(case).label
    wrong = of_another_law(assembly, section, label, rows.points.bodies[on], rows.points.laws[on])
    if not wrong.any():
        return None
    return int(np.searchsorted(rows.point_start, np.flatnonzero(on)[wrong.argmax()], side="right")) - 1


def search_of_another_law(assembly: Assembly, section: ContactsSection, case: LoadCase, frames: Frames) -> int | None:
    """The same of a time history: the first search for contacts with such a point, or None."""
    label = solids_of(assembly, case).label
    for number, points in enumerate(frames.sets):
        on = points.bodies[:, 0] >= 0
        if of_another_law(assembly, section, label, points.bodies[on], points.laws[on]).any():
            return number
    return None


def of_another_law(
    assembly: Assembly, section: ContactsSection, label: IntArray, bodies: IntArray, laws: IntArray
) -> BoolArray:
    """Which points have a law that their deck does not give, or bodies that are not there, (n,).

    label  : (n_blocks,) body of each block
    bodies : (n, 2) bodies, then grounds; laws : (n,) rows of the laws of the model
    """
    model, own = assembly.model, assembly.contacts
    names, n_solids = list(model.joints), int(label.max(initial=-1)) + 1
    n_bodies = n_solids + len(model.grounds)
    wrong = (laws < 0) | (laws >= len(names)) | (bodies >= n_bodies).any(axis=1)
    of_names = {name: law for law, name in enumerate(names)}
    known = np.array([of_names.get(name, -1) for name in own.joint_names], dtype=np.int64)
    as_built = np.append(label, n_solids + np.arange(len(model.grounds)))[own.bodies]
    at_built = _numbers(as_built, n_bodies, known[own.joints], len(names))
    pairs = np.unique(at_built // (len(names) + 1))
    here = _numbers(bodies, n_bodies, laws, len(names))
    touch = np.isin(here // (len(names) + 1), pairs)
    usual = np.full(n_bodies, of_names.get(section.joint, -1))
    usual[n_solids:] = [of_names.get(ground.joint, -1) for ground in model.grounds]
    within = np.minimum(bodies, n_bodies - 1)
    meets = laws == usual[within.max(axis=1, initial=0)]
    soil = np.full(n_bodies, -1)
    soil[label] = model.soil_of_block
    meets = np.where((soil[within] >= 0).any(axis=1), _of_soil(model, of_names, soil, within, laws), meets)
    meets |= np.isin(laws, [of_names.get(each.joint, -1) for each in section.overrides])
    by_place = any(each.orientation is not None or each.box is not None for each in section.overrides)
    elsewhere = ~touch | by_place | (model.interfaces is not None)
    return np.asarray(wrong | ~(np.isin(here, at_built) | elsewhere & meets))


def _of_soil(model: Model, of_names: dict[str, int], soil: IntArray, bodies: IntArray, laws: IntArray) -> BoolArray:
    """Which points have the law of soil that touches there: its own with soil and ground, that of a wall with blocks.

    soil : (n_bodies,) which soil each body is, negative of others
    """
    found, grounds = np.zeros(len(laws), dtype=bool), len(soil) - len(model.grounds)
    for side in (0, 1):
        own, other = bodies[:, side], bodies[:, 1 - side]
        for number, each in enumerate(model.soils):
            free = (soil[other] >= 0) | (other >= grounds)
            wanted = np.where(free, of_names.get(each.joint, -1), of_names.get(each.wall_joint, -1))
            found |= (soil[own] == number) & (laws == wanted)
    return found


def _numbers(bodies: IntArray, n_bodies: int, laws: IntArray, n_laws: int) -> IntArray:
    """One for each pair of bodies and law."""
    low, high = np.sort(bodies, axis=1).T
    return np.asarray((low * n_bodies + high) * (n_laws + 1) + laws + 1)
