"""What interfaces of a state do, from its forces and motions: resultants and modes of their points."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.program.assemble import yield_limits
from mbla.program.resultants.resultants_map import resultants_map
from mbla.solution.full_model.contact_modes import AT_REST, contact_modes
from mbla.solution.solution import ContactMode, Mechanics
from mbla.solution.verification.interface_laws import (
    InterfaceLaws,
    crushing_excess,
    interface_laws,
    shear_strength,
    torsion_excess,
)


def of_interfaces(
    model: Model, contacts: Contacts, contact_model: str, mechanics: Mechanics, flow_rule: str
) -> Mechanics:
    """With resultants of the interfaces and modes of their points; motions of nothing where none are given."""
    none = np.zeros((len(contacts), 2, 6))
    motions = none if mechanics.interface_motions is None else mechanics.interface_motions
    map_, laws = resultants_map(contacts), interface_laws(model, contacts, contact_model)
    resultants = np.asarray((map_ @ mechanics.contact_forces.ravel()).reshape(-1, 6))
    by_torsion, by_crushing = ((map_.T @ motions[:, kind].ravel()).reshape(-1, 3) for kind in (0, 1))
    limits = yield_limits(model, contacts).without_crushing(~contacts.tie_points)
    own = mechanics.contact_velocities - by_torsion - by_crushing
    speed = float(np.linalg.norm(mechanics.contact_velocities, axis=1).max(initial=0.0))
    modes = contact_modes(mechanics.contact_forces, own, limits, limits.dilatancy_by(flow_rule), speed)
    owner = contacts.interface_of_point
    reserve = np.maximum(_reserve_of_torsion(laws, resultants), AT_REST)[owner]
    slips = np.hypot(by_torsion[:, 1], by_torsion[:, 2]) > reserve * speed
    modes = np.where(slips & (modes == ContactMode.STICK), ContactMode.SLIDE, modes)
    crushes = _crushes(laws, resultants, by_crushing, owner, speed)[owner]
    modes = np.where(crushes & (by_crushing[:, 0] > 0.0), ContactMode.OPEN, modes)
    modes = np.where(crushes & (by_crushing[:, 0] < 0.0), ContactMode.CRUSH, modes)
    return replace(mechanics, resultants=resultants, interface_motions=motions, modes=modes)


def _reserve_of_torsion(laws: InterfaceLaws, resultants: FloatArray) -> FloatArray:
    """As for points, an interface slips where its speed, as a share of the largest, exceeds this, (n_interfaces,)."""
    largest = float(shear_strength(laws, resultants)[0][laws.torsional].max(initial=0.0))
    left = np.maximum(-torsion_excess(laws, resultants), 0.0) / max(largest, 1e-300)
    return np.where(laws.torsional, left, np.inf)


def _crushes(
    laws: InterfaceLaws, resultants: FloatArray, by_crushing: FloatArray, owner: IntArray, speed: float
) -> BoolArray:
    """Interfaces that crush, (n_interfaces,): their speed by crushing, as a share of the largest, exceeds what is left.

    What an interface has left counts as a share of the largest normal force.
    """
    left = -crushing_excess(laws, resultants) / np.abs(resultants[:, 0]).max(initial=1e-300)
    own = np.zeros(len(left))
    np.maximum.at(own, owner, np.abs(by_crushing).max(axis=1))
    return np.asarray(laws.crushable & (own > np.maximum(left, AT_REST) * speed))
