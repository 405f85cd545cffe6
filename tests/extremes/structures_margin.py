"""Structures whose load factor is zero or nearly, and those that move under their dead load alone."""

from __future__ import annotations

from tests.extremes.decks import deck, under_both_rules
from tests.extremes.outcome import Scene

SMALLEST = 1e-9
"""Of load factors near zero, absolute, in units of dead over live load: a millionth of the thousandth below which the
program measures its errors by that size (``ZERO_FACTOR``) instead of by the factor itself."""
FALLS, UNDECIDED = "no_equilibrium", "not_verified"


def _tolerance(factor: float) -> float:
    """Relative, or absolute for a load factor of zero."""
    return max(1e-6, SMALLEST / factor) if factor > 0 else SMALLEST


INCLINE = deck(
    """\
  - box: {group: block, material: stone, min: [-0.5, -0.5, 0], max: [0.5, 0.5, 0.2],
          transform: {rotate: {axis: [0, -1, 0], angle: "=a"}}}
""",
    'mu: 0.5, more: 0, a: "=atan(mu) + more*180/pi"',
    supports='[{ground: {point: [0, 0, 0], normal: ["=-sin(a)", 0, "=cos(a)"]}}]',
    load_cases="{down: {live: [{acceleration: [-1, 0, 0]}]}}",
)
"""Block on a slope, pushed down it: (mu - tan a)/(1 + mu tan a)."""

TIPPING = deck(
    """\
  - box: {group: base, material: stone, min: [-1, 0, 0], max: [0, 0.5, 0.2]}
  - box: {group: top, material: stone, min: ["=-0.5 + more", 0, 0.2], max: ["=0.5 + more", 0.5, 0.4]}
""",
    "more: 0",
    joint="friction: 0.8",
    supports="[{blocks: base}]",
    load_cases="{push: {live: [{acceleration: [1, 0, 0], on: top}]}}",
)
"""A block with its centre of gravity over the edge of the one below, pushed outwards: -more/(h/2)."""

OVERHANG = deck(
    """\
  - stack: {group: pile, material: stone, block: [1, 0.5, 0.2], count: "=n", overhang: "=s"}
""",
    's: 1, n: 12, weight: "=2000*9.81*0.1", tip: 0',
    joint="friction: 0.7",
    load_cases="""{tip: {live: [{force: [0, 0, "=-weight"], on: {group: pile, drum: -1},
                           at: ["=1 + tip", 0.25, "=0.2*n"]}]}}""",
)
"""Harmonic overhang loaded at its tip: (1 - s)/s."""

BLOCK = deck(
    """\
  - box: {group: block, material: stone, min: [0, 0, 0], max: ["=b", 1, "=h"]}
""",
    "mu: 0.5, live: 1, b: 1, h: 1",
    load_cases='{push: {live: [{acceleration: ["=live", 0, 0]}]}}',
)
"""One block on the ground: min(mu, b/h)/live."""


TWO = deck(
    """\
  - box: {group: safe, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: slab, material: stone, min: [0, 0, 1], max: [3, 1, 1.2]}
  - box: {group: loose, material: stone, min: [5, 0, 0], max: [6, 1, 1]}
""",
    joint="friction: 0.5",
    load_cases="{push: {live: [{acceleration: [1, 0, 0], on: loose}]}}",
)
"""A slab that falls off by its own weight, beside a block that is pushed."""


WEIGHTLESS = BLOCK.replace("load_cases: {push: {", "load_cases: {push: {dead: [{gravity: none}], ")


def _no_margin() -> list[Scene]:
    family, scenes = "no margin", []
    for more in (0.0, 1e-12, -1e-12, 1e-9, -1e-9, 1e-6, -1e-6):
        near = (UNDECIDED,) if abs(more) < 1e-8 else ()
        slope = 0.5 + 1.25 * more
        tipped = max(0.0, -more / 0.1)
        factor = (0.5 - slope) / (1 + 0.5 * slope) if more < 0 else 0.0
        falls = more > 0
        scenes += under_both_rules(
            f"incline {more:+.0e} over the angle of friction",
            family,
            INCLINE,
            None if falls and not near else factor,
            _tolerance(factor),
            ((FALLS,) if falls or more == 0 else ()) + near,
            (f"parameters.more={more!r}",),
            long=abs(more) not in (0.0, 1e-9),
        )
        scenes += under_both_rules(
            f"block {more:+.0e} beyond its tipping point",
            family,
            TIPPING,
            None if falls and not near else tipped,
            _tolerance(tipped),
            ((FALLS,) if falls or more == 0 else ()) + near,
            (f"parameters.more={more!r}",),
            long=abs(more) not in (0.0, 1e-9),
        )
    for s in (1.0, 1 - 1e-8, 1 + 1e-8, 1 - 1e-6, 1 + 1e-6):
        for n in (3, 12, 50):
            tip = s / 2 * sum(1 / k for k in range(1, n))
            close = abs(s - 1) < 1e-7
            falls, factor = s > 1, max(0.0, (1 - s) / s)
            scenes += under_both_rules(
                f"overhang of {n} blocks, {s - 1:+.0e} of the limit",
                family,
                OVERHANG,
                None if falls and not close else factor,
                _tolerance(factor),
                ((FALLS,) if falls or s == 1 else ()) + ((UNDECIDED,) if close else ()),
                (f"parameters.s={s!r}", f"parameters.n={n}", f"parameters.tip={tip!r}"),
                long=n != 12 or abs(s - 1) > 1e-7,
            )
    return scenes


def _without_weight() -> list[Scene]:
    return under_both_rules("one block without weight", "one block", WEIGHTLESS, 0.0, 1e-9, long=True)


def _moving() -> list[Scene]:
    family = "mechanism under the dead load"
    return [
        *under_both_rules("slab that tips off beside a block that is pushed", family, TWO, None, diagnosis=(FALLS,)),
    ]


SCENES = (*_no_margin(), *_without_weight(), *_moving())
