"""Which joint law each interface has: the section's, the ground's, or that of the last override that fits."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, IntArray
from mbla.deck.types import ContactOverride, ContactsSection
from mbla.errors import Notice
from mbla.model.model import Model

GROUND = "ground"
"""How overrides call ground planes."""


def joints_of_interfaces(
    model: Model, section: ContactsSection, bodies: IntArray
) -> tuple[IntArray, tuple[str, ...], list[Notice]]:
    """Joint law of each interface between bodies (n, 2).

    Returns
    -------
    joints  : (n,) row of names
    names   : laws in use, in the order of the deck
    notices : overrides that fit no interface
    """
    laws = list(model.joints)
    n_blocks = len(model.blocks)
    joints = np.full(len(bodies), laws.index(section.joint))
    for index, ground in enumerate(model.grounds):
        joints[bodies[:, 0] == n_blocks + index] = laws.index(ground.joint)
    notices = []
    for override in section.overrides:
        fits = _between(model, bodies, override)
        joints[fits] = laws.index(override.joint)
        if not fits.any():
            first, second = override.between
            notices.append(
                Notice(
                    "warning",
                    "override-without-contact",
                    f"no contact between {first} and {second}: the override with joint {override.joint} has no effect",
                )
            )
    used, rows = np.unique(joints, return_inverse=True)
    return rows.astype(np.int64), tuple(laws[law] for law in used), notices


def _between(model: Model, bodies: IntArray, override: ContactOverride) -> BoolArray:
    """Interfaces of one body of the first group with one of the second."""
    groups = np.array([*model.blocks.groups, *([GROUND] * len(model.grounds))], dtype=object)
    # A group that happens to be called "ground" is not meant: the word stands for ground planes.
    is_ground = np.arange(len(groups)) >= len(model.blocks)
    first, second = ((groups == name) & (is_ground == (name == GROUND)) for name in override.between)
    a, b = bodies[:, 0], bodies[:, 1]
    fits: BoolArray = (first[a] & second[b]) | (second[a] & first[b])
    return fits
