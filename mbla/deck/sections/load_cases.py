"""Section `load_cases`: loads that stay, loads that the load factor multiplies, and settling supports."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, TypeAlias

from pydantic import ConfigDict, Field

from mbla.deck.kinds.load_key import live_only
from mbla.deck.quantities import Direction, Integer, Number, PositiveLength
from mbla.deck.section import ByShape, Section, exactly_one_of, given, one_of, rule
from mbla.deck.sections.assessment import AssessmentSection
from mbla.deck.sections.loads import Load
from mbla.deck.sections.objective import ObjectiveSection
from mbla.deck.sections.selectors import Selector
from mbla.deck.sections.supports import Turn
from mbla.deck.sections.time_history import IN_TIME, TimeHistorySection, alone_in_time, given_in_time
from mbla.deck.suggestions import listed
from mbla.errors import Finding

STEPS_OF_TWICE_THE_SIZE = (
    "make steps of twice the size as well, which takes half as long again: the difference is the error of each load "
    "factor, to first order, and of the end of the curve; without these steps the errors are not known"
)

ASKED = ("live", "settlement", "objective", *IN_TIME)
"""Keys of a load case that ask its question; it has at least one of them."""


@exactly_one_of("direction", "turn")
class SettlementSection(Section):
    """A settling support: blocks that `supports` fixes move as one rigid body, along one admissible motion."""

    on: Selector = Field(description="the blocks that give way; `supports` fixes them otherwise")
    direction: Direction | None = Field(
        None,
        description="direction of the motion: [0, 0, -1] for a support that sinks, horizontal for one that spreads",
    )
    turn: Turn | None = Field(None, description="in place of direction: the line about which the support turns")
    amount: PositiveLength | None = Field(
        None,
        description="displacement up to which the reaction is followed as the structure moves, until nothing "
        "carries it any more; with direction. Default: only the first movement. Of several supports all have an "
        "amount or none: they move in proportion to their amounts, without amounts equally far",
    )
    step: PositiveLength | None = Field(None, description="displacement in a step; default: a fiftieth of amount")
    error: bool = Field(True, description=STEPS_OF_TWICE_THE_SIZE)


Settlements: TypeAlias = Annotated[
    SettlementSection | Annotated[list[SettlementSection], Field(min_length=1, max_length=1000)], ByShape("mapping")
]
"""One settling support, or several in proportion."""


class ControlSection(Section):
    """Control point of a pushover, whose displacement is counted."""

    on: Selector | None = Field(
        None,
        description="blocks whose common centre of mass is followed; default: live-load centre on the initial "
        "mechanism",
    )
    direction: Direction | None = Field(
        None,
        description="direction in which the displacement counts; default: that of the live load on the initial "
        "mechanism",
    )


class PushoverSection(Section):
    """Finite displacements after the first movement: their steps and their end."""

    step: PositiveLength = Field(description="displacement of the control point in a step")
    until: PositiveLength | None = Field(
        None, description="displacement at the end; default: where the load factor reaches its end"
    )
    until_load_factor: Number | None = Field(
        None,
        description="load factor at the end, as it falls; default: 0. Below 0 the curve goes on with the load "
        "factors that hold back a structure that would fall by itself",
    )
    steps: Annotated[int, Integer(ge=1, le=100_000)] = Field(500, description="most steps")
    error: bool = Field(True, description=STEPS_OF_TWICE_THE_SIZE)
    control: ControlSection = Field(
        default_factory=ControlSection, description="control point, whose displacement is counted"
    )
    position: Annotated[int, Integer(ge=1, le=1000)] | None = Field(
        None, description="with `travel`: the position at which the structure is pushed, from 1; default: the worst"
    )


class LoadCaseSection(Section):
    """Loads, and the question about them: dead loads are constant, live loads are multiplied by the load factor; or a
    support settles under the dead loads; or a force is looked for at a given load factor; or the structure moves in
    time.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "oneOf": [
                {"required": ["settlement"]},
                {"anyOf": [{"required": ["live"]}, {"required": ["objective"]}]},
                {"required": ["time_history"]},
                {"required": ["modes"], "not": {"anyOf": [{"required": [key]} for key in ASKED[:-1]]}},
            ]
        }
    )

    dead: list[Load] | None = Field(
        None, description="loads besides gravity, which is 9.81 m/s^2 along -z unless a load `gravity` is among them"
    )
    live: list[Load] | None = Field(None, min_length=1, description="the loads that the load factor multiplies")
    settlement: Settlements | None = Field(
        None,
        description="in place of live: a settling support, or a list of several that settle together, each along "
        "its direction, in proportion to their amounts. The answer is the mechanism and the least reaction of the "
        "support that equilibrium allows; it is negative where the support must be pushed along, as springings that "
        "close in must. The load factor is the normalised loss of reaction: from that of the structure at rest, "
        "over the weight of the free blocks. Of several supports the reaction is the sum of their reactions, each "
        "against its direction and times its amount over the greatest amount: it does the work of all of them in "
        "the displacement of the one that goes furthest",
    )
    objective: ObjectiveSection | None = Field(
        None,
        description="in place of the load factor: the least and the greatest value of a force, over all forces in "
        "the joints that balance the loads within the strengths of the joints. Every state of the structure lies "
        "between the two, whatever its flow rule",
    )
    at: Number | None = Field(
        None,
        description="with objective and live: the load factor at which the force is looked for; without live the "
        "force is that under the dead loads",
    )
    pushover: PushoverSection | None = Field(
        None,
        description="after limit analysis: the load factor as the structure moves by finite displacements, step by "
        "step; loads keep their direction. With `tilt` the angle of the table, with `travel` at one position",
    )
    assessment: AssessmentSection | None = Field(
        None,
        description="verdict of a code on the mechanism that a horizontal acceleration of all blocks brings about; "
        "with `pushover` by displacements too",
    )
    time_history: TimeHistorySection | None = Field(
        None, description="in place of live: the structure in time, as its base moves or forces act on it"
    )
    modes: Annotated[int, Integer(ge=1, le=1000)] | None = Field(
        None,
        description="how many modes of vibration are sought at the state of rest under the dead loads, with their "
        "periods and participating masses; with time_history also about the state that it leaves; in place of live, "
        "or beside whatever else is asked",
    )


