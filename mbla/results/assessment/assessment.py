"""What a code says of a load case: every figure on the way with its article, and capacity over demand.

Kinematic blocks are the clusters of the mechanism, stones that move as one: P is the weight of each, δ the velocity of
its centre of mass along the live load. By single stones a wall that overturns would have e* = 3/4 in place of 1, and an
activation acceleration a third higher; both are shown. Added masses rest on their blocks and count in P, so that Q = 0.
alpha_0 is by the least load factor that was found, which may be that of other forces or of another mechanism.
Names, units and articles of the figures: ``figures.csv``.
"""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass, field, replace
from functools import cache
from importlib.resources import files
from itertools import pairwise

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import Contacts
from mbla.deck.section import given
from mbla.deck.sections.assessment import LIMIT_STATES, AssessmentSection, SpectrumSection
from mbla.deck.units import Units
from mbla.errors import Message
from mbla.model.model import Model
from mbla.results.assessment import codes
from mbla.results.assessment.kinematic_blocks import KinematicBlocks, kinematic_blocks_of
from mbla.results.assessment.spectra import (
    Floor,
    Spectrum,
    coefficients,
    damping_factor,
    floor_acceleration,
    floor_amplification,
    ground_acceleration,
    participation,
    spectrum_of,
)
from mbla.results.collapse.collapse import kept
from mbla.results.outcome import least_known, result_of, ultimate_displacement
from mbla.results.results import CaseResult
from mbla.solution.solution import Status
from mbla.solution.thresholds import SOLVED_RESIDUAL

OLD = "circolare_617_2009"
NAMES = {"ntc_2018": "NTC 2018 with Circolare 7/2019", OLD: "Circolare 617/2009"}
"""of the codes, in words"""
LOWER = 1e-6
"""share by which the least load factor that was found lies below that of the state shown where it is another figure"""
PARTS = 12
"""kinematic blocks that are listed one by one"""
RATIO = "zeta"
"""symbol of the ratio that decides at a limit state"""


@dataclass(frozen=True)
class Figure:
    """One figure of an assessment.

    limit_state : SLD, SLV or SLC; empty for all of them
    unit        : in the deck's; empty for none
    """

    limit_state: str
    symbol: str
    value: float
    unit: str
    article: str
    words: str


@dataclass(frozen=True)
class Assessment:
    """Figures in the order in which they follow from each other, and what stands against them.

    code : in words
    """

    code: str
    figures: tuple[Figure, ...] = ()
    remarks: tuple[Message, ...] = ()

    @property
    def ratios(self) -> dict[str, Figure]:
        """Capacity over demand at every limit state that has a verdict."""
        return {each.limit_state: each for each in self.figures if each.symbol == RATIO}


@cache
def _kinds() -> dict[str, dict[str, str]]:
    text = files("mbla.results.assessment").joinpath("figures.csv").read_text(encoding="utf-8")
    return {row["symbol"]: row for row in csv.DictReader(text.splitlines())}


@dataclass
class _Rows:
    """Figures and remarks as they are found, now at one limit state."""

    code: str
    units: Units
    state: str = ""
    figures: list[Figure] = field(default_factory=list)
    remarks: list[Message] = field(default_factory=list)

    def add(self, symbol: str, value: float, words: object = "", article: str = "") -> None:
        """A figure of ``figures.csv``, accelerations in g; ``words`` and ``article`` fill its gaps."""
        kind = _kinds()[symbol.rstrip("0123456789_") if symbol.startswith(("P_", "delta_")) else symbol]
        length = self.units.length
        units = {"acceleration": f"{length}/s2", "length": length, "force": self.units.force}
        size = self.units.standard_gravity if kind["unit"] == "acceleration" else 1.0
        said = kind[self.code].format(article), kind["words"].format(words)
        self.figures.append(Figure(self.state, symbol, value * size, units.get(kind["unit"], kind["unit"]), *said))

    def doubt(self, words: str) -> None:
        self.remarks.append(Message("assessment-in-doubt", words))


@kept
def assessment_of(assembly: Assembly, case: CaseResult) -> Assessment | None:
    """The assessment that a load case asks for; None where it asks for none."""
    asked, mechanics, model = case.load_case.assessment, result_of(case), assembly.model.of_case(case.load_case)
    if asked is None:
        return None
    least = least_known(case)
    if mechanics is None or case.status is not Status.SOLVED or not least > 0.0:
        words = "there is no assessment: the load case has no verified load factor above 0"
        return Assessment(NAMES[asked.code], remarks=(Message("assessment-not-done", words),))
    rows, mechanism = _Rows(asked.code, model.units), kinematic_blocks_of(assembly, case.load_case, mechanics)
    capacity = _capacity(rows, model, assembly.contacts, asked, mechanism, _Factor(least, mechanics.load_factor))
    _doubts(rows, case, mechanism, _Factor(least, mechanics.load_factor))
    for state in given(asked.spectra, LIMIT_STATES):
        rows.state = state
        _assess(rows, getattr(asked.spectra, state), case, capacity)
    if not all(math.isfinite(each.value) for each in rows.figures):
        rows.doubt("a capacity is beyond every ground acceleration up to 10 g, or a table ends before a period needed")
    return Assessment(NAMES[asked.code], tuple(rows.figures), tuple(rows.remarks))


