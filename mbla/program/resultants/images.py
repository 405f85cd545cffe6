"""Interfaces that are images of one another in a program of one half of a structure.

A point of the half stands for itself and for its image; so do the interfaces. Conditions on one of two images are
enough, as both carry the same share of the force. A motion w of one interface, dual to its resultants, is a motion w/2
of itself and the mirror image of w/2 of its image; an interface that the plane cuts has the mean of w and its image.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.program.reductions.restrict import block_matrix

UNTURNED = 1e-6
"""Distance of a map of forces from the identity that is rounding: an image of an interface turns them by far more."""


@dataclass(frozen=True)
class Images:
    """What belongs to which.

    first   : (n_interfaces,) false of the second of two images
    motions : (6 n_interfaces, 6 n_interfaces) from motions in the half to those of the model
    """

    first: BoolArray
    motions: sp.csr_array


def images_of(forces: sp.csr_array, interface_of_point: IntArray, n_interfaces: int) -> Images:
    """Of the interfaces of a model in a program of it, spatial.

    forces : (3 n_points of the model, 3 n_points) see ``Lift``
    """
    every = np.arange(n_interfaces)
    image, maps = every.copy(), np.tile(np.eye(3), (n_interfaces, 1, 1))
    point, other, turned = _pairs(forces)
    interface, place = np.unique(interface_of_point[point], return_index=True)
    image[interface] = interface_of_point[other[place]]
    maps[interface] = turned[place]
    return Images(every <= image, _means(image, maps))


def _pairs(forces: sp.csr_array) -> tuple[IntArray, IntArray, FloatArray]:
    """Points of the model, their images, (n,), and from forces at the image to those at the point, (n, 3, 3)."""
    normal = sp.csc_array(forces[::3][:, ::3])
    column = np.repeat(np.arange(normal.shape[1]), np.diff(normal.indptr))
    point = normal.indices.astype(np.int64)
    rows = np.broadcast_to(3 * point[:, None, None] + np.arange(3)[:, None], (len(point), 3, 3)).reshape(-1, 3)
    columns = np.broadcast_to(3 * column[:, None, None] + np.arange(3), (len(point), 3, 3)).reshape(-1, 3)
    blocks = sp.csr_array(forces[rows, columns]).toarray().reshape(-1, 3, 3) / normal.data[:, None, None]
    alone = np.diff(normal.indptr)[column] == 1
    other = np.arange(len(point))
    second = np.flatnonzero(np.diff(column, prepend=-1) == 0)
    other[second], other[second - 1] = second - 1, second
    turned = np.where(alone[:, None, None], 2.0 * blocks - np.eye(3), blocks @ blocks[other].transpose(0, 2, 1))
    return point, point[other], turned


def _means(image: IntArray, maps: FloatArray) -> sp.csr_array:
    """½ (w + T w'), T = (D, −D): moments are axial; w of interfaces that are nothing's image."""
    n = len(image)
    axial = np.zeros((n, 6, 6))
    axial[:, :3, :3], axial[:, 3:, 3:] = maps, -maps
    alone = (image == np.arange(n)) & (np.abs(maps - np.eye(3)).max(axis=(1, 2)) < UNTURNED)
    axial[alone] = np.eye(6)
    turned = block_matrix(axial, np.arange(n), image, (n, n))
    return sp.csr_array(0.5 * (sp.eye_array(6 * n) + turned))
