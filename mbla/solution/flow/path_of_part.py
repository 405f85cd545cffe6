"""The path of elastic joints of one part, or of its moving blocks alone; it is followed again where it is lost.

The unit of the path is the load factor of associative flow, ``scale``. Two kinds of part have none:

* Associative flow locks. The unit of load of the part takes its place, then the load factor of that path, until both
  are of one size. Where no joint yields, λ is proportional to the displacement; if this happens twice, the load factor
  is unbounded.
* A support settles. It is fixed in the gravity step, whose reaction is added to the dead load; λ of the path counts
  from there. The greatest λ is the least reaction, and the path does not end when λ falls.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.program.program import Program
from mbla.program.reductions.restrict import ChosenPart
from mbla.program.stiffness_shares import shares_of
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.flow.followed import AtRest, Followed, as_it_gives_way, followed, measured_by_itself
from mbla.solution.flow.gravity_step import Gravity, gravity_step
from mbla.solution.flow.path_record import RISES, ElasticPath, Stop
from mbla.solution.flow.peak_step import EXACT, solved_peak
from mbla.solution.flow.settings import RATIOS, PathSettings
from mbla.solution.flow.unit_of_displacement import Measure, elastic_motion, mean_live_load, measure_of
from mbla.solution.law.elastic_joints import ElasticJoints
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.nonassociative.moving_part import moving_part
from mbla.solution.solution import Status
from mbla.solution.thresholds import NEAR_ZERO

NEGLIGIBLE = 1e-9
"""Load factor over the part's own unit that is none."""


@dataclass(frozen=True)
class Extent:
    """How much of a part is followed: what moves by associative flow and what is near it, or the whole.

    besides : (n_rows,) rows that are followed as if they moved; None for no others
    """

    whole: bool = False
    besides: BoolArray | None = None


WHAT_MOVES = Extent()


@dataclass(frozen=True)
class PathOfPart:
    """What was followed.

    stop    : why it ended, or why nothing was followed
    path    : of the program, or of what moves in it; None where nothing was followed
    rest    : where it began; None where no joint holds the part
    paths   : how many were followed: more than one where it was lost, is at the limit of standing, or has no measure
    factorizations : spent on all of it
    """

    stop: Stop
    path: ElasticPath | None = None
    rest: AtRest | None = None
    paths: int = 0
    factorizations: int = 0

    @property
    def lets_rest(self) -> bool:
        """Whether only what moves was followed."""
        return self.rest is not None and self.rest.part is not None

    @property
    def is_answer(self) -> bool:
        """Whether it starts to move at the load factor, which is not only how far the path came."""
        return self.stop.answers and not math.isnan(self.load_factor)

    @property
    def load_factor(self) -> float:
        """λ_p, of the program; inf where nothing moves, nan where it does not stand or no step counts."""
        if self.stop in (Stop.UNLOADED, Stop.UNBOUNDED):
            return math.inf
        if self.stop is Stop.AT_ONCE:
            return 0.0
        return self._from_rest(None if self.path is None else self.path.load_factor)

    @property
    def moving(self) -> float:
        """Load factor at the end of the path, while it moves, λ_p at most; nan without a path."""
        return self._from_rest(None if self.path is None else min(self.path.moving, self.path.load_factor))

    @property
    def displacement(self) -> float:
        """D at λ_p; nan without."""
        return math.nan if self.path is None or self.path.peak is None else self.path.peak.displacement

    @property
    def gain(self) -> float:
        """Share of λ_p that was gained over the last half of the path."""
        return 0.0 if self.path is None else self.path.gain

    def gains(self, share: float, above: float) -> bool:
        """Whether more than a share was gained over the last half of a path that ends before the load does.

        Of a load factor that is next to nothing no share counts.

        above : load factor that it cannot exceed; from there it rises no more
        """
        if self.rest is None or self.stop is not Stop.FAR or not self.gain > share:
            return False
        nothing = NEAR_ZERO * self.rest.joints.program.dead_over_live
        return nothing < self.load_factor < (1.0 - RISES) * above

    def _from_rest(self, of_path: float | None) -> float:
        return math.nan if of_path is None or self.rest is None else self.rest.begins + of_path


def path_of_part(
    program: Program,
    associative: AssociativeResult,
    settings: PathSettings,
    dilatancy: FloatArray | None = None,
    interfaces: Interfaces = NONE,
    *,
    extent: Extent = WHAT_MOVES,
) -> PathOfPart:
    """The path of a part, or of what moves in it by associative flow.

    dilatancy  : (n_points,) tangents of its angles; default: none
    interfaces : of the model that have a law of their own
    extent     : how much of it is followed
    """
    settings.validate()
    if program.n_points == 0:  # held by guides alone, or by nothing
        return PathOfPart(Stop.DOES_NOT_STAND if np.any(program.dead_load) else Stop.UNDECIDED)
    state = associative.state
    part = None
    if state is not None and not extent.whole:
        v = state.velocities
        moves = v if extent.besides is None else np.where(extent.besides, np.abs(v).max(initial=0.0), v)
        part = moving_part(program, moves, settings)
    known, before = None if state is None else state.load_factor, associative.stress_free
    same = part is None and dilatancy is None and interfaces is NONE and settings.ratio == RATIOS[0]
    gravity = before.gravity if before is not None and same and np.any(program.dead_load) else None
    found = path_by(program, known, settings, dilatancy, interfaces, part, gravity)
    falls = associative.status is Status.NO_EQUILIBRIUM
    return PathOfPart(Stop.DOES_NOT_STAND, rest=found.rest, factorizations=found.factorizations) if falls else found


