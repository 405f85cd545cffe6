"""A structure in time: its steps with energies, states that are kept, histories, greatest values."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.results.quantities.group import Field, Group
from mbla.results.record.scene import Scene
from mbla.solution.time_history.frames import Frames, PointSet
from mbla.solution.time_history.history import HalfStep, Peaks, RecordedHistories, TimeHistoryResult
from mbla.solution.time_history.step_rows import HistoryEnd, StepRows


def followed(scene: Scene) -> TimeHistoryResult | None:
    """What was found, where a structure was followed in time."""
    found = scene.solved.solution.further.time_history
    return None if found.end is HistoryEnd.NONE else found


RESULT = Group[TimeHistoryResult](followed, file="cases/*/time_history", part="time history", unverified="time")
STEPS = Group[StepRows](
    lambda scene: scene.solved.solution.further.time_history.rows,
    file="cases/*/time_history/steps",
    files="table",
    table="history_steps",
    part="time steps",
    unverified="time",
)
STATES = Group[Frames](
    lambda scene: scene.solved.solution.further.time_history.frames,
    file="cases/*/time_history/states",
    part="states in time",
    unverified="time",
)
HISTORIES = Group[RecordedHistories](
    lambda scene: scene.solved.solution.further.time_history.histories,
    file="cases/*/time_history/record",
    part="histories",
    unverified="time",
)
PEAKS = Group[Peaks](
    lambda scene: scene.solved.solution.further.time_history.peaks,
    file="cases/*/time_history/peaks",
    part="peaks",
    unverified="time",
)
HALF_STEP = Group[HalfStep](
    lambda scene: scene.solved.solution.further.time_history.half,
    file="cases/*/time_history/half_step",
    part="half step",
    unverified="time",
)

RESULT.fields(
    TimeHistoryResult,
    end=Field("why the history ends"),
    sag=Field(
        "greatest displacement by which joints give under the dead load; nan: not known", unit="length", rule="open"
    ),
    stiffness=Field(
        "of joints across and along, force per volume, mean; nan: not known", "spring", unit="bedding", rule="open"
    ),
    period=Field("first period of the joints that press at rest; nan: not needed", unit="time", rule="open"),
    damping=Field(
        "share of critical damping at it: what is asked and that of the step, without contact_damping; nan: not known",
        rule="open",
    ),
    searches=Field("searches for contacts"),
    seconds=Field("time that it took", unit="time", unverified="times"),
)
STEPS.fields(
    StepRows,
    times=Field("time; row 0 is the structure at rest", "time_step", unit="time"),
    kinetic=Field("energy of motion in the frame of the base", "time_step", unit="moment"),
    potential=Field("energy that the dead load has gained since rest", "time_step", unit="moment"),
    elastic=Field("energy stored in joints and ties, a part of what these took", "time_step", unit="moment"),
    friction=Field("energy taken along joints: by sliding, and stored", "time_step", unit="moment"),
    contacts=Field(
        "energy taken across joints: stored, and lost in impacts, dashpots and crushing", "time_step", unit="moment"
    ),
    ties=Field("energy taken by ties", "time_step", unit="moment"),
    base=Field("work of the motion of the base", "time_step", unit="moment"),
    forces=Field("work of forces over time, and of dead loads that turn", "time_step", unit="moment"),
    numerical=Field(
        "numerical energy of bodies that turn about changing axes, and of steps that change", "time_step", unit="moment"
    ),
    residuals=Field(
        "velocity that the step leaves out of balance, over that of free fall in it; nan in row 0",
        "time_step",
        rule="open",
    ),
    factorisations=Field("factorisations so far", "time_step"),
    small_steps=Field("steps so far that were made in the place of those of the deck", "time_step"),
    halved=Field("steps so far that were halved", "time_step"),
    missed=Field("smallest steps so far that did not converge", "time_step"),
    pressing=Field("contact points that press", "time_step"),
)
STATES.fields(
    Frames,
    times=Field("begin of the step that starts from the state", "state", unit="time"),
    lengths=Field("length of that step", "state", unit="time"),
    lengths_before=Field("length of the step before", "state", unit="time"),
    shift=Field(
        "displacement of the centroid of each block, from as built, relative to the base",
        "state block axis",
        unit="length",
        attribute="shifts",
    ),
    rotation=Field("rotation vector of each block", "state block axis", unit="radian", attribute="turns"),
    solid_of_block=Field("solid that each block is part of: by glue, or as a kinematic block", "block"),
    momenta_before=Field(
        "momentum and angular momentum about the centre of mass of each solid, before the step",
        "state solid component",
        unit="momentum",
    ),
    momenta=Field("the same after the step", "state solid component", unit="momentum"),
    velocities=Field(
        "of the centroid of each block, and of its turn, after the step", "state block component", unit="speeds"
    ),
    base=Field("displacement of the base", "state axis", unit="length"),
    missed=Field("1 where the step did not converge", "state"),
    set_of_state=Field("set of contact points of the step, from 0", "state", attribute="set_of_frame"),
    point_start=Field("first of the values of each state", "state_bound", rule="start of state_point"),
    remembered=Field(
        "forces that joints have at gap and slip 0 of the step: of crushing, and of slip before",
        "state_point direction",
        unit="force",
    ),
    contact_forces=Field(
        "forces of the step, impulse over length, compression positive",
        "state_point direction",
        unit="force",
        attribute="forces",
    ),
)


@STATES.quantity(dims="set_bound", rule="start of set_point")
def set_start(frames: Frames) -> IntArray:
    """First contact point of each set; the values of a state are in the order of the points of its set."""
    return starts(np.array([len(each.laws) for each in frames.sets], dtype=np.int64))


_NO, _WHOLE = np.zeros(0), np.zeros(0, dtype=np.int64)
NO_POINTS = PointSet(
    bodies=_WHOLE.reshape(0, 2),
    host=np.zeros(0, dtype=np.bool_),
    arms=_NO.reshape(0, 2, 3),
    frames=_NO.reshape(0, 3, 3),
    laws=_WHOLE,
    areas=_NO,
    stiffness=_NO.reshape(0, 3),
    dashpot=_NO,
)


def _sets(scene: Scene) -> PointSet | None:
    """All sets of contact points of a history, one after the other."""
    frames = scene.solved.solution.further.time_history.frames
    if frames is None:
        return None
    each = (NO_POINTS, *frames.sets)
    return PointSet(**{name: np.concatenate([getattr(one, name) for one in each]) for name in vars(NO_POINTS)})


SETS = Group[PointSet](_sets, file="cases/*/time_history/states", part="states in time", unverified="time")
SETS.fields(
    PointSet,
    bodies=Field("solids that touch, then grounds; -1 of ties", "set_point pair"),
    host=Field("1 where the second body is the one in whose frame the frame is", "set_point"),
    arms=Field(
        "material point of each body, from the reference point of its solid, as built",
        "set_point pair axis",
        unit="length",
    ),
    frames=Field("normal and tangents, in the frame of that body", "set_point direction axis"),
    law=Field("joint law, by its place among those of the deck; of ties their number", "set_point", attribute="laws"),
    areas=Field("of the point, for strength", "set_point", unit="area"),
    stiffness=Field("of the point, across and along", "set_point direction", unit="spring"),
    dashpot=Field("damping of the point over its stiffness", "set_point", unit="time"),
)

HISTORIES.fields(
    RecordedHistories,
    times=Field("time", "instant", unit="time"),
    velocity_times=Field("instant that velocities are of: the middle of the last step before", "instant", unit="time"),
    displacements=Field(
        "displacement of each point that the deck names, relative to the base, since rest",
        "instant recorded_point axis",
        unit="length",
    ),
    velocities=Field("velocity of each, relative to the base", "instant recorded_point axis", unit="speed"),
    accelerations=Field(
        "absolute acceleration of each, mean since the one before; 0 in the first, at rest",
        "instant recorded_point axis",
        unit="acceleration",
    ),
    openings=Field(
        "greatest opening of each interface that the deck names, between corners that touched as built",
        "instant recorded_interface",
        unit="length",
    ),
    slips=Field("greatest slip of each", "instant recorded_interface", unit="length"),
    interface_forces=Field(
        "force on the second body of each, as the deck names them, the sum over its points",
        "instant recorded_interface axis",
        unit="force",
        attribute="forces",
    ),
)


@HISTORIES.quantity(dims="instant axis", unit="length")
def base_displacement(found: RecordedHistories) -> FloatArray:
    """Displacement of the base; the absolute one of a point is its own and this."""
    return found.base[:, 0]


@HISTORIES.quantity(dims="instant axis", unit="speed")
def base_velocity(found: RecordedHistories) -> FloatArray:
    """Velocity of the base."""
    return found.base[:, 1]


@HISTORIES.quantity(dims="instant axis", unit="acceleration")
def base_acceleration(found: RecordedHistories) -> FloatArray:
    """Acceleration of the base."""
    return found.base[:, 2]


BASE = ("base_displacement", "base_velocity", "base_acceleration")
"""in the order of their record"""

PEAKS.fields(
    Peaks,
    displacements=Field(
        "greatest displacement of the centroid of each block relative to the base, since rest", "block", unit="length"
    ),
    times=Field("when that was", "block", unit="time"),
    rotations=Field("greatest rotation of each block", "block", unit="radian"),
    residuals=Field(
        "displacement of each block at the end",
        "block",
        unit="length",
    ),
    ends=Field(
        "displacement and rotation vector of each block at the end, from as built, relative to the base",
        "block component",
        unit="displacement",
    ),
    wanders=Field(
        "greatest distance from its residual displacement over the last tenth of the duration", "block", unit="length"
    ),
    openings=Field("greatest opening of each interface", "interface", unit="length"),
    slips=Field("greatest slip of each interface", "interface", unit="length"),
    falling=Field(
        "when the block had fallen by half of its height; nan: it has not", "block", unit="time", rule="open"
    ),
)
HALF_STEP.fields(
    HalfStep,
    peak=Field("greatest displacement of the same history with half of the step", unit="length"),
    time=Field("when that was", unit="time"),
    residual=Field("greatest displacement at its end", unit="length"),
    end=Field("why it ends"),
)
