"""Section `assessment` of a load case: what a code asks of a mechanism, and of what earthquake."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from mbla.deck.quantities import Count, NonNegativeLength, NonNegativeNumber, PositiveLength, RealNumber, Time
from mbla.deck.section import Section, exactly_one_of, given, rule
from mbla.deck.units import STANDARD_GRAVITY
from mbla.errors import Finding

LIMIT_STATES = ("SLD", "SLV", "SLC")
"""damage, life safety and near collapse, by the names of the Italian code"""

GREATEST, LONGEST = 1.0, 2.0
"""a_g in g and T_C* in s, above what maps of any country have: 0.3 and 0.6 in Italy for a return period of 475 years"""

GroundAcceleration: TypeAlias = Annotated[float, RealNumber("number", gt=0)]
Soil: TypeAlias = Literal["A", "B", "C", "D", "E"]


class NtcSpectrum(Section):
    """Spectrum of NTC 2018, 3.2.3.2.1, from the parameters of a site and of a return period."""

    a_g: GroundAcceleration = Field(description="greatest acceleration of rock, in g, at most 1")
    F_0: Annotated[float, RealNumber("number", ge=2.2, le=5)] = Field(description="greatest amplification")
    T_C_star: Time = Field(
        description="period, s, at most 2, at which the spectrum of rock begins to fall with constant velocity"
    )
    soil: Soil = Field(description="category of the ground")
    topography: Literal["T1", "T2", "T3", "T4"] = Field("T1", description="category of the site")


class EurocodeSpectrum(Section):
    """Spectrum of EN 1998-1:2004, 3.2.2.2, with the recommended values."""

    a_g: GroundAcceleration = Field(
        description="design acceleration of rock with its factor of importance, in g, at most 1"
    )
    type: Literal[1, 2] = Field(description="1, or 2 where earthquakes have a surface-wave magnitude up to 5.5")
    soil: Soil = Field(description="type of the ground")


@rule(NtcSpectrum)
@rule(EurocodeSpectrum)
def of_the_ground(spectrum: NtcSpectrum | EurocodeSpectrum) -> Iterator[Finding]:
    """An acceleration in g and a period in seconds."""
    if spectrum.a_g > GREATEST:
        metric = f"{spectrum.a_g:g} m/s^2 would be {spectrum.a_g / STANDARD_GRAVITY:.3g}"
        words = f"must be <= {GREATEST:g}: it is in units of g = {STANDARD_GRAVITY:g} m/s^2; {metric}"
        yield Finding("out-of-bounds", words, "a_g")
    if isinstance(spectrum, NtcSpectrum) and spectrum.T_C_star > LONGEST:
        words = (
            f"must be <= {LONGEST:g}: it is in seconds; {spectrum.T_C_star:g} ms would be {spectrum.T_C_star / 1e3:.3g}"
        )
        yield Finding("out-of-bounds", words, "T_C_star")


@exactly_one_of()
class SpectrumSection(Section):
    """The earthquake of a limit state: an elastic spectrum on the ground for 5 % damping."""

    ntc_2018: NtcSpectrum | None = Field(None, description="by the Italian code")
    en_1998: EurocodeSpectrum | None = Field(None, description="by EN 1998-1:2004")
    table: list[tuple[NonNegativeNumber, NonNegativeNumber]] | None = Field(
        None, min_length=2, description="periods, s, from 0 on, and accelerations, in g; straight lines between"
    )


@rule(SpectrumSection)
def spectrum(section: SpectrumSection) -> Iterator[Finding]:
    """Periods of a table begin at 0 and rise; the ground moves."""
    if section.table is None:
        return
    if section.table[0][0] != 0.0 or section.table[0][1] == 0.0:
        words = "must be the period 0 with the acceleration of the ground, which is more than 0"
        yield Finding("out-of-bounds", words, "table", 0)
    for number, (before, after) in enumerate(pairwise(period for period, _ in section.table), start=1):
        if not before < after:
            yield Finding("out-of-bounds", f"must be > {before:g}, the period before it", "table", number, 0)


class SpectraSection(Section):
    """The earthquakes that the structure is to bear, by limit state."""

    SLD: SpectrumSection | None = Field(None, description="damage: the mechanism does not begin")
    SLV: SpectrumSection | None = Field(None, description="life safety")
    SLC: SpectrumSection | None = Field(None, description="near collapse; needs `pushover`")


@rule(SpectraSection)
def spectra(section: SpectraSection) -> Iterator[Finding]:
    """Something is asked for."""
    if not given(section, LIMIT_STATES):
        yield Finding("missing-key", "needs a spectrum for SLD, SLV or SLC")


class HeightSection(Section):
    """The building that carries the mechanism up in the air, by its first mode, a straight line from the ground."""

    z: NonNegativeLength = Field(description="height of the mechanism's supports above the foundation")
    top: PositiveLength = Field(description="height of the building above the foundation")
    period: Time = Field(description="T_1, first period of the building, s")
    storeys: Count = Field(description="n, for the participation factor 3n/(2n + 1)")
    damping: Annotated[float, RealNumber("number", ge=1, le=30)] = Field(5.0, description="of the building, per cent")


@rule(HeightSection)
def height(section: HeightSection) -> Iterator[Finding]:
    """The mechanism is on the building."""
    if section.z > section.top:
        yield Finding("out-of-bounds", f"must be <= {section.top:g}, the top", "z")


class AssessmentSection(Section):
    """What a code says of the mechanism: capacity over demand by limit state, with every figure on the way."""

    code: Literal["ntc_2018", "circolare_617_2009"] = Field(
        "ntc_2018",
        description="ntc_2018: NTC 2018 with Circolare 7/2019, C8.7.1.2.1; circolare_617_2009: the linear analysis of "
        "Circolare 617/2009, C8A.4, SLV",
    )
    spectra: SpectraSection = Field(description="what earthquakes")
    knowledge: Literal["LC1", "LC2", "LC3"] = Field(
        "LC1", description="level of knowledge; LC1 counts in any case where joints have no compressive strength"
    )
    behaviour_factor: Annotated[float, RealNumber("number", ge=1, le=5)] = Field(
        2.0, description="q, for SLV by the load factor alone"
    )
    height: HeightSection | None = Field(None, description="where the mechanism does not begin at the ground")


@rule(AssessmentSection)
def assessment(section: AssessmentSection) -> Iterator[Finding]:
    """The older circular is here for life safety only."""
    if section.code == "circolare_617_2009":
        for name in given(section.spectra, ("SLD", "SLC")):
            yield Finding("key-of-another-choice", f"does not apply to {section.code}", "spectra", name)
