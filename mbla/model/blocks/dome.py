"""Item `dome`: spherical, of rings of blocks, on a drum or not.

With R1 and R2 the radii of intrados and extrados, and angles t from the crown, the profile of a ring from t1 up to t2
is the quadrilateral of the four points R (sin t, cos t); A rho of it is (R2^3 - R1^3) sin(t1 - t2) (sin t1 + sin t2)/6.
With more and more segments and rings the volume goes to that of the spherical shell, 2 pi/3 (R2^3 - R1^3) (cos t2 - cos
t1).

The keystone is the frustum of a pyramid, between the polygons at the last joint in intrados and extrados.

Rings have planar faces. A circle is a regular polygon of n sides with its corners on the circle, the same for all
rings, and each block spans an integer number of them, its facets: half a block more or less are still full facets, so
that the rings of a running bond meet facet on facet. Between two neighbouring meridians every joint is a plane, a
trapezoid with two parallel sides; a bed joint that rises towards the outside is a funnel of such trapezoids, into which
the blocks above fit and round which those below are cut. Blocks of several facets are not convex, but all their faces
are plane and no gap is left anywhere.

Sections at every height are regular polygons, of area n/2 sin(2 pi/n) rho^2 instead of pi rho^2: with A the area of the
profile and rho its centroid's distance from the axis, a ring has the volume n sin(2 pi/n) A rho.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray
from mbla.deck.kinds.positions import COURSE, RING, SEGMENT
from mbla.deck.quantities import Count, EmbraceAngle, Integer, PositiveLength
from mbla.deck.section import Section, given, one_of, rule
from mbla.errors import Finding
from mbla.model.blocks.curves import named_curve, radius_of
from mbla.model.blocks.curves.shapes import Smooth
from mbla.model.blocks.generated import Generated, ItemContext, ItemPart, ItemRefused, level_ground
from mbla.model.blocks.item import SPRINGERS, ItemKind, SpringingItem, register_item
from mbla.model.solids.polyhedra import Polyhedra, chains, join_polyhedra


class DomeDrum(Section):
    """Cylindrical wall under a dome, in the same bond and with as many blocks around."""

    height: PositiveLength = Field(description="height up to the intrados springing")
    courses: Count = Field(description="number of courses")
    thickness: PositiveLength | None = Field(
        None, description="radial thickness, inside flush with the dome; default: thickness of the dome"
    )


class DomeItem(SpringingItem):
    """A spherical dome of rings of blocks about the z axis, bed joints conical about the centre of the sphere.

    The middle of the springing is at the origin, or at z = height of the drum, which then stands at z = 0. Circles are
    polygons with their corners on the circle. Labels: `ring` (the keystone is the last) and `segment`, in the drum
    `course` and `segment`; members `ring`, `keystone`, `drum`.
    """

    shape: Literal["hemispherical", "segmental"] = Field(
        "hemispherical", description="hemispherical, or segmental with rise or embrace"
    )
    span: PositiveLength = Field(description="diameter of the intrados at the springing")
    thickness: PositiveLength = Field(description="radial thickness")
    rings: Count = Field(description="number of rings, without the keystone")
    segments: Annotated[int, Integer(ge=3, le=10_000)] = Field(description="blocks of each ring")
    rise: PositiveLength | None = Field(None, description="segmental: height of the intrados crown over the springing")
    embrace: EmbraceAngle | None = Field(
        None, description="segmental: angle between the springing joints in a section through the axis, degrees"
    )
    oculus: PositiveLength | None = Field(
        None,
        description="diameter of an opening in the intrados at the crown; the rim is cut along the cone and has no "
        "level seat for a lantern",
    )
    keystone: PositiveLength | None = Field(
        None,
        description="diameter, in the intrados, of the block that closes the crown; without it and without an oculus "
        "the keystone is as wide as a ring",
    )
    bond: Literal["running", "stack"] = Field(
        "running", description="running: odd rings are turned by half a block; stack: joints run up the meridians"
    )
    facets: Annotated[int, Integer(ge=1, le=1000)] | None = Field(
        None,
        description="plane pieces around of each block's faces, even for running bond; default: 2, in stack bond 1",
    )
    drum: DomeDrum | None = Field(None, description="cylindrical wall that the dome stands on")


@rule(DomeItem)
def dome_shape(dome: DomeItem) -> Iterator[Finding]:
    """A hemisphere is given by its span alone; the crown is open or closed."""
    if dome.shape == "segmental":
        yield from one_of(dome, ("rise", "embrace"), " for a segmental dome")
    else:
        for key in given(dome, ("rise", "embrace")):
            yield Finding(
                "key-of-another-choice", "applies to segmental domes only: leave it out, or write shape: segmental", key
            )
    if dome.oculus is not None and dome.keystone is not None:
        yield Finding("one-of-several", "only one of oculus or keystone may be given", "keystone")


@rule(DomeItem)
def dome_bond(dome: DomeItem) -> Iterator[Finding]:
    """Half a block is an integer number of facets."""
    if dome.bond == "running" and dome.facets is not None and dome.facets % 2:
        words = "must be even in running bond: rings are turned by half a block; or write bond: stack"
        yield Finding("out-of-bounds", words, "facets")


@rule(DomeItem)
def dome_springers(dome: DomeItem) -> Iterator[Finding]:
    """Ground is one plane."""
    if dome.springers == "ground" and dome.shape == "segmental" and dome.drum is None:
        words = "a springing on ground is level, that of a segmental dome is a cone: write blocks, or add a drum"
        yield Finding("vault-shape", words, "springers")
    if dome.springers == "blocks" and dome.drum is not None:
        yield Finding("key-of-another-choice", "a drum carries the dome: write ground or none", "springers")


FLUSH = 1e-9
"""relative to the thickness: lengths and heights that differ by no more are the same"""


@dataclass(frozen=True)
class _Dome:
    """Intrados circle, angles of the joints from the springing up, height of the springing."""

    item: DomeItem
    circle: Smooth
    angles: FloatArray
    springing: float

    def joint(self, angle: float) -> FloatArray:
        """Intrados and extrados point of a joint, (2, 2): distance from the axis, height."""
        points = self.circle.points(np.array([angle]), np.array([[0.0, self.item.thickness]]))[0]
        return np.asarray(points - [self.item.span / 2, -self.springing], dtype=np.float64)

    def ring(self, profile: FloatArray, number: int) -> Polyhedra:
        """The blocks of a ring, (n,), counted from the springing; rings below it have negative numbers."""
        turned = self.item.bond == "running" and number % 2 == 1
        return ring_blocks(profile, self.item.segments, _facets(self.item), turned)


def _facets(item: DomeItem) -> int:
    return item.facets or (2 if item.bond == "running" else 1)


def generate(item: DomeItem, context: ItemContext) -> Generated:
    """Drum from the bottom, rings from the springing, keystone.

    Raises ItemRefused for an opening or keystone as wide as the dome, or a drum that does not carry it.
    """
    dome = _dome(item)
    joints = [dome.joint(angle) for angle in dome.angles]
    rings = [
        dome.ring(np.array([low[0], high[0], high[1], low[1]]), number)
        for number, (low, high) in enumerate(pairwise(joints))
    ]
    parts = [_part(rings, "ring", "ring")]
    if item.drum is not None:
        parts.insert(0, _part(list(_drum(dome, item.drum)), "drum", "course"))
    if item.oculus is None:
        labels = {"ring": np.array([item.rings]), "segment": np.array([0])}
        parts.append(ItemPart(_keystone(dome, joints[-1]), member="keystone", labels=labels))
    if item.springers == "blocks":
        labels = {"segment": np.arange(item.segments)}
        parts.append(ItemPart(dome.ring(_behind(dome, joints[0]), -1), SPRINGERS.suffix, fixed=True, labels=labels))
    grounds = (level_ground(np.arange(item.segments), item.joint),) if item.springers == "ground" else ()
    return Generated(tuple(parts), grounds)


def _dome(item: DomeItem) -> _Dome:
    shape = "semicircular" if item.shape == "hemispherical" else item.shape
    circle = named_curve(shape, item.span, item.rise, item.embrace)
    assert isinstance(circle, Smooth)  # a circle, which both shapes are
    springing = item.drum.height if item.drum else 0.0
    angles = np.linspace(circle.ends[1], _top(item, circle), item.rings + 1)
    return _Dome(item, circle, angles, springing)


def _top(item: DomeItem, circle: Smooth) -> float:
    """Angle of the last joint from the crown."""
    key = "oculus" if item.oculus is not None else "keystone"
    diameter: float | None = getattr(item, key)
    if diameter is None:
        return circle.ends[1] / (2 * item.rings + 1)
    across = 2 * radius_of(item.span, circle.ends[1])
    widest = across * np.sin(min(circle.ends[1], np.pi / 2))
    if diameter >= widest:
        raise ItemRefused(Finding("out-of-bounds", f"must be < {widest:g}, the greatest diameter of the intrados", key))
    return float(np.arcsin(diameter / across))


def _part(rings: list[Polyhedra], member: str, position: str) -> ItemPart:
    number = np.repeat(np.arange(len(rings)), [len(ring) for ring in rings])
    segment = np.concatenate([np.arange(len(ring)) for ring in rings])
    return ItemPart(join_polyhedra(rings), member=member, labels={position: number, "segment": segment})


def _drum(dome: _Dome, drum: DomeDrum) -> Iterator[Polyhedra]:
    """Courses from the bottom; the last has a bevelled bed for the dome, and a ledge where the drum is wider."""
    foot = dome.joint(dome.circle.ends[1])
    inside = foot[0, 0]
    outside = inside + (dome.item.thickness if drum.thickness is None else drum.thickness)
    if foot[1, 0] > outside + FLUSH * dome.item.thickness:
        message = f"must be >= {foot[1, 0] - inside:g}, so that the dome stands on the drum"
        raise ItemRefused(
            Finding("out-of-bounds", message, *(("drum",) if drum.thickness is None else ("drum", "thickness")))
        )
    heights = np.linspace(0.0, drum.height, drum.courses + 1)
    for course, (low, high) in enumerate(pairwise(heights)):
        profile = np.array([[inside, low], [inside, high], [outside, high], [outside, low]])
        if course == drum.courses - 1 and abs(foot[1, 1] - high) > FLUSH * dome.item.thickness:
            profile[2, 1] = foot[1, 1]
            if outside - foot[1, 0] > FLUSH * dome.item.thickness:
                profile = np.insert(profile, 2, foot[1], axis=0)
            if foot[1, 1] <= low:
                words = "too many: the springing joint cuts through the last course"
                raise ItemRefused(Finding("vault-shape", words, "drum", "courses"))
        yield dome.ring(profile, course - drum.courses)


def _keystone(dome: _Dome, joint: FloatArray) -> Polyhedra:
    """The frustum between the polygons of the last joint."""
    around = meridians(dome.item.segments * _facets(dome.item))
    heights = np.broadcast_to(joint[:, 1, None, None], (2, len(around), 1))
    return chains(np.concatenate([joint[:, :1, None] * around, heights], axis=2)[None])


def _behind(dome: _Dome, joint: FloatArray) -> FloatArray:
    """Profile of the fixed blocks: from the springing joint back by the thickness."""
    back = dome.item.thickness * np.array([np.cos(dome.circle.ends[1]), -np.sin(dome.circle.ends[1])])
    return np.array([joint[0] + back, joint[0], joint[1], joint[1] + back])


def meridians(count: int) -> FloatArray:
    """Directions (count, 2) of the corners of a regular polygon, the first along x."""
    angles = 2 * np.pi / count * np.arange(count)
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


def ring_blocks(profile: FloatArray, segments: int, facets: int, turned: bool) -> Polyhedra:
    """The blocks of one ring, counter-clockwise as seen from above.

    profile  : (n_corners, 2) distance from the axis and height, clockwise with the axis to the left
    segments : number of blocks
    facets   : sides of the polygon that a block spans
    turned   : the ring begins half a block on; facets is even then
    """
    first = facets * np.arange(segments) + (facets // 2 if turned else 0)
    corner = (first[:, None] + np.arange(facets + 1)) % (segments * facets)
    around = meridians(segments * facets)[corner]
    stations = np.empty((*corner.shape, len(profile), 3))
    stations[..., :2] = around[:, :, None, :] * profile[:, :1]
    stations[..., 2] = profile[:, 1]
    return chains(stations)


def amount(item: DomeItem) -> tuple[float, str]:
    """Facets of all blocks."""
    rings = item.rings + (item.drum.courses if item.drum else 0)
    return rings * item.segments * (item.facets or 2), "segments"


register_item(
    ItemKind("dome", DomeItem, generate, amount, after="bridge", positions=(RING, SEGMENT, COURSE), groups=(SPRINGERS,))
)
