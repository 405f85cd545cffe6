"""What a kind of load is to the model: how it becomes forces on blocks, and how a plane of symmetry mirrors it.

Each file of this folder that is named after a kind registers it at its foot, with what the deck knows of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from mbla.arrays import FloatArray, IntArray
from mbla.deck.load_key import LOAD_KEYS, LoadKey
from mbla.deck.quantities import Vector
from mbla.model.applied_load import AppliedLoad
from mbla.model.loads.entry import Entry
from mbla.model.loads.load_site import LoadSite
from mbla.questions.tilt import Tilt
from mbla.questions.travel import TravelPosition

Build: TypeAlias = Callable[[Entry, IntArray | None, LoadSite], AppliedLoad | None]
"""The load on blocks, from its entry, the blocks that its ``on`` selects, None where it has none, and the site. None
where a fault was left."""


@dataclass(frozen=True, kw_only=True)
class LoadKind(LoadKey):
    """A kind of load that adds up with others.

    build      : see ``Build``
    vector     : of its value, where that is one: what ``interact`` turns
    mirrored   : it has an image, so that planes of symmetry need not lie along it; else only a vector along them is
                 its own image
    may_cancel : its parts may leave nothing of each other, which its sum with others is judged by
    """

    build: Build
    vector: Callable[[Any], Vector] | None = None
    mirrored: bool = False
    may_cancel: bool = False


@dataclass(frozen=True)
class Variant:
    """A load case that a load makes of one: what acts besides its other loads, and its position or how it turns."""

    load: AppliedLoad | None = None
    travel: TravelPosition | None = None
    tilt: Tilt | None = None


Variants: TypeAlias = Callable[[str, Entry, Sequence[Entry], FloatArray, LoadSite], list[Variant]]
"""The load cases, from the name of the deck's one, the entry, the entries of its dead loads, the sum of these,
(n_blocks, 6), and the site; none where a fault was left."""


@dataclass(frozen=True, kw_only=True)
class CaseKind(LoadKey):
    """A live load that makes another load case, or several, of one; see ``Variants``."""

    variants: Variants
    live_only: bool = True


def load_kind(entry: Entry) -> LoadKind:
    """The kind of a load that adds up."""
    kind = LOAD_KEYS[entry.kind]
    assert isinstance(kind, LoadKind)  # who asks has left out those that do not
    return kind
