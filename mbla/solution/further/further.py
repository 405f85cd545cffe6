"""What is asked besides the load factor: each result has a record of its own, and is verified by itself.

No further result changes load factor, status or mechanism: what finds one gives its record and remarks, which are put
beside the answer (``Solution.with_further``).
"""

from __future__ import annotations

from dataclasses import dataclass, field

from mbla.solution.further.geometric_safety.geometric_safety import GeometricSafety
from mbla.solution.further.sensitivity.slopes import Slope
from mbla.solution.further.soil_range.soil_path import SoilPath
from mbla.solution.modes.modes import NO_MODES, Modes
from mbla.solution.pushover.pushover import NOT_PUSHED, Pushover
from mbla.solution.time_history.history import NO_HISTORY, TimeHistoryResult


@dataclass(frozen=True)
class Further:
    """Further results of one load case.

    pushover         : the structure as it moves on; without rows where none was asked for, or could be done
    sensitivity      : slopes of the associative load factor, by the parameters that the deck asks for
    geometric_safety : of the dead load alone; None without
    time_history     : the structure in time; without rows where none was asked for
    soil_range       : paths on which soil of cells slides with little dilatancy and with much; empty without
    modes            : of vibration about the state at rest; none where not asked for, or with the reason
    modes_after      : the same about the state that a time history leaves
    """

    pushover: Pushover = NOT_PUSHED
    sensitivity: tuple[Slope, ...] = ()
    geometric_safety: GeometricSafety | None = field(default=None, compare=False)
    soil_range: tuple[SoilPath, ...] = ()
    time_history: TimeHistoryResult = NO_HISTORY
    modes: Modes = field(default=NO_MODES, compare=False)
    modes_after: Modes = field(default=NO_MODES, compare=False)


NOTHING_FURTHER = Further()
