"""The load that a structure reaches by elastic joints, where other figures without dilatancy are in doubt.

Forces and a mechanism may fit the law of rigid joints at loads far apart, where the structure stands at its limit, or
where the load falls as it moves. Elastic joints lead from the dead load to one load (:mod:`.elastic_path`), and the
forces there balance it within the yield conditions, as statics can show. The mechanism is that of the last step: next
to what the joints still give it fits the law of rigid ones roughly, and is not claimed to.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mbla.program.program import Program
from mbla.solution.associative.repair import repaired_forces
from mbla.solution.flow.path_of_part import PathOfPart, path_by
from mbla.solution.flow.path_record import RISES, Stop
from mbla.solution.flow.settings import PathSettings
from mbla.solution.nonassociative.law_state import LawState, law_state

BOTH = (0.4, 1.0)
"""Ratios of shear to normal stiffness that are held against each other where a figure hangs on them."""


@dataclass(frozen=True)
class Reached:
    """A state at the greatest load of a path.

    rises : whether the load still rises where the path ends, so that it is not the end of what is carried
    """

    state: LawState
    rises: bool

    @property
    def load_factor(self) -> float:
        """Of the program."""
        return self.state.load_factor


def least_reached(program: Program, associative: float, ratios: Sequence[float] = BOTH) -> Reached | None:
    """The state at the least load reached with joints of some ratios of stiffness; None where one has no answer.

    associative : load factor of associative flow
    """
    found = [_reached(program, path_by(program, associative, PathSettings(ratio=ratio))) for ratio in ratios]
    known = [each for each in found if each is not None]
    return min(known, key=lambda each: each.load_factor) if len(known) == len(found) else None


def _reached(program: Program, found: PathOfPart) -> Reached | None:
    """At the greatest load of a path that followed the whole; None where the path has no answer."""
    if found.path is None or found.path.peak is None or not found.is_answer:
        return None
    peak = found.path.peak
    forces, factor = peak.state.forces, peak.state.factor
    repaired = repaired_forces(program, forces, factor)
    if repaired is None:
        return None
    state = law_state(program, 0.0, repaired[0], peak.state.u, repaired[1])
    return Reached(state, found.stop is Stop.FAR and found.gain > RISES)