@rule(SettlementSection)
def followed_settlement(settlement: SettlementSection) -> Iterator[Finding]:
    """What is followed slides, and has an end."""
    if settlement.amount is not None and settlement.direction is None:
        yield Finding("settlement-not-followed", "goes with direction: a turn is not followed", "amount")
    if settlement.amount is None and (settlement.step is not None or "error" in settlement.model_fields_set):
        key = "error" if settlement.step is None else "step"
        yield Finding("settlement-not-followed", "goes with amount, how far the support is followed", key)


def supports_of(section: LoadCaseSection) -> list[SettlementSection]:
    """The settling supports of a load case."""
    if section.settlement is None:
        return []
    return section.settlement if isinstance(section.settlement, list) else [section.settlement]


@rule(LoadCaseSection)
def several_settlements(case: LoadCaseSection) -> Iterator[Finding]:
    """Supports that settle together slide, all with an amount or none, by one step."""
    supports = supports_of(case)
    if len(supports) < 2:
        return
    amounts = [support.amount for support in supports]
    for number, support in enumerate(supports):
        if support.turn is not None:
            words = "cannot be one of several settling supports in proportion: give each a direction"
            yield Finding("settlement-not-followed", words, "settlement", number, "turn")
        if support.amount is None and any(amount is not None for amount in amounts):
            words = "needs amount, as the other supports have: the amounts are their proportion"
            yield Finding("missing-key", words, "settlement", number)
    for key in ("step", "error"):
        for number in [row for row, support in enumerate(supports) if key in support.model_fields_set][1:]:
            words = "is given once: the other supports go on in proportion"
            yield Finding("one-of-several", words, "settlement", number, key)


