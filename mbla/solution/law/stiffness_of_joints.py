"""How stiff joints are, across and along: as the deck says, else so that its blocks hardly overlap under their weight.

Without a stiffness in the deck a block of mean weight W and size s overlaps its neighbour by ``SAG`` of its size over
the mean area A that two bodies share, k = W/(A SAG s). That is next to rigid: no load factor depends on it. Periods
do, in proportion to 1/√k: joints of stone and mortar have E/t of the deck's own ``stiffness``.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model

SAG = 1e-6
"""Overlap of two blocks under the weight of one, over the size of a block: 1e10 Pa/m for blocks of half a metre."""


def areas_of_pairs(solids: RigidBodies) -> tuple[IntArray, FloatArray]:
    """Numbers of the pairs of solids that touch, and the area m² that each shares, (n_pairs,) each."""
    apart = solids.contacts.bodies[:, 0] != solids.contacts.bodies[:, 1]  # kinematic blocks keep joints within them
    pairs, place = np.unique(pair_numbers(solids.contacts.bodies[apart], solids.model), return_inverse=True)
    areas = np.bincount(place.ravel(), solids.contacts.areas[apart], len(pairs))
    return pairs, np.asarray(areas, dtype=np.float64)


def pair_numbers(bodies: IntArray, model: Model) -> IntArray:
    """One number for each pair of bodies (n, 2), (n,)."""
    return np.asarray(bodies[:, 0] * (len(model.blocks) + len(model.grounds)) + bodies[:, 1])


def mean_weight(model: Model, case: LoadCase) -> float:
    """Mean dead load of a block that may move and has one; mean live load where none has."""
    loads = np.linalg.norm(case.dead_load[:, :3], axis=1)[~model.fixed]
    loads = loads if loads.any() else np.linalg.norm(case.live_load[:, :3], axis=1)[~model.fixed]
    return float(loads[loads > 0.0].mean())


def mean_size(solids: RigidBodies) -> float:
    """Of solids that may move, m."""
    return float(solids.model.blocks.sizes[~solids.model.fixed].mean())


def default_stiffness(model: Model, case: LoadCase, solids: RigidBodies) -> float:
    """Normal stiffness of joints for which the deck gives none, force per volume.

    model : as it may move under the load case; case : on its blocks; solids : that glue makes of them
    """
    return mean_weight(model, case) / (float(areas_of_pairs(solids)[1].mean()) * SAG * mean_size(solids))


def joint_stiffness(model: Model, contacts: Contacts, default: float) -> FloatArray:
    """Normal and shear stiffness of every interface, (n_interfaces, 2) force per volume; nan of ties.

    default : of joints for which the deck gives none
    """
    laws = [model.joints[name] for name in contacts.joint_names]
    normal = np.array([law.normal_stiffness for law in laws], dtype=np.float64)
    normal = np.where(np.isnan(normal), default, normal)
    both = np.column_stack([normal, normal * np.array([law.shear_ratio for law in laws], dtype=np.float64)])
    found = both[contacts.joints] if len(laws) else np.zeros((0, 2))
    found[contacts.n_surfaces :] = np.nan
    return found
