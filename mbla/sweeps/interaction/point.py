"""One point of a diagram: what the structure answers at one angle."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from mbla.solution.solution import Status
from mbla.sweeps.interaction.angles import unit_vector
from mbla.sweeps.plan import DONE, Outcome

RESULTS = (
    "status",
    "verified",
    "load_factor",
    "associative_load_factor",
    "static_bound",
    "kinematic_bound",
    "standing.verdict",
    "mechanism.class",
)
"""what of the record of a load case a diagram is made from, beside the powers of a pair of loads"""
POWER = "powers."
NAN = math.nan


@dataclass(frozen=True)
class Point:
    """The answer at an angle in degrees.

    answered     : verified: there is a load factor, or it is verified that there is none
    exit_code    : that a run of this point alone ends with
    status       : of the load case; empty where it was not solved at all
    load_factor  : by the deck's flow rule, nan where there is none
    associative  : by associative flow, with its bounds; nan where there are none
    standing     : verdict on the dead load alone; empty where there is none
    mechanism    : class of the mechanism in a word; empty where there is none
    powers       : of live loads in the mechanism of the kinematic bound, by load case
    reason       : in one line, empty where there is nothing to say
    """

    angle: float
    answered: bool
    exit_code: int
    status: str
    load_factor: float
    associative: float
    static_bound: float
    kinematic_bound: float
    standing: str = ""
    mechanism: str = ""
    powers: Mapping[str, float] = field(default_factory=dict)
    reason: str = ""
    seconds: float = NAN

    @property
    def has_factor(self) -> bool:
        """Whether a verified load factor is there."""
        return self.answered and not math.isnan(self.load_factor)

    @property
    def unbounded(self) -> bool:
        """Whether it is verified that the load never brings collapse."""
        return self.answered and self.status == Status.UNBOUNDED

    def at(self, factor: float) -> tuple[float, float]:
        """Coordinates in the diagram at a load factor on this ray."""
        cosine, sine = unit_vector(self.angle)
        return factor * cosine, factor * sine


def point_of(angle: float, outcome: Outcome) -> Point:
    """The point that an outcome is."""
    results: Mapping[str, Any] = outcome.results

    def figure(name: str) -> float:
        value = results.get(name)
        return NAN if value is None else float(value)

    return Point(
        angle=angle,
        answered=outcome.state == DONE,
        exit_code=outcome.exit_code,
        status=results.get("status") or "",
        load_factor=figure("load_factor"),
        associative=figure("associative_load_factor"),
        static_bound=figure("static_bound"),
        kinematic_bound=figure("kinematic_bound"),
        standing=results.get("standing.verdict") or "",
        mechanism=results.get("mechanism.class") or "",
        powers={
            name.removeprefix(POWER): float(value)
            for name, value in results.items()
            if name.startswith(POWER) and value is not None
        },
        reason=" ".join(outcome.reason.split()),
        seconds=outcome.seconds,
    )
