"""The contract of a question: the figure that answers a load case, from the load factor λ that is solved for.

Every analysis finds λ with proved bounds, static ≤ λ ≤ kinematic by associative flow. What a load case asks is λ itself
or a figure f(λ): the reaction of a support, a force, an angle. All that results say of it, they ask here.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import ClassVar, Protocol, Self, TypeVar

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.units import Units
from mbla.questions.figures import significant
from mbla.questions.travel_position import NOWHERE, TravelPosition

Record = TypeVar("Record")
ZERO = 1e-3
"""Share of dead over live load, and of the unit of a reaction: smaller figures are compared as if they were that."""


class Question(Protocol):
    """One figure that a load case asks for. What is given here holds for most; a question overrides what differs.

    Which figure, and where results have it

    name   : of the question
    group  : of results: ``load_factor``, ``reaction``, ``angle``; the key of what a deck expects
    paths  : in the record of a load case, of the figure and its lower and upper bound
    place  : where a travelling load stands

    What holds of it

    unbounded_answers : that no λ is the greatest answers the question too
    decided_by        : flow rules by which it is decided that there is no such λ, without forces that show it
    multiplies        : λ multiplies a live load, and one near zero may be so by the rounding of loads alone
    rounding_told     : its words say how much that may be
    collapses         : the state at λ is one of collapse; not where a force is sought through a structure at rest
    tilts             : gravity turns, as on a tilting table

    Words

    entries_first  : its entries in a listing stand before the load factors, else below the own one
    title          : head of its column, without the unit
    applied        : what the load that λ multiplies is or does: ``live load``, ``gives way``
    factors        : many of them
    control        : the point whose displacement a pushover has
    powers         : of what λ multiplies and of the dead load, in the energy balance
    no_equilibrium : the dead load alone is not carried
    no_target      : why no parameter is looked for that gives it a value, after the name of its load case
    no_safety      : why there is no geometric factor of safety
    """

    name: ClassVar[str]
    group: ClassVar[str] = "load_factor"
    paths: ClassVar[tuple[str, str, str]] = ("load_factor", "static_bound", "kinematic_bound")
    place: TravelPosition = NOWHERE
    unbounded_answers: ClassVar[bool] = False
    decided_by: ClassVar[tuple[str, ...]] = ("associative", "non_associative")
    multiplies: ClassVar[bool] = True
    rounding_told: ClassVar[bool] = False
    collapses: ClassVar[bool] = True
    tilts: ClassVar[bool] = False
    entries_first: ClassVar[bool] = True
    title: ClassVar[str]
    applied: ClassVar[str] = "live load"
    factors: ClassVar[str] = "load factors"
    control: ClassVar[str] = "control point"
    powers: ClassVar[tuple[str, str]] = ("live load", "dead load")
    no_equilibrium: ClassVar[str] = "no equilibrium: the structure cannot carry its dead load"
    no_target: ClassVar[str] = ""
    no_safety: ClassVar[str] = ""

    # --- what it is about -------------------------------------------------------------------------------------------

    def record(self, kind: type[Record]) -> Record | None:
        """What it needs of that kind; None where that belongs to another question."""
        return next((each for each in vars(self).values() if isinstance(each, kind)), None)

    @property
    def measured(self) -> tuple[bytes | float, ...]:
        """What a load cell measures, and in which unit, by values that can be compared."""
        return ()

    def on_bodies(self, body: IntArray, loads: Callable[[FloatArray], FloatArray], always: FloatArray | float) -> Self:
        """Of rigid bodies: ``body`` of each block, ``loads`` on them from loads on blocks, what acts ``always``."""
        return self

    # --- the figure -------------------------------------------------------------------------------------------------

    @property
    def kind(self) -> str:
        """Kind of its unit: ``1``, ``force``, ``moment``, ``degree``."""
        return "1"

    @property
    def column(self) -> str:
        """Name of its column in tables of load cases."""
        return self.group

    @property
    def series(self) -> str | None:
        """Load case in the deck that became one for each position or end; None where it is one."""
        return self.place.series or None

    @property
    def giving_way(self) -> IntArray:
        """Blocks whose support gives way, (m,)."""
        return np.zeros(0, dtype=np.int64)

    @property
    def ways(self) -> FloatArray:
        """How they move, (m, 6): velocity and angular velocity about the centroid of each, all in one motion."""
        return np.zeros((0, 6))

    @property
    def scale(self) -> float:
        """By how much the figure changes with λ, of which it counts as zero what is little; 1 of λ itself."""
        return 1.0

    @property
    def unlimited(self) -> float:
        """The figure where no λ is the greatest."""
        return math.inf

    def value(self, load_factor: float) -> float:
        """The figure that λ stands for, in the deck's units; nan where it stands for none."""
        ...

    def stated(self, load_factor: float) -> float:
        """The figure of the λ that is a result."""
        return self.value(load_factor)

    def shown(self, value: float) -> float:
        """A figure as it is written: zero where it is one but for rounding."""
        return value

    def bounds(self, static: float, kinematic: float, mechanism: FloatArray | None) -> tuple[float, float]:
        """Lower and upper bound of the figure, nan where nothing is proved.

        static, kinematic : of λ, by associative flow
        mechanism         : (n_blocks, 6) that proves the kinematic one; None without associative flow
        """
        ...

    def by_proof(self, bounds: tuple[float, float]) -> tuple[float, float]:
        """Its bounds as columns of the static and of the kinematic bound have them."""
        return bounds

    def compared(self, load_factor: float) -> float:
        """By what two load factors of a case are compared: λ, or the figure where that can be zero for any λ."""
        return load_factor

    def least_factor(self, ratio: float) -> float:
        """The smallest λ that means something, from the ratio of dead over live load: smaller ones count as that."""
        return ZERO * ratio

    def least(self, ratio: float) -> float:
        """The smallest figure that means something."""
        return self.least_factor(ratio) * self.scale

    @property
    def by_steps(self) -> bool:
        """Whether a sequence of analyses finds the figure, and other λ stand for none."""
        return False

    # --- pushovers ----------------------------------------------------------------------------------------------------

    def pushed(self, live_load: FloatArray) -> FloatArray:
        """The loads, (n_blocks, 6), that a pushover scales, from those that λ multiplies."""
        return live_load

    def followed(self, load_factor: float) -> float:
        """What a pushover follows in the place of λ, where it is λ at first."""
        return load_factor

    def value_at(self, followed: float) -> float:
        """The figure that belongs to what a pushover follows."""
        return self.value(followed)

    def loads_at(self, dead: FloatArray, live: FloatArray, followed: float) -> tuple[FloatArray, ...]:
        """Dead load, live load per unit of what is followed, change of their sum with it; from those of the case."""
        return dead, live, live

    # --- words --------------------------------------------------------------------------------------------------------

    def unit(self, units: Units) -> str:
        """``N``, ``N m``, ``degree``; empty of λ."""
        return {"1": "", "force": units.force, "moment": f"{units.force} {units.length}"}.get(self.kind, self.kind)

    def head(self, units: Units) -> str:
        """Head of its column: ``reaction [N]``."""
        unit = self.unit(units)
        return f"{self.title} [{unit}]" if unit else self.title

    def told(self, value: float, units: Units) -> str:
        """The figure in words: ``a reaction of 5232 N``."""
        ...

    def factor_words(self, load_factor: float, units: Units) -> str:
        """λ in words, as the figure that it stands for."""
        return self.told(self.shown(self.value(load_factor)), units)

    def moves(self, *, by_path: bool) -> str:
        """What the structure does at λ; ``by_path``: found on the path of elastic joints, which goes on."""
        return "starts to move" if by_path else "collapses"

    @property
    def what(self) -> str:
        """The figure by its name in a sentence, ``least force``."""
        return self.title

    @property
    def unbounded(self) -> str:
        """That no λ is the greatest."""
        return "no collapse: no multiple of the live load brings the structure down"

    def limited(self, words: str) -> str:
        """What the kinematic bound proves, from it in words."""
        return f"it collapses at no more than {words} (kinematic bound, valid for every flow rule)"

    def entries(self, value: float, bounds: tuple[float, float], units: Units) -> tuple[tuple[str, str], ...]:
        """Names and figures that the listing has of it besides its load factors; nan: no result.

        bounds : as columns of the static and the kinematic bound have them
        """
        return ()

    @property
    def no_sensitivity(self) -> str:
        """Why λ has no derivative by a parameter; empty where it may have one."""
        return ""

    @property
    def forces_drawn(self) -> str:
        """Which contact forces are drawn."""
        return "contact forces under dead load and live load times load factor"


def interval(bounds: tuple[float, float]) -> str:
    """``8753.8491 .. 8753.8521``, eight digits."""
    return " .. ".join(significant(bound, 8) for bound in bounds)