def path_by(
    program: Program,
    associative: float | None,
    settings: PathSettings,
    dilatancy: FloatArray | None = None,
    interfaces: Interfaces = NONE,
    part: ChosenPart | None = None,
    gravity: Gravity | None = None,
) -> PathOfPart:
    """The path of a program by its load factor of associative flow, None where it has none.

    part    : the part that is followed; default: the whole
    gravity : the structure at rest, where that is known

    Raises ValueError where joints dilate and interfaces twist: what torsion opens is not known.
    """
    if interfaces.twisting is not None and dilatancy is not None and np.any(dilatancy):
        raise ValueError("torsion of interfaces goes with joints without dilatancy")
    rows = interfaces.rows_of(program)
    whole = ElasticJoints.of(program, shares_of(program), settings.ratio, dilatancy, rows)
    scale = program.own_unit if associative is None else associative
    joints = whole if part is None else _of_moving(part, whole, interfaces)
    rest = _at_rest(joints, scale, settings, part) if gravity is None else AtRest(joints, gravity, settings)
    ends = _ends_at_rest(rest, program, associative)
    if ends is not None:
        return PathOfPart(ends, rest=rest, factorizations=rest.gravity.steps)
    if program.facts.settling_support:
        rest, scale = as_it_gives_way(rest, (program if part is None else part.program).own_unit)
    elif associative is None:
        return _record(measured_by_itself(rest, scale), rest)
    measure = measure_of(rest.joints, scale, rest.pressed)
    if part is not None:
        rest, measure = _in_units_of(whole, part, rest, measure)
    return _record(followed(rest, measure), rest)


def _record(found: Followed, rest: AtRest) -> PathOfPart:
    spent = sum(path.factorizations - rest.gravity.steps for path in found.paths) + rest.gravity.steps
    path, peak = found.path, found.path.peak
    if rest.joints.laws and peak is not None:  # while it was followed less was enough
        sharp, more = solved_peak(peak, rest.gravity.force, lambda found: found.misfit <= EXACT)
        path, spent = replace(path, peak=sharp), spent + more
    return PathOfPart(found.stop, path, rest, len(found.paths), spent)


def _at_rest(joints: ElasticJoints, scale: float, settings: PathSettings, part: ChosenPart | None) -> AtRest:
    """Under the dead load."""
    program = joints.program
    if program.facts.settling_support or not np.any(program.dead_load):  # the live load counts
        return AtRest(joints, gravity_step(joints, mean_live_load(program, scale)), settings, part)
    return AtRest(joints, gravity_step(joints.without_live_load), settings, part)


def _ends_at_rest(rest: AtRest, program: Program, associative: float | None) -> Stop | None:
    """Why no path begins there; None where one does."""
    if not rest.gravity.settled:
        return Stop.UNDECIDED
    if not rest.gravity.carried:
        return Stop.DOES_NOT_STAND
    if not np.any(program.live_load):
        return Stop.UNLOADED
    if associative is not None and not program.facts.settling_support and associative <= NEGLIGIBLE * program.own_unit:
        return Stop.AT_ONCE
    return None


def _of_moving(part: ChosenPart, whole: ElasticJoints, interfaces: Interfaces) -> ElasticJoints:
    """Joints of what moves, as stiff as in the whole."""
    points = part.points
    ratio = float(whole.shear[0] / whole.normal[0])
    rows = interfaces.rows_of(part.program)
    return ElasticJoints.of(part.program, whole.normal[points], ratio, whole.dilatancy[points], rows)


def _in_units_of(whole: ElasticJoints, part: ChosenPart, rest: AtRest, own: Measure) -> tuple[AtRest, Measure]:
    """What moves, measured by displacements of the whole."""
    pressed: BoolArray = np.ones(whole.program.n_points, dtype=np.bool_)
    pressed[part.points] = rest.pressed
    unit = float(whole.program.live_load @ elastic_motion(whole, pressed)) * own.load_factor
    settings, (share, _) = rest.settings, rest.settings.smoothed
    first = settings.first * min(1.0, 2.0 * own.displacement / unit)
    settings = replace(settings, first=first, smoothed=(share, np.inf), steps=settings.steps_of_part)
    return replace(rest, settings=settings), replace(own, displacement=unit)
