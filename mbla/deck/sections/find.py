"""Section `find`: the value of a parameter at which a result is a target."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from mbla.deck.quantities import Integer, Line, Name, Number, PositiveLength, RealNumber, Switch
from mbla.deck.section import EXACTLY_ONE, Section, one_of, rule
from mbla.errors import Finding

MOST_STEPS = 1000
"""of a scan"""
TOLERANCE, IN_TIME = 1e-6, 1e-3
"""of the value that is found, relative, unless the deck says otherwise; of a structure in time, which no value is known
better of: each costs a time history, and the next digits are those of its steps"""


class TargetSection(Section):
    """Target of the result; one of these keys."""

    load_factor: Number | None = Field(None, description="load factor, by the flow rule of the analysis")
    least_load_factor: Number | None = Field(
        None, description="the smaller of the load factor and the least that a search finds"
    )
    stands: Switch | None = Field(
        None,
        description="true: the limit at which the dead load is just carried, whatever the live load; measured by the "
        "greatest uniform pressure in all joints, as of water, that is carried with it: 0 at the limit",
    )
    falls: Switch | None = Field(
        None,
        description="true: where a block of a load case with time_history begins to fall, as over its scale; "
        "a history that ends while it still moves tells nothing of that",
    )
    peak: PositiveLength | None = Field(
        None, description="greatest displacement of a block in a load case with time_history; what falls is above it"
    )


EXACTLY_ONE[TargetSection] = tuple(TargetSection.model_fields)  # its rule is that of ``find``: its faults come together


class FindSection(Section):
    """Question of `mbla find`; options of the command replace these keys. `mbla run` ignores the section."""

    parameter: Line = Field(description="key path of a real number in the deck, as `--set` takes it")
    target: TargetSection = Field(description="what the result should be")
    bounds: tuple[Number, Number] = Field(description="least and greatest value, in the deck's units")
    load_case: Name | None = Field(
        None, description="load case whose result is looked at; needed where there are several"
    )
    scan: Annotated[int, Integer(ge=1, le=MOST_STEPS)] = Field(
        1, description="equal steps from bound to bound, each of which is solved: more than 1 finds several values"
    )
    first: Switch = Field(
        False,
        description="the first value alone, upwards from the lower bound: the scan ends with the step that has it",
    )
    tolerance: Annotated[float, RealNumber("number", gt=0, le=0.1)] | None = Field(
        None,
        description=f"tolerance of the value, relative to the larger of the bounds; default: {TOLERANCE:g}, of a "
        f"structure in time {IN_TIME:g}",
    )


SWITCHES = {"stands": "just stands", "falls": "begins to fall"}
"""targets without a figure"""


@rule(FindSection)
def find(section: FindSection) -> Iterator[Finding]:
    """There is one target, bounds are in order, and a switch is on."""
    yield from (each.below("target") for each in one_of(section.target, EXACTLY_ONE[TargetSection]))
    least, greatest = section.bounds
    if not least < greatest:
        yield Finding("out-of-bounds", f"must be > {least:g}, the other bound", "bounds", 1)
    for key, what in SWITCHES.items():
        if getattr(section.target, key) is False:
            yield Finding("wrong-value", f"must be true: a value at which it {what} is looked for", "target", key)
