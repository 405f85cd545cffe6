"""Item `bridge`: arches between piers and abutments, coursed spandrels on them, backing and parapets.

The springings lie at z = 0, the first one at the origin; the spans follow each other along +x with the piers between
them, the width along +y. In the plane of the arches the blocks fill exactly what lies between the base of piers and
abutments and the top of the spandrels, less the openings under the chords of the intrados.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from mbla.deck.kinds.positions import COURSE, LEAF, RING, SPAN, UNIT, VOUSSOIR
from mbla.deck.quantities import Count, PositiveLength, SideAngle
from mbla.deck.section import ROUNDING, ByShape, Section, given, rule
from mbla.errors import Finding
from mbla.model.blocks.curves.shape_keys import CurveShape, range_of_rise, shape_keys
from mbla.model.blocks.generated import Generated, ItemContext
from mbla.model.blocks.item import AnyItem, ItemKind, register_item

Rises: TypeAlias = Annotated[PositiveLength | list[PositiveLength], ByShape("name")]
Counts: TypeAlias = Annotated[Count | list[Count], ByShape("name")]


class BridgePiers(Section):
    """Piers between the spans, of one block per course."""

    width: PositiveLength = Field(description="extent along x, between the springings of neighbouring spans")
    height: PositiveLength = Field(description="from the base to the springings")
    courses: Count = Field(description="number of courses")


class BridgeAbutments(Section):
    """Ends of the bridge behind the outer springings."""

    width: PositiveLength = Field(description="extent along x, outwards from the springing")
    height: PositiveLength | None = Field(
        None, description="from the base to the springings; default: 0, the abutments start at the springings"
    )
    courses: Count | None = Field(None, description="number of courses below the springings; with height")


class BridgeParapets(Section):
    """One course on top of the spandrels along both faces."""

    height: PositiveLength = Field(description="over the top of the spandrels")
    thickness: PositiveLength = Field(description="extent along y, from each face inwards")


class BridgeItem(AnyItem):
    """An arch bridge in the x-z plane, extruded along +y: arches, piers, abutments, spandrels, backing, parapets.

    The springings are at z = 0, the first one of the intrados at the origin. Spandrels are coursed masonry cut to the
    chords of the extrados and filling the space up to a level top without gaps. Beds of courses keep a quarter of the
    height of a unit away from crowns, and joints keep away from the tips of courses, so that no slivers arise. Members:
    `voussoir` (with `span`, `voussoir`, `ring`), `pier` and `abutment` (`course`, `unit` from the left), `springer`
    (`unit`), `spandrel`, `backing` and `parapet` (`course`, `unit`; `leaf` 0 at y = 0, 1 at the far face). Fill
    between the walls is a section of its own, `fill`.
    """

    spans: list[PositiveLength] = Field(min_length=1, description="clear span of each arch, from left to right")
    shape: CurveShape = Field(description="of every intrados; a segmental one is given by its rise")
    rise: Rises | None = Field(None, description="of the intrados: one for all spans or one for each; not semicircular")
    side_angle: SideAngle | None = Field(None, description="basket: angle of each side arc in degrees; default: 60")
    thickness: PositiveLength = Field(description="of the arches, along their joints")
    voussoirs: Counts = Field(description="number of voussoirs of each ring: one for all spans or one for each")
    rings: Count = Field(1, description="rings of equal thickness")
    width: PositiveLength = Field(description="extent along y")
    piers: BridgePiers | None = Field(None, description="piers; needed with more than one span")
    abutments: BridgeAbutments = Field(description="abutments")
    spandrels: Literal["full", "edges", "none"] = Field(
        "full", description="full: through the full width; edges: a wall along each face; none: bare arches"
    )
    unit: tuple[PositiveLength, PositiveLength] | None = Field(
        None, description="spandrels: length and height of a unit; courses are evened out to fit"
    )
    cover: PositiveLength | None = Field(
        None,
        description="spandrels: height of their top over the highest crown of the extrados, which of an odd number of "
        "voussoirs is the middle of a chord and a little below the curve (`mbla check` says how high the top lies)",
    )
    spandrel_thickness: PositiveLength | None = Field(None, description="edges: extent of each wall along y")
    backing: Count | None = Field(
        None, description="edges: number of courses, from the bottom, that are filled with blocks between the walls"
    )
    parapets: BridgeParapets | None = Field(None, description="parapets on the spandrels; default: none")


OF_SPANDRELS = ("unit", "cover")
OF_EDGES = ("spandrel_thickness", "backing")


@rule(BridgeItem)
def bridge_arches(bridge: BridgeItem) -> Iterator[Finding]:
    """Rise and number of voussoirs for every span."""
    for key in ("rise", "voussoirs"):
        value = getattr(bridge, key)
        if isinstance(value, list) and len(value) != len(bridge.spans):
            words = f"has {len(value)} values for {len(bridge.spans)} spans: give one for all or one for each"
            yield Finding("arch-shape", words, key)
            return
    if bridge.shape == "semicircular":
        if bridge.rise is not None:
            words = "is half the span for shape: semicircular: leave it out, or change shape"
            yield Finding("key-of-another-choice", words, "rise")
    elif bridge.rise is None:
        yield Finding("missing-key", f"needs rise for shape: {bridge.shape}")
    else:
        for number, span in enumerate(bridge.spans):
            each = isinstance(bridge.rise, list)
            rise = bridge.rise[number] if isinstance(bridge.rise, list) else bridge.rise
            path = ("rise", number) if each else ("rise",)
            yield from range_of_rise(bridge.shape, span, rise, bridge.side_angle, path)
            if bridge.shape == "segmental" and rise > span / 2 * (1 + ROUNDING):
                words = f"must be <= {span / 2:g}, half the span: the extrados may not lean back over the piers"
                yield Finding("out-of-bounds", words, *path)
    yield from shape_keys(bridge, bridge.shape, ("side_angle",))


@rule(BridgeItem)
def bridge_parts(bridge: BridgeItem) -> Iterator[Finding]:
    """Piers between spans; sizes of spandrels where there are any."""
    if len(bridge.spans) > 1 and bridge.piers is None:
        yield Finding("missing-key", "needs piers between its spans")
    if len(bridge.spans) == 1 and bridge.piers is not None:
        yield Finding("one-of-several", "stand between spans, and there is only one: leave them out", "piers")
    if (bridge.abutments.height is None) != (bridge.abutments.courses is None):
        yield Finding("missing-key", "needs both height and courses, or none of them", "abutments")
    if bridge.spandrels == "none":
        for key in given(bridge, (*OF_SPANDRELS, *OF_EDGES, "parapets")):
            words = "applies to a bridge with spandrels: leave it out, or write spandrels: full or edges"
            yield Finding("key-of-another-choice", words, key)
        return
    chosen = "spandrels" in bridge.model_fields_set
    needed = OF_SPANDRELS if bridge.spandrels == "full" else (*OF_SPANDRELS, "spandrel_thickness")
    missing = [key for key in needed if not given(bridge, (key,))]
    if missing:
        default = "" if chosen else ", the default; spandrels: none builds bare arches"
        yield Finding("missing-key", f"needs {' and '.join(missing)} for spandrels: {bridge.spandrels}{default}")
    if bridge.spandrels == "full":
        default = "" if chosen else ", and the default is full: write spandrels: edges, or leave it out"
        for key in given(bridge, OF_EDGES)[: None if chosen else 1]:
            yield Finding("key-of-another-choice", f"applies to spandrels: edges only{default}", key)


@rule(BridgeItem)
def bridge_across(bridge: BridgeItem) -> Iterator[Finding]:
    """Walls and parapets along both faces find room in the width."""
    half = bridge.width / 2
    if bridge.spandrel_thickness is not None and bridge.spandrel_thickness > half * (1 + ROUNDING):
        yield Finding(
            "out-of-bounds", f"must be <= {half:g}, half the width: use spandrels: full", "spandrel_thickness"
        )
    if bridge.parapets is not None and bridge.parapets.thickness > half * (1 + ROUNDING):
        yield Finding("out-of-bounds", f"must be <= {half:g}, half the width", "parapets", "thickness")


def generate(item: BridgeItem, context: ItemContext) -> Generated:
    """Voussoirs span by span, piers and abutments, springers, spandrels, backing, parapets.

    Raises ItemRefused where voussoirs are too few or cross, or springing joints do not fit piers and abutments.
    """
    from mbla.model.blocks.bridges.arches import arches, frame_of, supports
    from mbla.model.blocks.bridges.masonry import masonry

    frame = frame_of(item)
    parts = [*arches(item, frame), *supports(item, frame)]
    if item.spandrels != "none":
        parts += masonry(item, frame)
    return Generated(tuple(parts))


def amount(item: BridgeItem) -> tuple[float, str]:
    """Units of arches, piers and spandrels; of these none where lengths are beyond what a double holds."""
    n_spans = len(item.spans)
    voussoirs = sum(item.voussoirs) if isinstance(item.voussoirs, list) else item.voussoirs * n_spans
    piers = (item.piers.courses if item.piers else 0) * (n_spans - 1) + 2 * (item.abutments.courses or 0)
    carrying = voussoirs * item.rings + piers
    if item.unit is None or item.cover is None:
        return carrying, "voussoirs"
    rises = item.rise if isinstance(item.rise, list) else [item.rise or max(item.spans) / 2]
    top = max(rises) + item.thickness + item.cover
    length = sum(item.spans) + (item.piers.width if item.piers else 0.0) * (n_spans - 1) + 2 * item.abutments.width
    if not math.isfinite(length + top):
        return carrying, "voussoirs"  # which are refused
    filling = max(length / item.unit[0], 1.0) * max(top / item.unit[1], 1.0)
    return carrying + filling, "unit" if filling > carrying else "voussoirs"


register_item(
    ItemKind(
        "bridge", BridgeItem, generate, amount, after="trilithon", positions=(SPAN, VOUSSOIR, RING, COURSE, UNIT, LEAF)
    )
)
