"""Rules on bridges: one value per span, and which parts need which keys."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.arches import range_of_rise
from mbla.deck.rules.common import ROUNDING, given
from mbla.deck.section import Finding, rule
from mbla.errors import Message

OF_SPANDRELS = ("unit", "cover")
OF_EDGES = ("spandrel_thickness", "backing")


@rule(types.BridgeItem)
def bridge_arches(bridge: types.BridgeItem) -> Iterator[Finding]:
    """Rise and number of voussoirs for every span."""
    for key in ("rise", "voussoirs"):
        value = getattr(bridge, key)
        if isinstance(value, list) and len(value) != len(bridge.spans):
            yield (
                (key,),
                Message(
                    "arch-shape",
                    f"has {len(value)} values for {len(bridge.spans)} spans: give one for all or one for each",
                ),
            )
            return
    if bridge.shape == "semicircular":
        if bridge.rise is not None:
            yield (
                ("rise",),
                Message(
                    "key-of-another-choice", "is half the span for shape: semicircular: leave it out, or change shape"
                ),
            )
    elif bridge.rise is None:
        yield (), Message("missing-key", f"needs rise for shape: {bridge.shape}")
    else:
        for number, span in enumerate(bridge.spans):
            each = isinstance(bridge.rise, list)
            rise = bridge.rise[number] if isinstance(bridge.rise, list) else bridge.rise
            path = ("rise", number) if each else ("rise",)
            yield from range_of_rise(bridge.shape, span, rise, bridge.side_angle, path)
            if bridge.shape == "segmental" and rise > span / 2 * (1 + ROUNDING):
                yield (
                    path,
                    Message(
                        "out-of-bounds",
                        f"must be <= {span / 2:g}, half the span: the extrados may not lean back over the piers",
                    ),
                )
    if bridge.side_angle is not None and bridge.shape != "basket":
        yield (
            ("side_angle",),
            Message(
                "key-of-another-choice",
                f"applies to shape: basket only: leave it out, or change shape ({bridge.shape} given)",
            ),
        )


@rule(types.BridgeItem)
def bridge_parts(bridge: types.BridgeItem) -> Iterator[Finding]:
    """Piers between spans; sizes of spandrels where there are any."""
    if len(bridge.spans) > 1 and bridge.piers is None:
        yield (), Message("missing-key", "needs piers between its spans")
    if len(bridge.spans) == 1 and bridge.piers is not None:
        yield ("piers",), Message("one-of-several", "stand between spans, and there is only one: leave them out")
    if (bridge.abutments.height is None) != (bridge.abutments.courses is None):
        yield ("abutments",), Message("missing-key", "needs both height and courses, or none of them")
    if bridge.spandrels == "none":
        for key in given(bridge, (*OF_SPANDRELS, *OF_EDGES, "parapets")):
            yield (
                (key,),
                Message(
                    "key-of-another-choice",
                    "applies to a bridge with spandrels: leave it out, or write spandrels: full or edges",
                ),
            )
        return
    for key in OF_SPANDRELS:
        if not given(bridge, (key,)):
            yield (), Message("missing-key", f"needs {key} for spandrels: {bridge.spandrels}")
    if bridge.spandrels == "full":
        for key in given(bridge, OF_EDGES):
            yield (key,), Message("key-of-another-choice", "applies to spandrels: edges only")
    elif bridge.spandrel_thickness is None:
        yield (), Message("missing-key", "needs spandrel_thickness for spandrels: edges")


@rule(types.BridgeItem)
def bridge_across(bridge: types.BridgeItem) -> Iterator[Finding]:
    """Walls and parapets along both faces find room in the width."""
    half = bridge.width / 2
    if bridge.spandrel_thickness is not None and bridge.spandrel_thickness > half * (1 + ROUNDING):
        yield (
            ("spandrel_thickness",),
            Message("out-of-bounds", f"must be <= {half:g}, half the width: use spandrels: full"),
        )
    if bridge.parapets is not None and bridge.parapets.thickness > half * (1 + ROUNDING):
        yield ("parapets", "thickness"), Message("out-of-bounds", f"must be <= {half:g}, half the width")
