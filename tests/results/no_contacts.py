"""Contacts of blocks that do not touch."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.contacts.contacts import Contacts


def without_contacts(contacts: Contacts) -> Contacts:
    """The same with no interface and no point left."""
    return replace(
        contacts,
        bodies=np.zeros((0, 2), dtype=np.int64),
        normals=np.zeros((0, 3)),
        areas=np.zeros(0),
        centroids=np.zeros((0, 3)),
        gaps=np.zeros(0),
        joints=np.zeros(0, dtype=np.int64),
        joint_names=(),
        point_start=np.zeros(1, dtype=np.int64),
        outline=np.zeros(0, dtype=np.int64),
        points=np.zeros((0, 3)),
        frames=np.zeros((0, 3, 3)),
        point_areas=np.zeros(0),
    )
