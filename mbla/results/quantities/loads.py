"""Load cases as they are asked for: loads in words, and what a case has besides, a group each."""

from __future__ import annotations

from mbla.model.model import LoadCase, Pushing
from mbla.model.soil.soil_figure import SoilFigure
from mbla.questions.force import Objective
from mbla.questions.reaction import Settlement
from mbla.questions.tilt import Tilt
from mbla.questions.travel_position import TravelPosition
from mbla.results.quantities.group import Field, Group

LOAD_CASE = Group[LoadCase](lambda scene: scene.load_case, file="cases/*", asked=True)
TRAVEL = Group[TravelPosition](
    lambda scene: scene.load_case.question.record(TravelPosition), file="cases/*/travel", asked=True, part="travel"
)
PUSHOVER = Group[Pushing](lambda scene: scene.load_case.pushover, file="cases/*/pushover", asked=True, part="pushover")
TILT = Group[Tilt](lambda scene: scene.load_case.question.record(Tilt), file="cases/*/tilt", asked=True, part="tilt")
SETTLEMENT = Group[Settlement](
    lambda scene: scene.load_case.question.record(Settlement), file="cases/*/settlement", asked=True, part="settlement"
)
OBJECTIVE = Group[Objective](
    lambda scene: scene.load_case.question.record(Objective), file="cases/*/objective", asked=True, part="objective"
)
SOIL = Group[tuple[SoilFigure, ...]](
    lambda scene: scene.load_case.soil or None,
    file="cases/*/soil",
    rows="soil_mesh",
    asked=True,
    part="soil meshes",
    unverified="course",
)

ASSESSMENT = Group[LoadCase](lambda scene: scene.load_case, file="cases/*/assessment", asked=True)


@LOAD_CASE.quantity(dims="dead_item")
def dead_words(load_case: LoadCase) -> tuple[str, ...]:
    """Dead loads in words."""
    return load_case.dead_words


@LOAD_CASE.quantity(dims="live_item")
def live_words(load_case: LoadCase) -> tuple[str, ...]:
    """Live loads in words."""
    return load_case.live_words


TRAVEL.fields(
    TravelPosition,
    series=Field("name of the load case in the deck, of which this is one position"),
    number=Field("number of the position, from 1"),
    count=Field("positions on the path"),
    load_points=Field("where each axle stands, or the only force", "axle axis", unit="length", attribute="points"),
    distances=Field("of each from the beginning of the path, the first one first", "axle", unit="length"),
    forces=Field("force of each; off the path it does not act", "axle axis", unit="force"),
    carrying_blocks=Field("the block that carries each, or most of it; -1 off the path", "axle", attribute="blocks"),
    spread=Field("1 where they are shared between blocks, by their width or by fill"),
)
PUSHOVER.fields(
    Pushing,
    step=Field("displacement of the control point in a step", unit="length"),
    until=Field("its displacement at the end, inf: where the load factor is at its end", unit="length", rule="open"),
    until_load_factor=Field("load factor at the end, to which it falls"),
    steps=Field("steps at most"),
    blocks=Field(
        "blocks whose centre of mass is the control point; none: that of the live load on what moves",
        "controlled",
        rule="index of block",
    ),
    control_direction=Field(
        "way in which its displacement counts; nan: along the live load", "axis", rule="open", attribute="direction"
    ),
    error=Field("1 where steps of twice the size are made as well"),
    dead_levers=Field(
        "sums of arm times force of the dead load, arms from the centroid by rows", "block lever", unit="moment"
    ),
    live_levers=Field("the same of the live load", "block lever", unit="moment"),
    dead_following=Field("part of the dead load that turns with its blocks", "block component", unit="load"),
    live_following=Field("the same of the live load", "block component", unit="load"),
    live_following_levers=Field("levers of that part: where it acts", "block lever", unit="moment"),
)


@ASSESSMENT.quantity(part="assessment")
def asked(load_case: LoadCase) -> str | None:
    """What the deck asks of a code, as JSON."""
    return None if load_case.assessment is None else load_case.assessment.model_dump_json(exclude_none=True)


TILT.fields(
    Tilt,
    turning_axis=Field("unit vector about which the table turns, by the right hand", "axis", attribute="axis"),
    fixed=Field("dead load that does not turn", "block component", unit="load"),
    turning=Field("dead load that turns, while the table is level", "block component", unit="load"),
    across=Field("the same after a turn of 90 degrees", "block component", unit="load"),
    angle=Field("angle of collapse, to which live_load leads; nan: none, or see tangent", unit="degree", rule="open"),
    upright=Field("proved multiple of `across` that the level table bears, inf: any, nan: not known", rule="open"),
    tangent=Field("1 where the load factor is the tangent of the angle"),
)
SETTLEMENT.fields(
    Settlement,
    blocks=Field("fixed blocks that give way under this case", "settling_block", rule="index of block"),
    motions=Field(
        "their velocity and angular velocity in the unit motion of the support",
        "settling_block component",
        unit="motion",
    ),
    turns=Field("1: the support turns, its reaction is a moment"),
    words=Field("the settlement in words"),
    reference=Field(
        "reaction at rest, a force or a moment; reaction = reference - load factor x unit", unit="load", rule="open"
    ),
    unit=Field("unit of the loss of reaction", unit="load"),
    sense=Field("1; -1: the reaction is the negative of that, the greatest value of an objective"),
)
OBJECTIVE.fields(
    Objective,
    series=Field("name of the load case in the deck, of which this is one end"),
    which_end=Field("least or greatest value of the force", attribute="end"),
    at=Field("load factor of the live loads of the deck, which are among the dead loads here"),
    sides=Field("1: the force acts on this block or ground, -1: it comes from it, 0: neither", "body"),
    ties=Field("ties whose forces are added up; none: the force through joints", "sought_tie", rule="index of tie"),
    measured_along=Field("unit vector along which the force counts", "axis", attribute="direction"),
)


SOIL.fields(
    SoilFigure,
    size=Field("of the cells of a mesh of soil that was moved, over that which the deck asks for"),
    cells=Field("how many cells"),
    load_factor=Field(
        "upper load factor of the planar problem on it; inf: nothing moves, -inf: falls under its dead load alone",
        rule="open",
    ),
    followed=Field("1 where its corners were moved for this load case"),
    shown=Field("1 where the results are those on this mesh"),
)
