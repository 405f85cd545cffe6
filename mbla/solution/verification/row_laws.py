"""Joint laws of the contact points of a pushover, held against those of its deck.

Two bodies that touch as built have the laws of their interfaces there. Of two that meet only on the way, or elsewhere
where laws go by place, the deck says the law: that of the ground, of all contacts, or of any override.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray
from mbla.assembly.assembly import Assembly
from mbla.deck.sections.contacts import ContactsSection
from mbla.model.model import LoadCase
from mbla.solution.pushover.record import PushedRows


def row_of_another_law(assembly: Assembly, section: ContactsSection, case: LoadCase, rows: PushedRows) -> int | None:
    """The first row with a point whose joint law its deck does not give, or whose bodies are not there, or None."""
    built = assembly.glued(case)
    model, n_solids = built.model, len(built.model.blocks)
    names = list(model.joints)
    n_bodies = n_solids + len(model.grounds)
    on = rows.points.bodies[:, 0] >= 0
    bodies, laws = rows.points.bodies[on], rows.points.laws[on]
    wrong = (laws < 0) | (laws >= len(names)) | (bodies >= n_bodies).any(axis=1)
    own = built.contacts
    of_names = {name: law for law, name in enumerate(names)}
    known = np.array([of_names.get(name, -1) for name in own.joint_names], dtype=np.int64)
    at_built = _numbers(own.bodies, n_bodies, known[own.joints], len(names))
    pairs = np.unique(at_built // (len(names) + 1))
    here = _numbers(bodies, n_bodies, laws, len(names))
    touch = np.isin(here // (len(names) + 1), pairs)
    usual = np.full(n_bodies, of_names.get(section.joint, -1))
    usual[n_solids:] = [of_names.get(ground.joint, -1) for ground in model.grounds]
    meets = laws == usual[np.minimum(bodies.max(axis=1, initial=0), n_bodies - 1)]
    meets |= np.isin(laws, [of_names.get(each.joint, -1) for each in section.overrides])
    by_place = any(each.orientation is not None or each.box is not None for each in section.overrides)
    elsewhere = ~touch | by_place | (model.interfaces is not None)
    wrong |= ~(np.isin(here, at_built) | elsewhere & meets)
    if not wrong.any():
        return None
    return int(np.searchsorted(rows.point_start, np.flatnonzero(on)[wrong.argmax()], side="right")) - 1


def _numbers(bodies: IntArray, n_bodies: int, laws: IntArray, n_laws: int) -> IntArray:
    """One for each pair of bodies and law."""
    low, high = np.sort(bodies, axis=1).T
    return np.asarray((low * n_bodies + high) * (n_laws + 1) + laws + 1)