def with_remarks(assembly: Assembly, case: CaseResult) -> CaseResult:
    """A load case with what stands against its assessment among the remarks on its solution."""
    found = assessment_of(assembly, case)
    if found is None:
        return case
    return replace(case, solution=replace(case.solution, remarks=(*case.solution.remarks, *found.remarks)))


# --- The mechanism in numbers ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Factor:
    """The least load factor that was found, by which everything is assessed, and that of the state shown."""

    least: float
    shown: float

    @property
    def differs(self) -> bool:
        """Whether these are two figures."""
        return self.least < (1.0 - LOWER) * self.shown


def _doubts(rows: _Rows, case: CaseResult, mechanism: KinematicBlocks, factor: _Factor) -> None:
    """What makes the figures less than they seem."""
    if case.solution.flow_rule == "associative":
        rows.doubt("the load factor of associative flow is unsafe as alpha_0, for sliding joints lift in it")
    if factor.differs:
        words = (
            f"alpha_0 is by the least load factor that was found, {factor.least:.6g}; kinematic blocks are those of "
        )
        words += f"the state shown, at {factor.shown:.6g}"
        rows.doubt(words + (", from which the capacity curve starts" if case.solution.further.pushover.curve else ""))
    if not mechanism.in_plane:
        rows.doubt("the mechanism moves in space, where the code limits itself to those parallel to one vertical plane")
    if mechanism.explained < 1.0:
        rows.doubt(f"many parts move, their kinematic blocks reproduce {mechanism.explained:.3g} of the motion")


# --- Capacity and limit states --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Capacity:
    """What the articles need: e*, FC, a_0* in g, and where the mechanism is, None on the ground."""

    asked: AssessmentSection
    mechanism: KinematicBlocks
    share: float
    confidence: float
    activation: float
    floor: Floor | None


def _capacity(
    rows: _Rows,
    model: Model,
    contacts: Contacts,
    asked: AssessmentSection,
    mechanism: KinematicBlocks,
    factor: _Factor,
) -> _Capacity:
    laws = [model.joints[contacts.joint_names[number]] for number in np.unique(contacts.joints).tolist()]
    crushes = all(np.isfinite(law.compressive_strength) for law in laws)
    level = asked.knowledge if crushes else "LC1"
    confidence = coefficients()["confidence"][level]
    weights, delta, (of_stones, delta_stones) = mechanism.weights, mechanism.delta, mechanism.stones
    share, stones = codes.participating_share(weights, delta), codes.participating_share(of_stones, delta_stones)
    alpha = factor.least * mechanism.acceleration
    activation = codes.spectral_acceleration(alpha, share, confidence)
    rows.add("alpha_0", alpha, "least load factor that was found" if factor.differs else "load factor")
    for number, (weight, moved) in enumerate(zip(weights.tolist(), delta.tolist(), strict=True), 1):
        if number <= PARTS:
            rows.add(f"P_{number}", weight, number)
            rows.add(f"delta_{number}", moved)
    rows.add("Q", 0.0)
    rows.add("e*", share, f"kinematic blocks, {len(weights)}")
    rows.add("e* stones", stones, f"single stones, {len(of_stones)}")
    rows.add("FC", confidence, level if crushes else "LC1, as not all joints crush")
    rows.add("a_0*", activation)
    rows.add("a_0* stones", codes.spectral_acceleration(alpha, stones, confidence))
    floor, up = None, asked.height
    if up is not None:
        floor = Floor(up.period, up.damping, participation(up.storeys), up.z / up.top)
        rows.add("gamma_1", floor.participation)
        rows.add("psi_1", floor.shape)
    return _Capacity(asked, mechanism, share, confidence, activation, floor)


