"""Checks across the keys of one section, each registered for its type; names across sections are in ``references``.

A rule gets a section whose own keys are all valid and yields (key path below it, what is wrong and what is allowed).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from mbla.deck import types
from mbla.deck.section import Finding, Section, rule
from mbla.deck.suggestions import listed

_ROUNDING = 1e-9
"""Relative: sums of lengths such as 6 x 0.175 are not exact in binary."""


EXACTLY_ONE: dict[type[Section], tuple[str, ...]] = {
    types.Material: ("density", "unit_weight"),
    types.JointLaw: ("friction", "friction_angle"),
    types.BlockItem: tuple(types.BlockItem.model_fields),
    types.TransformStep: tuple(types.TransformStep.model_fields),
    types.SelectorTerm: ("group", "box"),
    types.GroundPlane: ("x", "y", "z", "point"),
    types.Load: ("gravity", "acceleration", "force"),
}
"""Keys of which a section has exactly one; the schema says so too."""


def _given(section: Any, keys: Sequence[str]) -> list[str]:
    return [key for key in keys if getattr(section, key) is not None]


def _exactly_one(section: Any, keys: Sequence[str], what: str = "") -> Iterator[Finding]:
    given = _given(section, keys)
    if not given:
        yield (), f"needs one of {listed(keys)}{what}"
    elif len(given) > 1:
        yield (given[1],), f"only one of {listed(keys)} may be given{what}, here are {listed(given, 'and')}"


def _least_below_greatest(low: Sequence[float], high: Sequence[float], key: str, names: str) -> Iterator[Finding]:
    for axis, (least, greatest) in enumerate(zip(low, high, strict=True)):
        if not least < greatest:
            yield (key, axis), f"must be > {least:g}, the {names[axis]} of the other corner"


def _is_zero(vector: Sequence[float]) -> bool:
    return not any(vector)


def _register_exactly_one(section: type[Section], keys: tuple[str, ...]) -> None:
    @rule(section)
    def one_key(item: Section) -> Iterator[Finding]:
        yield from _exactly_one(item, keys)


for _section, _keys in EXACTLY_ONE.items():
    _register_exactly_one(_section, _keys)


# --- materials and joints -----------------------------------------------------------------------------------------


@rule(types.JointLaw)
def joint_friction(joint: types.JointLaw) -> Iterator[Finding]:
    """Dilatancy at most the friction angle."""
    if len(_given(joint, ("friction", "friction_angle"))) != 1:
        return
    angle = joint.friction_angle if joint.friction is None else math.degrees(math.atan(joint.friction))
    if angle is not None and joint.dilatancy > angle * (1 + _ROUNDING):
        yield ("dilatancy",), f"must be <= {angle:.6g} degrees, the friction angle"


@rule(types.JointLaw)
def joint_strengths(joint: types.JointLaw) -> Iterator[Finding]:
    """The friction cone must be open at the tensile strength: it ends at the tension cohesion / friction."""
    if joint.friction is None and joint.friction_angle is None:
        return
    friction = math.tan(math.radians(joint.friction_angle or 0.0)) if joint.friction is None else joint.friction
    if joint.cohesion < friction * joint.tensile_strength * (1 - _ROUNDING):
        yield (
            ("tensile_strength",),
            f"must be <= {joint.cohesion / friction:.6g}, cohesion / friction, where the friction cone ends: "
            f"lower it, or raise cohesion to {friction * joint.tensile_strength:.6g}",
        )


# --- blocks -------------------------------------------------------------------------------------------------------


@rule(types.Rotation)
def rotation_axis(rotation: types.Rotation) -> Iterator[Finding]:
    """An axis has a direction."""
    if _is_zero(rotation.axis):
        yield ("axis",), "must not be the zero vector"


@rule(types.Reflection)
def mirror_normal(reflection: types.Reflection) -> Iterator[Finding]:
    """A plane has a normal."""
    if _is_zero(reflection.normal):
        yield ("normal",), "must not be the zero vector"


@rule(types.BoxItem)
def box_extent(box: types.BoxItem) -> Iterator[Finding]:
    """Corners in order, none equal."""
    yield from _least_below_greatest(box.min, box.max, "max", "xyz")


@rule(types.PolyhedronItem)
def polyhedron_faces(polyhedron: types.PolyhedronItem) -> Iterator[Finding]:
    """Faces use vertices that exist, each once."""
    n_vertices = len(polyhedron.vertices)
    for number, face in enumerate(polyhedron.faces):
        if max(face) >= n_vertices:
            position = next(i for i, corner in enumerate(face) if corner >= n_vertices)
            yield ("faces", number, position), f"must be <= {n_vertices - 1}: there are {n_vertices} vertices, from 0"
        elif len(set(face)) < len(face):
            position = next(i for i, corner in enumerate(face) if corner in face[:i])
            yield ("faces", number, position), "is a corner of this face already"


@rule(types.WallItem)
def wall_openings(wall: types.WallItem) -> Iterator[Finding]:
    """Openings have an extent and lie within the wall."""
    height = wall.courses * wall.unit[2]
    for number, opening in enumerate(wall.openings):
        for axis, (limit, what) in enumerate(((wall.length, "length"), (height, "height"))):
            low, high = opening.from_[axis], opening.to[axis]
            if not low < high:
                yield ("openings", number, "to", axis), f"must be > {low:g}, that of from"
            if low < -_ROUNDING * limit:
                yield ("openings", number, "from", axis), "must be >= 0: the opening must lie within the wall"
            if high > limit * (1 + _ROUNDING):
                yield ("openings", number, "to", axis), f"must be <= {limit:g}, the {what} of the wall"


@rule(types.ArchItem)
def arch_shape(arch: types.ArchItem) -> Iterator[Finding]:
    """A semicircle is given by its span alone; a segment needs its rise or its angle."""
    keys = ("rise", "embrace")
    if arch.shape == "segmental":
        yield from _exactly_one(arch, keys, " for a segmental arch")
    else:
        for key in _given(arch, keys):
            yield (
                (key,),
                f"applies to segmental arches only: leave it out, or write shape: segmental ({arch.shape} given)",
            )
    if arch.joint is not None and arch.springers != "ground":
        yield ("joint",), "applies with springers: ground only"


# --- selectors, supports ------------------------------------------------------------------------------------------


@rule(types.SelectorTerm)
def selector_term(term: types.SelectorTerm) -> Iterator[Finding]:
    """An index counts within a group; a box has an extent."""
    if term.box is not None and term.index is not None:
        yield ("index",), "applies with group only"
    if term.box is not None:
        for (key, axis), message in _least_below_greatest(*term.box, "box", "xyz"):
            yield (key, 1, axis), message


@rule(types.GroundPlane)
def ground_plane(ground: types.GroundPlane) -> Iterator[Finding]:
    """A normal goes with a point."""
    if ground.point is not None and ground.normal is None:
        yield (), "needs a normal beside its point"
    if ground.normal is not None and ground.point is None:
        yield ("normal",), "applies with point only"
    if ground.normal is not None and _is_zero(ground.normal):
        yield ("normal",), "must not be the zero vector"


@rule(types.Support)
def support(item: types.Support) -> Iterator[Finding]:
    """Ground, or blocks that do not move."""
    if item.ground is None and item.blocks is None:
        yield (), "needs one of ground or blocks"
    elif item.joint is not None and item.ground is None:
        yield ("joint",), "applies with ground only: blocks that do not move have the joints of their contacts"


# --- loads --------------------------------------------------------------------------------------------------------


@rule(types.Load)
def load_keys(load: types.Load) -> Iterator[Finding]:
    """Where a load acts, as far as that applies."""
    if load.force is not None and load.on is None:
        yield (), "a force needs `on`, the block it acts on"
    if load.at is not None and load.force is None:
        yield ("at",), "applies to a force only"
    if load.on is not None and load.gravity is not None:
        yield ("on",), "does not apply to gravity, which acts on all blocks: use acceleration"


@rule(types.LoadCaseSection)
def live_load_effect(case: types.LoadCaseSection) -> Iterator[Finding]:
    """A live load must do something."""
    for number, load in enumerate(case.live):
        for key in _given(load, EXACTLY_ONE[types.Load]):
            if _is_zero(getattr(load, key)):
                yield ("live", number, key), "is a live load with no effect"


# --- analysis -----------------------------------------------------------------------------------------------------


@rule(types.AnalysisSection)
def linear_programs(analysis: types.AnalysisSection) -> Iterator[Finding]:
    """Polyhedra and HiGHS go with flow rules whose programs are linear."""
    normality = analysis.flow_rule in ("associative", "livesley")
    for key, value, special, default in (
        ("friction_cone", analysis.friction_cone, "polyhedral", "circular"),
        ("solver", analysis.solver, "highs", "auto"),
    ):
        if value != special:
            continue
        if not normality:
            yield (
                (key,),
                f"applies to flow_rule: associative or livesley only ({analysis.flow_rule} here): use {default}",
            )
        elif analysis.contact_model != "concave":
            yield (key,), f"applies to contact_model: concave only ({analysis.contact_model} here): use {default}"


CONVEX_FLOW_RULES = ("associative", "non_associative")
NOT_CONVEX = (("form", "kinematic"), ("second_opinion", False), ("force_ranges", False))


@rule(types.AnalysisSection)
def convex_contact_model(analysis: types.AnalysisSection) -> Iterator[Finding]:
    """Interface resultants are solved in one way."""
    if analysis.contact_model != "convex":
        return
    if analysis.flow_rule not in CONVEX_FLOW_RULES:
        allowed = listed(CONVEX_FLOW_RULES)
        yield ("flow_rule",), f"contact_model: convex allows {allowed} only ({analysis.flow_rule} here)"
    if analysis.flow_rule == "non_associative" and analysis.scheme not in ("auto", "proximal"):
        yield ("scheme",), f"contact_model: convex allows auto or proximal only ({analysis.scheme} here)"
    if analysis.solver == "mbla":
        yield ("solver",), "applies to contact_model: concave only, whose cones have three dimensions: use auto"
    for key, default in NOT_CONVEX:
        if getattr(analysis, key) != default:
            yield (key,), f"applies to contact_model: concave only: use {str(default).lower()}"


@rule(types.DeckContent)
def convex_outlines(deck: types.DeckContent) -> Iterator[Finding]:
    """Interface resultants need the outlines as they are."""
    if deck.analysis.contact_model == "convex" and deck.contacts.inset > 0:
        yield ("contacts", "inset"), "applies to contact_model: concave only: use 0"


# --- expectations -------------------------------------------------------------------------------------------------


@rule(types.Expectation)
def expectation(item: types.Expectation) -> Iterator[Finding]:
    """Something must be expected."""
    if not _given(item, ("load_factor", "associative_load_factor", "lower", "status")):
        yield (), "needs at least one of load_factor, associative_load_factor, lower or status"
