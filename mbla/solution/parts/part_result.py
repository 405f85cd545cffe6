"""What was found for one part of a structure, whose blocks can interact."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.nonassociative.collapse_state import CollapseState, FlowResult
from mbla.solution.nonassociative.torsion import WithTorsion
from mbla.solution.solution import ProgramRecord, StandingResult, Status


@dataclass(frozen=True)
class PartResult:
    """What was found for one part.

    associative : by the associative flow rule
    flow        : by the flow rule of the analysis where that is another one, None where it was not reached
    loaded      : false where no live load acts on the part; then it only has to carry its dead load
    standing    : assessment of the dead load alone, None where it was not asked for
    torsion     : of a path with torsion of uniform pressure, None where none was followed
    least       : state of the least load factor that a search found, None where none ran or it came to none
    remarks     : on the figure, besides those of the flow
    more        : programs solved for what is found in addition to the load factor
    """

    program: Program
    associative: AssociativeResult
    flow: FlowResult | None
    loaded: bool
    standing: StandingResult | None = None
    torsion: WithTorsion | None = None
    least: CollapseState | None = None
    remarks: tuple[Message, ...] = ()
    more: tuple[ProgramRecord, ...] = ()

    @property
    def state(self) -> CollapseState | None:
        """Of the flow rule of the analysis."""
        return self.associative.state if self.flow is None else self.flow.state

    @property
    def status(self) -> Status:
        """Of the flow rule of the analysis.

        Residuals speak for a state of another flow rule than the associative one, whose proved kinematic bound holds
        however far the static one is from it; what another solver contradicts stays contradicted.
        """
        if self.flow is None or (self._doubted and self.flow.status is Status.SOLVED):
            return self.associative.status
        return self.flow.status

    @property
    def _doubted(self) -> bool:
        """Whether more is open about the associative load factor than how far its bounds are apart."""
        associative = self.associative
        return associative.state is not None and associative.status is not Status.SOLVED and not associative.gap_words

    @property
    def reason(self) -> str:
        """Why the part is not plainly solved."""
        if self.flow is None:
            return self.associative.reason
        return self.flow.reason or ("" if self.associative.gap_words else self.associative.reason)

    @property
    def tolerance_requested(self) -> float | None:
        """Gap that was asked for, and reached, where the part is approximate for no other reason."""
        return self.associative.tolerance_requested if self.flow is None else None

    @property
    def programs(self) -> tuple[ProgramRecord, ...]:
        """All cone programs that were solved for it."""
        own = self.associative.programs if self.flow is None else self.flow.programs
        return (*own, *self.more)
