"""Steps of a pushover: its curve, and what its rows follow from: poses, contact points, forces, history."""

from __future__ import annotations

from mbla.results.quantities.group import Field, Group
from mbla.results.record.scene import Scene
from mbla.solution.pushover.curve_rows import CurveRow
from mbla.solution.pushover.pushover import Pushover
from mbla.solution.pushover.record import PushedRows, RowPoints


def _pushed(scene: Scene) -> Pushover | None:
    """What was found, where anything was."""
    found = scene.solved.solution.further.pushover
    return None if found.rows is None else found


def _curve(scene: Scene) -> tuple[CurveRow, ...] | None:
    found = _pushed(scene)
    return None if found is None else found.curve


def _points(scene: Scene) -> RowPoints | None:
    rows = scene.solved.solution.further.pushover.rows
    return None if rows is None else rows.points


PUSHOVER = Group[Pushover](_pushed, file="cases/*", part="curve")
CURVE = Group[tuple[CurveRow, ...]](
    _curve, file="cases/*/curve", files="table", table="curve", rows="curve_row", part="curve"
)
ROWS = Group[PushedRows](lambda scene: scene.solved.solution.further.pushover.rows, file="cases/*/pushed", part="curve")
POINTS = Group[RowPoints](_points, file="cases/*/pushed", part="curve")

PUSHOVER.fields(
    Pushover,
    curve_end=Field("why the pushover ends", unverified="curve"),
    curve_end_error=Field(
        "change of the displacement there with steps of twice the size; nan: not known",
        unit="length",
        rule="open",
        unverified="curve",
    ),
    curve_last_error=Field(
        "change of the load factor there with steps of twice the size; nan: not known", rule="open", unverified="curve"
    ),
)
CURVE.fields(
    CurveRow,
    step=Field("row of the pushover, 0: as it starts to move"),
    displacement=Field("of the control point", unit="length"),
    load_factor=Field("load factor that holds the structure there; of a tilting table its angle in radians"),
    reaction=Field("of a settling support, nan without one", unit="force", rule="open"),
    angle=Field("of a tilting table that holds the structure there, nan without one", unit="degree", rule="open"),
    error=Field("of the load factor, by steps of twice the size; nan: not known", rule="open", unverified="curve"),
    residual=Field("of the law of elastic joints and of balance, the greater; nan in row 0", rule="open"),
    overlap=Field("greatest overlap of blocks", unit="length"),
    live_work=Field("work of the live load since step 0", unit="moment", unverified="curve"),
    friction=Field("energy dissipated in sliding since step 0", unit="moment", unverified="curve"),
    tie_work=Field("energy dissipated by ties since step 0", unit="moment", unverified="curve"),
    crushing=Field("energy dissipated since step 0 in joints that crush", unit="moment", unverified="curve"),
    potential=Field("energy that the dead load has gained since step 0", unit="moment", unverified="curve"),
    new_mechanism=Field("1 where it moves in another way than the step before"),
    jumps=Field(
        "jumps since the step before: no equilibrium was nearby, and the structure moved in time to its next rest",
        unverified="curve",
    ),
    unsolved=Field("steps between it and the one before that were not found", unverified="curve"),
    debris=Field("blocks that have fallen without the rest", unverified="curve"),
    broken=Field("ties that have broken, or went with debris"),
)
ROWS.fields(
    PushedRows,
    shift=Field(
        "displacement of the centroid of each block since step 0",
        "pushed_row block axis",
        unit="length",
        attribute="shifts",
    ),
    rotation=Field(
        "rotation vector of each block since step 0", "pushed_row block axis", unit="radian", attribute="turns"
    ),
    fallen=Field("1 for blocks that have fallen without the rest", "pushed_row block", unverified="curve"),
    stiffness=Field("of joints across and along, force per volume", "pair", unit="bedding", unverified="curve"),
    point_start=Field(
        "first contact point of each row; row 0 has none of its own", "pushed_bound", rule="start of pushed_point"
    ),
)
POINTS.fields(
    RowPoints,
    bodies=Field("solids that touch, then grounds; −1 of ties", "pushed_point pair"),
    host=Field("1 where the second body is the one whose face carries the frame", "pushed_point", unverified="curve"),
    arms=Field("material point of each body, from its centroid as built", "pushed_point pair axis", unit="length"),
    frames=Field("normal and tangents, in the frame of the body with the face", "pushed_point direction axis"),
    law=Field(
        "joint law, by its place among those of the deck; of ties their number", "pushed_point", attribute="laws"
    ),
    areas=Field("of the point, for strength and for stiffness", "pushed_point pair", unit="area", unverified="curve"),
    at_zero=Field(
        "forces that the point would have if it had not moved",
        "pushed_point direction",
        unit="force",
        attribute="history",
        unverified="curve",
    ),
    contact_forces=Field(
        "contact forces of the moved blocks, compression positive",
        "pushed_point direction",
        unit="force",
        attribute="forces",
    ),
)
