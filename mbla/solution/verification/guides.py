"""What guides allow, for the verification: written a second time on purpose, without the program stage.

With the ways of a guided body as the columns of V (its blocks below one another, rotations times the lever arm of their
block), forces f with moments over the arms do work in Pf alone, P = V (VᵀV)⁻¹ Vᵀ, and a motion u is allowed where
Pu = u.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import Model


def left_to_balance(model: Model, wrenches: FloatArray, arms: FloatArray) -> FloatArray:
    """The part of forces and moments about centroids, (n_blocks, 6) N, N m, that no guide takes.

    arms : (n_blocks,) lever arms that make moments comparable to forces
    """
    if not len(model.guides):
        return wrenches
    sizes = _sizes(arms)
    return _projected(model, wrenches / sizes, sizes) * sizes


def allowed_motion(model: Model, mechanism: FloatArray, arms: FloatArray) -> FloatArray:
    """The nearest motion, (n_blocks, 6), that all guides allow; blocks without a guide keep theirs."""
    if not len(model.guides):
        return mechanism
    sizes = _sizes(arms)
    return _projected(model, mechanism * sizes, sizes) / sizes


def off_guides(model: Model, mechanism: FloatArray, arms: FloatArray) -> float:
    """Largest velocity of a guided block against its guide, over the largest of any block; 0 where none moves."""
    across = np.abs((mechanism - allowed_motion(model, mechanism, arms)) * _sizes(arms)).max(initial=0.0)
    largest = np.abs(mechanism * _sizes(arms)).max(initial=0.0)
    return float(across / largest) if largest > 0 else 0.0


def _sizes(arms: FloatArray) -> FloatArray:
    """(n_blocks, 6): 1 for translations, the lever arm for rotations."""
    return np.column_stack([np.ones((len(arms), 3)), np.repeat(arms[:, None], 3, axis=1)])


def _projected(model: Model, values: FloatArray, sizes: FloatArray) -> FloatArray:
    """Values, (n_blocks, 6) in comparable components, on the ways of their bodies."""
    blocks, bodies, n = model.guides.blocks, model.guides.bodies, model.guides.n_bodies
    ways = model.guides.motions * sizes[blocks][:, :, None]
    length = np.zeros((n, ways.shape[2]))
    np.add.at(length, bodies, (ways**2).sum(axis=1))
    ways = ways / np.sqrt(np.where(length > 0, length, 1.0))[bodies][:, None, :]
    gram, along = np.zeros((n, ways.shape[2], ways.shape[2])), np.zeros((n, ways.shape[2]))
    np.add.at(gram, bodies, np.einsum("mij,mik->mjk", ways, ways))
    np.add.at(along, bodies, np.einsum("mij,mi->mj", ways, values[blocks]))
    shares = np.einsum("bij,bj->bi", np.linalg.pinv(gram, hermitian=True), along)
    result = values.copy()
    result[blocks] = np.einsum("mij,mj->mi", ways, shares[bodies])
    return result