@rule(LoadCaseSection)
def what_is_asked(case: LoadCaseSection) -> Iterator[Finding]:
    """A load factor, a settlement, a force or motion in time, and what goes with it."""
    if given_in_time(case):
        yield from alone_in_time(case)
        return
    if case.objective is None:
        if given(case, ("live", "settlement")):
            yield from one_of(case, ("live", "settlement"))
        else:
            yield Finding("missing-key", f"needs one of {listed(ASKED)}")
        if case.at is not None:
            yield Finding("key-of-another-choice", "applies with objective only", "at")
        return
    if case.live is not None and case.at is None:
        yield Finding("missing-key", "needs at, the load factor of its live loads at which the force is sought")
    if case.live is None and case.at is not None:
        yield Finding("key-of-another-choice", "applies with live only: there is nothing to multiply", "at")
    for key in given(case, ("settlement", "pushover", "assessment")):
        words = "cannot go with objective, whose answer is a force: make another load case of it"
        yield Finding("objective-not-possible", words, key)
    for number, load in enumerate(case.live or []):
        if load.facts.live_only:
            words = "cannot go with objective, which is sought at one place of each load: give it as force"
            yield Finding("objective-not-possible", words, "live", number, load.kind)


@rule(LoadCaseSection)
def load_case(case: LoadCaseSection) -> Iterator[Finding]:
    """What tilts or travels is live, and there is one of it."""
    for number, load in enumerate(case.dead or []):
        if load.facts.live_only:
            yield Finding("load-misplaced", "must be a live load", "dead", number, load.kind)
    if case.pushover is not None and not given_in_time(case):
        yield from _not_pushed(case)
    if case.assessment is not None and not given_in_time(case):
        yield from _not_assessed(case, case.assessment)
    live = list(enumerate(case.live or []))
    special = [(number, load.facts) for number, load in live if load.facts.live_only]
    for number, kind in special[1:]:
        words = f"only one of {listed(live_only(), 'and')} in a load case: make another load case"
        yield Finding("one-of-several", words, "live", number, kind.name)
    if len(special) == 1 and len(live) > 1 and (why := special[0][1].alone):
        other = next(number for number, _ in live if number != special[0][0])
        words = f"cannot go with {special[0][1].name}, {why}: make it a dead load"
        yield Finding("load-misplaced", words, "live", other)


def _not_pushed(case: LoadCaseSection) -> Iterator[Finding]:
    if case.live is None:
        words = "goes with live loads: a settling support is followed by its own amount"
        yield Finding("pushover-not-possible", words, "pushover")
    asked = None if case.pushover is None else case.pushover.position
    if asked is None:
        return
    counts = [load.chosen.positions for load in case.live or [] if load.kind == "travel"]
    if not counts:
        words = "goes with a load that travels: leave it out"
        yield Finding("key-of-another-choice", words, "pushover", "position")
    elif asked > counts[0]:
        words = f"must be <= {counts[0]}, the positions of the load that travels"
        yield Finding("out-of-bounds", words, "pushover", "position")


def _not_assessed(case: LoadCaseSection, assessment: AssessmentSection) -> Iterator[Finding]:
    live = case.live or []
    single = len(live) == 1 and live[0].kind == "acceleration" and live[0].on is None and live[0].pattern is None
    if not single or live[0].chosen[2] != 0.0:
        words = "needs one live load, a horizontal acceleration of all blocks, without on and pattern"
        yield Finding("assessment-not-possible", words, "assessment")
    if assessment.spectra.SLC is not None and case.pushover is None:
        words = "needs pushover: near collapse is a question of displacements"
        yield Finding("assessment-not-possible", words, "assessment", "spectra", "SLC")