def _assess(rows: _Rows, section: SpectrumSection, case: CaseResult, capacity: _Capacity) -> None:
    """All that is asked at one limit state, the deciding ratio last."""
    spectrum, floor, q = spectrum_of(section), capacity.floor, capacity.asked.behaviour_factor
    where = "a_g S" if floor is None else "at z, not below a_g S"
    rows.add("a_g", spectrum.a_g, article=_source(section))
    for symbol in () if spectrum.table else ("S", "T_B", "T_C", "T_D"):
        rows.add(symbol, getattr(spectrum, symbol), article=_source(section))
    if floor is not None:
        damping = floor.damping if rows.code != OLD else 5.0
        rows.add("S_e(T_1)", ground_acceleration(spectrum, floor.period, damping), damping)
    if rows.code == OLD:
        demand = codes.demand_617(spectrum, floor)
        rows.add("a_Z", demand, where)
        rows.add("q", q)
        rows.add(RATIO, q * capacity.activation / demand, "q a_0*/a_Z, by alpha_0 alone")
        return
    rows.add("a_Z", codes.floor_demand(spectrum, floor), where, "C8.7.1.2.1.5" if floor is None else "[C7.2.8]")
    begins = codes.ground_capacity(lambda a: codes.floor_demand(spectrum_of(section, a), floor), capacity.activation)
    rows.add("a_g,0", begins)
    borne, how, article = begins, "a_g,0/a_g, where it begins", "C8.7.1.2.1.5"
    if rows.state == "SLV":
        borne, how, article = q * begins, "q a_g,0/a_g, by alpha_0 alone", "C8.7.1.2.1.7"
        rows.add("q", q)
        rows.add("q a_g,0", borne)
    if rows.state in codes.SHARES and case.load_case.pushover is not None:
        against = _why_no_displacement(case, capacity.mechanism)
        found = math.nan if against else _by_displacement(rows, section, case, capacity)
        if against:
            rows.doubt(f"{rows.state}: no verdict by displacements: {against}")
        if math.isnan(found) and rows.state == "SLC":
            return
        if not math.isnan(found):
            how = "a_g,d/a_g, by displacements" if found >= begins else "a_g,0/a_g, for it does not begin below"
            borne, article = max(found, begins), "C8.7.1.2.1.8"
    rows.add(RATIO, borne / spectrum.a_g, how, article)


def _source(section: SpectrumSection) -> str:
    return "table" if section.table is not None else "EN 1998-1" if section.ntc_2018 is None else "NTC 3.2.3.2.1"


def _why_no_displacement(case: CaseResult, mechanism: KinematicBlocks) -> str:
    """What keeps the curve of a pushover from a verdict, in words; empty where nothing does."""
    from mbla.solution.pushover.curve import dropped  # late, as few load cases are pushed

    curve = case.solution.further.pushover.curve
    if math.isnan(ultimate_displacement(case)):
        return "the pushover did not come to where the load factor is nothing"
    if dropped(curve):
        return "blocks drop on the way"
    if any(not row.residual <= SOLVED_RESIDUAL for row in curve[1:]):
        return f"steps of the pushover violate the joint law by more than {SOLVED_RESIDUAL:g}"
    if any(after.displacement <= before.displacement for before, after in pairwise(curve)):
        return "the control point goes back on its way"
    return "the control point does not count along the live load" if math.isnan(mechanism.control) else ""


def _by_displacement(rows: _Rows, section: SpectrumSection, case: CaseResult, capacity: _Capacity) -> float:
    """The ground acceleration, g, whose demand is the displacement that a limit state allows; nan beyond a table."""
    state, mechanism, g = rows.state, capacity.mechanism, rows.units.standard_gravity
    curve, damping = case.solution.further.pushover.curve, codes.DAMPING[state]
    scale = codes.spectral_displacement(mechanism.weights, mechanism.delta, mechanism.control)
    d_0 = scale * ultimate_displacement(case)
    d = codes.SHARES[state] * d_0
    factor = float(np.interp(d / scale, [row.displacement for row in curve], [row.load_factor for row in curve]))
    a = codes.spectral_acceleration(factor * mechanism.acceleration, capacity.share, capacity.confidence)
    period = codes.secant_period(state, d, a * g)

    def demand(of: Spectrum) -> float:
        return codes.displacement_demand(of, capacity.floor, period, damping) * g

    spectrum = spectrum_of(section)
    asked = demand(spectrum)
    found = codes.ground_capacity(lambda a_g: demand(spectrum_of(section, a_g)), d)
    rows.add("d/d_C", scale)
    rows.add("d_0", d_0)
    rows.add("d", d, codes.SHARES[state])
    rows.add("a(d)", a)
    rows.add("T", period, article="[C8.7.1.10]" if state == "SLV" else "[C8.7.1.11]")
    rows.add("eta", damping_factor(damping), damping, "NTC [3.2.4]")
    if capacity.floor is None:
        rows.add("S_e(T)", ground_acceleration(spectrum, period, damping), article=_source(section))
    else:
        rows.add("p", floor_amplification(capacity.floor, damping))
        rows.add("S_eZ(T)", floor_acceleration(spectrum, capacity.floor, period, damping))
    rows.add("d demand", asked)
    rows.add("ratio d", d / asked)
    rows.add("a_g,d", found)
    return found
