"""Warnings of what no block comes of: a file that is cut off, or a block that lost its faces, shows so."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.suggestions import listed
from mbla.errors import Notice
from mbla.model.wording import counted, was


def empty_objects(names: Sequence[str]) -> tuple[Notice, ...]:
    """A warning of objects without faces, by their names; nothing where there are none."""
    if not names:
        return ()
    called = listed([name or "without a name" for name in names], "and")
    words = f"{counted(len(names), 'object')} {was(len(names))} left out, without faces: {called}"
    return (Notice("warning", "objects-empty", words),)


def unused_points(count: int, used: IntArray) -> tuple[Notice, ...]:
    """A warning of points of a file that nothing in it uses; nothing where there are none.

    count : number of points of the file
    used  : (n,) rows of points that faces, cells or elements name, in any order
    """
    unused = count - len(np.unique(used))
    if unused <= 0:
        return ()
    words = f"{unused} of the {counted(count, 'vertex')} of the file {'is' if unused == 1 else 'are'} used by no face"
    return (Notice("warning", "file-vertices-unused", f"{words}: is the file whole?"),)
