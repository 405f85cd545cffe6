"""The geometric factor of safety: by how much every joint may shrink about its middle before the dead load falls."""

from __future__ import annotations

from dataclasses import dataclass, replace

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import Contacts

LEAST, MOST = 1.0 / 16.0, 1000.0
"""Factors between which it is looked for"""
TOLERANCE = 1e-6
"""of the factor, relative; it is proved to lie between two that are twice that apart"""


@dataclass(frozen=True)
class GeometricSafety:
    """The least size of joints, all shrunk about their middles, that carries the dead load, between two sizes.

    sizes        : (n_ends,) over that of the joints: at the first it stands, at the second it falls; there is no second
                   where joints of next to no size stand
    pressed      : (n_ends,) pressure on all joints in the problem that shows it, whose load factor takes it away again:
                   above it the dead load alone is carried, below it not; over the dead load per area of joints
    load_factors : (n_ends,) of that problem
    forces       : (n_ends, n_points, 3) N, T1, T2 [N] at the points of the shrunk joints
    mechanisms   : (n_ends, n_blocks, 6) for a live power of 1
    solves       : programs with a load factor that were solved
    verified     : whether code that did not solve them confirms that it stands at the first and falls at the second
    """

    sizes: FloatArray
    pressed: FloatArray
    load_factors: FloatArray
    forces: FloatArray
    mechanisms: FloatArray
    solves: int
    verified: bool

    @property
    def factor(self) -> float:
        """The geometric factor of safety that is shown: the joints may shrink by that; more than it is not."""
        return 1.0 / float(self.sizes[0])

    @property
    def most(self) -> float:
        """A factor that is not reached; inf where none is known."""
        return 1.0 / float(self.sizes[1]) if len(self.sizes) > 1 else float("inf")


def shrunk(assembly: Assembly, size: float) -> Assembly:
    """The assembly with joints of a size."""
    return replace(assembly, contacts=shrunk_contacts(assembly.contacts, size))


def shrunk_contacts(contacts: Contacts, size: float) -> Contacts:
    """The contacts with every point moved towards the centroid of its interface; areas stay."""
    middle = contacts.centroids[contacts.interface_of_point]
    return replace(contacts, points=middle + size * (contacts.points - middle))
