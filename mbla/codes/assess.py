"""What a code says of a load case: every figure on the way with its article, and capacity over demand.

Kinematic blocks are the clusters of the mechanism, stones that move as one: P is the weight of each, δ the velocity of
its centre of mass along the live load. By single stones a wall that overturns would have e* = 3/4 in place of 1, and an
activation acceleration a third higher; both are shown. Added masses rest on their blocks and count in P, so that Q = 0.
alpha_0 is by the least load factor that was found, which may be that of other forces or of another mechanism.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.codes import circolare2009, en1998, ntc2018
from mbla.codes.capacity import Capacity, capacity_of
from mbla.codes.coefficients import coefficients
from mbla.codes.figures import Figures
from mbla.codes.ntc2018 import Floor
from mbla.codes.spectrum import Spectrum, damping_factor, ground_acceleration, scaled_table
from mbla.deck.section import given
from mbla.deck.sections.assessment import LIMIT_STATES, AssessmentSection, SpectrumSection
from mbla.deck.units import Units
from mbla.errors import Message
from mbla.results.assessment import NAMES, OLD, RATIO, REMARKS, Assessment
from mbla.results.results import CaseResult

PARTS = 12
"""kinematic blocks that are listed one by one"""


def assessed(assembly: Assembly, case: CaseResult) -> CaseResult:
    """A load case with the assessment that it asks for; what stands against it is among the remarks on its solution."""
    found = assessment_of(assembly, case)
    others = tuple(each for each in case.solution.remarks if each.identifier not in REMARKS)
    remarks = (*others, *(() if found is None else found.remarks))
    return replace(case, assessment=found, solution=replace(case.solution, remarks=remarks))


def assessment_of(assembly: Assembly, case: CaseResult) -> Assessment | None:
    """The assessment that a load case asks for; None where it asks for none."""
    asked = case.load_case.assessment
    if asked is None:
        return None
    capacity = capacity_of(assembly, case)
    if capacity is None:
        words = "there is no assessment: the load case has no verified load factor above 0"
        return Assessment(NAMES[asked.code], remarks=(Message("assessment-not-done", words),))
    return assess(asked, capacity, assembly.model.units)


def assess(asked: AssessmentSection, capacity: Capacity, units: Units) -> Assessment:
    """Capacity over demand at every limit state that is asked for, with every figure on the way."""
    rows = Figures(asked.code, units)
    mechanism = _mechanism(rows, asked, capacity)
    _doubts(rows, capacity)
    for state in given(asked.spectra, LIMIT_STATES):
        rows.state = state
        section: SpectrumSection = getattr(asked.spectra, state)
        _demand(rows, section, mechanism)
        (_by_2009 if asked.code == OLD else _by_2018)(rows, section, mechanism)
    if not all(math.isfinite(each.value) for each in rows.figures):
        rows.doubt("a capacity is beyond every ground acceleration up to 10 g, or a table ends before a period needed")
    return Assessment(NAMES[asked.code], tuple(rows.figures), tuple(rows.remarks))


def spectrum_of(section: SpectrumSection, a_g: float | None = None) -> Spectrum:
    """The spectrum of a deck, or what it is with another acceleration of rock [g], all else of the site kept."""
    if section.ntc_2018 is not None:
        ntc = section.ntc_2018
        return ntc2018.spectrum(ntc.a_g if a_g is None else a_g, ntc.F_0, ntc.T_C_star, ntc.soil, ntc.topography)
    if section.en_1998 is not None:
        eurocode = section.en_1998
        return en1998.spectrum(eurocode.a_g if a_g is None else a_g, eurocode.type, eurocode.soil)
    assert section.table is not None  # a rule of the deck: one of the three
    return scaled_table(tuple(section.table), a_g)


# --- The mechanism in numbers ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Mechanism:
    """What the articles need: e*, FC, a_0* in g, and where the mechanism is, None on the ground."""

    capacity: Capacity
    behaviour: float
    share: float
    confidence: float
    activation: float
    floor: Floor | None


def _mechanism(rows: Figures, asked: AssessmentSection, capacity: Capacity) -> _Mechanism:
    level = asked.knowledge if capacity.crushes else "LC1"
    confidence: float = coefficients("confidence")[level]
    blocks, (of_stones, delta_stones) = capacity.blocks, capacity.blocks.stones
    share = ntc2018.participating_share(blocks.weights, blocks.delta)
    stones = ntc2018.participating_share(of_stones, delta_stones)
    alpha = capacity.least * blocks.acceleration
    activation = ntc2018.spectral_acceleration(alpha, share, confidence)
    rows.add("alpha_0", alpha, "least load factor that was found" if capacity.differs else "load factor")
    for number, (weight, moved) in enumerate(zip(blocks.weights.tolist(), blocks.delta.tolist(), strict=True), 1):
        if number <= PARTS:
            rows.add(f"P_{number}", weight, number)
            rows.add(f"delta_{number}", moved)
    rows.add("Q", 0.0)
    rows.add("e*", share, f"kinematic blocks, {len(blocks.weights)}")
    rows.add("e* stones", stones, f"single stones, {len(of_stones)}")
    rows.add("FC", confidence, level if capacity.crushes else "LC1, as not all joints crush")
    rows.add("a_0*", activation)
    rows.add("a_0* stones", ntc2018.spectral_acceleration(alpha, stones, confidence))
    floor, up = None, asked.height
    if up is not None:
        floor = Floor(up.period, up.damping, ntc2018.participation(up.storeys), up.z / up.top)
        rows.add("gamma_1", floor.participation)
        rows.add("psi_1", floor.shape)
    return _Mechanism(capacity, asked.behaviour_factor, share, confidence, activation, floor)


def _doubts(rows: Figures, capacity: Capacity) -> None:
    """What makes the figures less than they seem."""
    blocks = capacity.blocks
    if capacity.associative:
        rows.doubt("the load factor of associative flow is unsafe as alpha_0, for sliding joints lift in it")
    if capacity.differs:
        words = f"alpha_0 is by the least load factor that was found, {capacity.least:.6g}; kinematic blocks are those "
        words += f"of the state shown, at {capacity.shown:.6g}"
        rows.doubt(words + (", from which the capacity curve starts" if len(capacity.curve) else ""))
    if not blocks.in_plane:
        rows.doubt("the mechanism moves in space, where the code limits itself to those parallel to one vertical plane")
    if blocks.explained < 1.0:
        rows.doubt(f"many parts move, their kinematic blocks reproduce {blocks.explained:.3g} of the motion")


# --- Limit states ---------------------------------------------------------------------------------------------------


def _demand(rows: Figures, section: SpectrumSection, mechanism: _Mechanism) -> None:
    """The spectrum of the ground and of the height."""
    spectrum, floor = spectrum_of(section), mechanism.floor
    rows.add("a_g", spectrum.a_g, article=_source(section))
    for symbol in () if spectrum.table else ("S", "T_B", "T_C", "T_D"):
        rows.add(symbol, getattr(spectrum, symbol), article=_source(section))
    if floor is not None:
        damping = floor.damping if rows.code != OLD else 5.0
        rows.add("S_e(T_1)", ground_acceleration(spectrum, floor.period, damping), damping)


def _where(mechanism: _Mechanism) -> str:
    return "a_g S" if mechanism.floor is None else "at z, not below a_g S"


def _source(section: SpectrumSection) -> str:
    return "table" if section.table is not None else "EN 1998-1" if section.ntc_2018 is None else "NTC 3.2.3.2.1"


def _by_2009(rows: Figures, section: SpectrumSection, mechanism: _Mechanism) -> None:
    """Circolare 617/2009, C8A.4: the linear analysis."""
    demand, q = circolare2009.demand(spectrum_of(section), mechanism.floor), mechanism.behaviour
    rows.add("a_Z", demand, _where(mechanism))
    rows.add("q", q)
    rows.add(RATIO, q * mechanism.activation / demand, "q a_0*/a_Z, by alpha_0 alone")


def _by_2018(rows: Figures, section: SpectrumSection, mechanism: _Mechanism) -> None:
    """Circolare 7/2019, C8.7.1.2.1: where the mechanism begins, and how far it goes; the deciding ratio last."""
    spectrum, floor, q, capacity = spectrum_of(section), mechanism.floor, mechanism.behaviour, mechanism.capacity
    demand = ntc2018.floor_demand(spectrum, floor)
    rows.add("a_Z", demand, _where(mechanism), "C8.7.1.2.1.5" if floor is None else "[C7.2.8]")
    begins = ntc2018.ground_capacity(
        lambda a: ntc2018.floor_demand(spectrum_of(section, a), floor), mechanism.activation
    )
    rows.add("a_g,0", begins)
    borne, how, article = begins, "a_g,0/a_g, where it begins", "C8.7.1.2.1.5"
    if rows.state == "SLV":
        borne, how, article = q * begins, "q a_g,0/a_g, by alpha_0 alone", "C8.7.1.2.1.7"
        rows.add("q", q)
        rows.add("q a_g,0", borne)
    if rows.state in coefficients("mechanism") and capacity.pushed:
        found = math.nan if capacity.without else _by_displacement(rows, section, mechanism)
        if capacity.without:
            rows.doubt(f"{rows.state}: no verdict by displacements: {capacity.without}")
        if math.isnan(found) and rows.state == "SLC":
            return
        if not math.isnan(found):
            how = "a_g,d/a_g, by displacements" if found >= begins else "a_g,0/a_g, for it does not begin below"
            borne, article = max(found, begins), "C8.7.1.2.1.8"
    rows.add(RATIO, borne / spectrum.a_g, how, article)


def _by_displacement(rows: Figures, section: SpectrumSection, mechanism: _Mechanism) -> float:
    """The ground acceleration, g, whose demand is the displacement that a limit state allows; nan beyond a table."""
    capacity, floor, g = mechanism.capacity, mechanism.floor, rows.units.standard_gravity
    blocks, allowed = capacity.blocks, coefficients("mechanism")[rows.state]
    damping: float = allowed["damping"]
    scale = ntc2018.spectral_displacement(blocks.weights, blocks.delta, blocks.control)
    d_0 = scale * capacity.ultimate
    d = allowed["share"] * d_0
    factor = float(np.interp(d / scale, *capacity.curve.T))
    a = ntc2018.spectral_acceleration(factor * blocks.acceleration, mechanism.share, mechanism.confidence)
    period = ntc2018.secant_period(rows.state, d, a * g)

    def demand(of: Spectrum) -> float:
        return ntc2018.displacement_demand(of, floor, period, damping) * g

    spectrum = spectrum_of(section)
    asked = demand(spectrum)
    found = ntc2018.ground_capacity(lambda a_g: demand(spectrum_of(section, a_g)), d)
    rows.add("d/d_C", scale)
    rows.add("d_0", d_0)
    rows.add("d", d, allowed["share"])
    rows.add("a(d)", a)
    rows.add("T", period, article="[C8.7.1.10]" if rows.state == "SLV" else "[C8.7.1.11]")
    rows.add("eta", damping_factor(damping), damping, "NTC [3.2.4]")
    if floor is None:
        rows.add("S_e(T)", ground_acceleration(spectrum, period, damping), article=_source(section))
    else:
        rows.add("p", ntc2018.floor_amplification(floor, damping))
        rows.add("S_eZ(T)", ntc2018.floor_acceleration(spectrum, floor, period, damping))
    rows.add("d demand", asked)
    rows.add("ratio d", d / asked)
    rows.add("a_g,d", found)
    return found
