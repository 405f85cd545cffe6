"""The derivative of the associative load factor by each parameter that a deck asks for.

Strengths of joint laws and sizes of loads enter the Lagrangian linearly: one difference gives the derivative exactly.
For every other parameter the structure is built again a small step below and above its value, and the difference of the
Lagrangian is central; where the structure is another one on one side, it is one-sided, and says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.deck import Deck
from mbla.deck.parameter_keys import number_at, path_of_key, unit_of
from mbla.deck.section import ROUNDING
from mbla.deck.sections.materials import JointLaw
from mbla.errors import KeyPath, Message
from mbla.model.model import Joint, LoadCase
from mbla.solution.further.sensitivity.lagrangian import (
    State,
    lagrangian,
    load_power,
    pressure_on,
    resistance,
    state_of,
)
from mbla.solution.further.sensitivity.slopes import Side, Slope
from mbla.solution.further.sensitivity.structures import LoadedAssembly, guides_allow, structure_with
from mbla.solution.solution import Checks, Solution
from mbla.solution.thresholds import GAP_TOLERANCE

STEP = 1e-5
"""Step over the value of a parameter: the error of a central difference is about 1e-10 by truncation, as by rounding"""

KINK = 1e-2
"""Difference of the slopes to both sides, over the larger, from which they are two: of smooth functions it is 1e-5 or
so times their curvature."""

SLIGHT = 1e-7
"""Slope times value over the load factor below which the difference of two sides is rounding."""

TWISTS = 1e-9
"""Torsional motion of interfaces, over the largest, that is rounding"""

LAWS = ("friction", "friction_angle", "cohesion", "tensile_strength", "compressive_strength")
"""keys of a joint law that have a derivative; associative flow knows no other dilatancy than friction"""

LOADS = ("dead load", "live load")
"""parameters that are no key of the deck: factors on the loads, 1 as they are"""

TIE = "tie"
"""before the name of a tie whose capacity is a parameter, which need not be a key of the deck"""


Posed: TypeAlias = Callable[[LoadedAssembly], LoadedAssembly]
"""A structure with the loads of a problem"""


def _as_it_is(structure: LoadedAssembly) -> LoadedAssembly:
    return structure


def no_sensitivity(against: str) -> Message:
    """The remark on what keeps slopes from being found."""
    return Message("sensitivity-not-done", f"there is no sensitivity: {against}")


def sensitivity_of(
    deck: Deck, assembly: Assembly, load_case: LoadCase, solution: Solution, checks: Checks
) -> tuple[tuple[Slope, ...], tuple[Message, ...]]:
    """The slopes that the deck asks for, or a remark on why there are none."""
    against = why_no_sensitivity(load_case, solution, checks)
    if against:
        return (), (no_sensitivity(against),)
    return tuple(slopes(deck, LoadedAssembly(assembly, load_case), solution)), ()


def slope_by(
    deck: Deck, structure: LoadedAssembly, solution: Solution, checks: Checks, path: KeyPath, posed: Posed = _as_it_is
) -> float:
    """The slope by the number at one key path, whatever the deck asks for; nan where there is none.

    posed : puts the loads of another problem on a structure in the place of those of its load case
    """
    if solution.associative is None or why_no_sensitivity(structure.load_case, solution, checks):
        return math.nan
    state = state_of(structure, solution, solution.associative)
    return _of_path(deck, structure, state, path, posed).slope


def why_no_sensitivity(load_case: LoadCase, solution: Solution, checks: Checks) -> str:
    """Why there is no derivative; empty where there is one."""
    associative = solution.associative
    if against := load_case.question.no_sensitivity:
        return against
    if associative is None or not checks.gap <= GAP_TOLERANCE:
        return "the associative load factor is not proved"
    motions = associative.interface_motions
    if motions is not None and np.abs(motions[:, 0]).max(initial=0.0) > TWISTS * np.abs(motions).max(initial=0.0):
        return "in the associative mechanism interfaces twist by the law of contact_model: convex"
    return ""


def slopes(deck: Deck, structure: LoadedAssembly, solution: Solution) -> Iterator[Slope]:
    """Of each parameter in turn, in the order in which the deck asks for them."""
    assert solution.associative is not None
    state, asked = state_of(structure, solution, solution.associative), deck.analysis.sensitivity
    keys = [path_of_key(deck.data, key) for key in asked] if isinstance(asked, list) else list(_usual(deck, structure))
    for path in keys:
        yield _of_path(deck, structure, state, path, _as_it_is)
    if asked is True:
        yield from _of_ties(deck, structure, state)
        dead, live = load_power(structure, state)
        for name, power in zip(LOADS, (dead, state.load_factor * live), strict=True):
            yield _slope(state, name, 1.0, "", -power, Side.BOTH)


def _of_ties(deck: Deck, structure: LoadedAssembly, state: State) -> Iterator[Slope]:
    """By the greatest force of each tie, tension or push or either: the rate at which it gives way to it, exactly."""
    ties, unit = structure.model.ties, deck.units.force
    for row, name in enumerate(ties.names):
        pulls, pushes = ties.greatest[row] > 0.0, ties.least[row] < 0.0
        value, longer = float(ties.greatest[row] if pulls else -ties.least[row]), float(state.elongation[row])
        rate = pulls * max(longer, 0.0) + pushes * max(-longer, 0.0)  # both limits of a bar move
        yield _slope(state, f"{TIE} {name}", value, unit, rate, Side.BOTH if value > 0.0 else Side.ABOVE)


def _of_path(deck: Deck, structure: LoadedAssembly, state: State, path: KeyPath, posed: Posed) -> Slope:
    """Of a strength of a joint law, which is exact, or of any other number."""
    law = structure.model.joints.get(str(path[1])) if path[0] == "joints" and len(path) == 3 else None
    if law is not None and path[2] in LAWS:
        return _of_law(deck, structure, state, law, path)
    return _of_key(deck, structure, state, path, posed)


def _usual(deck: Deck, structure: LoadedAssembly) -> Iterator[KeyPath]:
    """Strengths of the joint laws in use, as far as they may change, and the densities of all materials."""
    for name, law in deck.content.joints.items():
        if name not in structure.contacts.joint_names:
            continue
        for key in LAWS:
            value = getattr(law, key)
            if value is not None and not (key == "tensile_strength" and law.cohesion == 0.0):
                yield "joints", name, key
    for name, material in deck.content.materials.items():
        yield "materials", name, "unit_weight" if material.density is None else "density"


def _slope(state: State, name: str, value: float, unit: str, slope: float, side: Side, remark: str = "") -> Slope:
    factor = state.load_factor
    return Slope(name, value, unit, slope, slope * value / factor if factor != 0.0 else math.nan, side, remark)


def _of_law(deck: Deck, structure: LoadedAssembly, state: State, law: Joint, path: KeyPath) -> Slope:
    """Of a strength of a joint law, which the Lagrangian is linear in."""
    key = str(path[2])
    field = "friction" if key == "friction_angle" else key
    own = getattr(law, field)
    value = number_at(deck.content, path)
    assert value is not None  # the deck was checked for that
    step = 1.0 if field == "friction" else own or pressure_on(structure, state, law)
    joints = structure.model.joints | {law.name: replace(law, **{field: own + step})}
    stronger = replace(structure.assembly, model=replace(structure.model, joints=joints))
    more = replace(structure, assembly=stronger)
    slope = (resistance(more, state) - resistance(structure, state)) / step
    if key == "friction_angle":
        slope *= math.radians(1.0) * (1.0 + own**2)
    side = _side(deck.content.joints[law.name], key)
    return _slope(state, _text(path), value, unit_of([path], deck.units), slope, side)


def _side(law: JointLaw, key: str) -> Side:
    """To which sides a strength of a joint law may change at all: none falls below zero, tension ends with the cone."""
    value = getattr(law, key)
    friction = math.tan(math.radians(law.friction_angle or 0.0)) if law.friction is None else law.friction
    at_apex = law.tensile_strength > 0.0 and law.cohesion <= friction * law.tensile_strength * (1.0 + ROUNDING)
    if value == 0.0 or (at_apex and key == "cohesion"):
        return Side.ABOVE
    return Side.BELOW if at_apex and key != "compressive_strength" else Side.BOTH


def _of_key(deck: Deck, structure: LoadedAssembly, state: State, path: KeyPath, posed: Posed) -> Slope:
    """Of any number in the deck, by structures a step below and above."""
    value, unit = number_at(deck.content, path), unit_of([path], deck.units)
    assert value is not None  # the deck was checked for that
    step, key = STEP * abs(value), _text(path)
    if value == 0.0:
        step = STEP * float(structure.model.blocks.sizes.max()) if unit == deck.units.length else STEP
    found: dict[int, float] = {0: lagrangian(structure, state)}
    words: dict[int, str] = {}

    def look(row: int) -> bool:
        other = structure_with(deck, f"{key}={value + row * step!r}", structure, str(path[0]))
        if isinstance(other, str):
            words[row] = other
        elif not guides_allow(other, other.moved_along(state.mechanism, state.centroids)):
            words[row] = "guides"
        else:
            found[row] = lagrangian(posed(other), state)
        return row in found

    def one_sided(sign: int) -> float:
        """Of second order where the structure is the same for two steps."""
        if look(2 * sign):
            return sign * (-3.0 * found[0] + 4.0 * found[sign] - found[2 * sign]) / (2.0 * step)
        return sign * (found[sign] - found[0]) / step

    below, above = look(-1), look(1)
    if not below and not above:
        remark = f"not known: a small change either way is one of the {words[1]}"
        return _slope(state, key, value, unit, math.nan, Side.NONE, remark)
    if not below or not above:
        sign = 1 if above else -1
        remark = f"on the other side another {words[-sign]}"
        return _slope(state, key, value, unit, one_sided(sign), Side.ABOVE if above else Side.BELOW, remark)
    left, right = (found[0] - found[-1]) / step, (found[1] - found[0]) / step
    large = max(abs(left), abs(right))
    if abs(right - left) > KINK * large and large * abs(value or step / STEP) > SLIGHT * abs(state.load_factor):
        return _slope(state, key, value, unit, one_sided(1), Side.KINK, f"below {one_sided(-1):.6g}")
    return _slope(state, key, value, unit, 0.5 * (left + right), Side.BOTH)


def _text(path: KeyPath) -> str:
    """A key path as ``--set`` takes it."""
    return ".".join(map(str, path))
