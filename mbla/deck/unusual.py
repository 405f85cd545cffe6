"""Values of a deck that are far from those of masonry: mostly meant in another unit, or an angle for a coefficient.

Limits lie well beyond what is built, tested at a small scale or found in the ground, in SI units, whatever those of the
deck: a value between them is not remarked on. What is beyond them is used as it is given.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from mbla.deck.content import DeckContent, soils_of
from mbla.deck.sections.assessment import LIMIT_STATES, SpectrumSection
from mbla.deck.sections.load_cases import supports_of
from mbla.deck.sections.loads import Load
from mbla.deck.text.tree import Tree
from mbla.deck.units import METRES, STANDARD_GRAVITY, Units
from mbla.errors import KeyPath, Message, Notice

GRAVITY_TOLERANCE = 0.02
"""Covers 9.8, 9.80665 and the variation over the earth."""

MOST_ACCELERATION = 5.0
"""g, of a live load: beyond what brings masonry down"""
MOST_GROUND, OF_GROUND = 0.6, "is in units of g = 9.81 m/s^2, and maps of earthquakes rarely have as much"
"""g, of the ground, and what to say of more"""
LONGEST_PERIOD = 20.0
"""s, of spectra and buildings"""


@dataclass(frozen=True)
class Usual:
    """Between what a value is not remarked on.

    least, most : in the unit of the words; texts are converted
    words       : what it is, or is not
    dimension   : see :data:`mbla.deck.units.DIMENSIONS`; empty for a number whose words say all
    meant       : units in which such a number may be meant where it is far off: the one that brings it closest to
    typical     : a value as it mostly is
    """

    least: float | str
    most: float | str
    words: str
    dimension: str = ""
    meant: tuple[str, ...] = ()
    typical: str = ""

    def remark(self, value: float, units: Units) -> str:
        """What is odd about a value; nothing where its size is between the limits."""
        ends = (self.least, self.most)
        low, high = (units.convert(end, self.dimension) if isinstance(end, str) else end for end in ends)
        if low <= abs(value) <= high:
            return ""
        if not self.meant:
            return self.words
        remark = f"is {value:.6g} {units.unit(self.dimension)}, {self.words}"
        typical = units.convert(self.typical, self.dimension)
        others = {unit: units.convert(f"{abs(value):.15g} {unit}", self.dimension) for unit in self.meant}
        unit = min(others, key=lambda unit: abs(math.log(others[unit] / typical)))
        return f'{remark}; "{value:.6g} {unit}" may be meant' if low <= others[unit] <= high else remark


STRESSES = ("MPa", "kPa", "Pa")
MORTAR = Usual("1 kPa", "1 GPa", "and that of mortar joints is some 10 kPa to 1 MPa", "stress", STRESSES, "0.1 MPa")
CRUSHING = Usual(
    "10 kPa",
    "10 GPa",
    "and that of masonry is 0.5 to 200 MPa; without the key it is unlimited",
    "stress",
    STRESSES,
    "5 MPa",
)
SOIL_ANGLE = Usual(1.0, 60.0, "is in degrees, and that of soil is 15 to 45, or 0 where it is sheared undrained")
SOIL_COHESION = Usual("100 Pa", "1 MPa", "and that of soil is 0 to 300 kPa", "stress", STRESSES, "10 kPa")
STEP, PATH = (
    Usual(0.0, most, "a displacement no structure survives", "length", ("mm", "cm"), "100 mm")
    for most in ("10 m", "100 m")
)

USUAL: dict[str, dict[str, Usual]] = {
    "materials": {
        "density": Usual(
            "200 kg/m^3", "20000 kg/m^3", "is not that of masonry, 1500 to 3000 kg/m^3", dimension="density"
        ),
        "unit_weight": Usual(
            "2 kN/m^3", "200 kN/m^3", "is not that of masonry, 15 to 30 kN/m^3", dimension="unit_weight"
        ),
        "tensile_strength": Usual(
            "10 kPa", "100 MPa", "and that of stone and brick is 0.5 to 20 MPa", "stress", STRESSES, "3 MPa"
        ),
        "compressive_strength": CRUSHING,
    },
    "joints": {
        "friction": Usual(0.0, 5.0, "is more than masonry has; an angle is given as friction_angle, in degrees"),
        "friction_angle": Usual(
            1.0, 78.7, "is not that of masonry, 20 to 45 degrees; a coefficient is given as friction"
        ),
        "cohesion": MORTAR,
        "tensile_strength": MORTAR,
        "compressive_strength": CRUSHING,
    },
    "stiffness": {
        "normal": Usual(
            "1 MPa/m",
            "1e6 GPa/m",
            "and that of joints is 0.1 to 1000 GPa/m",
            "stiffness_per_area",
            ("GPa/m", "MPa/m", "Pa/m"),
            "10 GPa/m",
        ),
        "modulus": Usual(
            "1 MPa",
            "1000 GPa",
            "and that of masonry is 0.1 to 50 GPa",
            "stress",
            ("GPa", *STRESSES),
            "3 GPa",
        ),
        "ratio": Usual(0.02, 2.0, "is not that of joints, 0.3 to 0.5"),
    },
    "soil": {"friction_angle": SOIL_ANGLE, "cohesion": SOIL_COHESION, "tensile_strength": SOIL_COHESION},
    "sheared_soil": {"friction_angle": SOIL_ANGLE, "cohesion": SOIL_COHESION},
    "ties": {
        "strength": Usual("100 kPa", "100 GPa", "and that of steel is 200 to 2000 MPa", "stress", STRESSES, "300 MPa"),
        "area": Usual("0.01 mm^2", "2 m^2", "which no tie or strut has", "area", ("mm^2", "cm^2", "m^2"), "400 mm^2"),
        "diameter": Usual("0.1 mm", "1 m", "which no bar has", "length", ("mm", "cm", "m"), "24 mm"),
    },
    "plate": {
        "diameter": Usual("1 mm", "5 m", "which no anchor plate has", "length", ("mm", "cm", "m"), "200 mm"),
        "wall": Usual("1 mm", "20 m", "which no wall has", "length", ("mm", "cm", "m"), "0.5 m"),
        "shear_strength": MORTAR,
        "tensile_strength": MORTAR,
    },
    "pushover": {"step": STEP, "until": PATH},
    "settlement": {"step": STEP, "amount": PATH},
    "pressure": {
        "per_depth": Usual(
            "0.1 kN/m^3",
            "1000 kN/m^3",
            "and that of earth and water is 1 to 30 kN/m^3",
            "unit_weight",
            ("kN/m^3", "N/m^3"),
            "10 kN/m^3",
        )
    },
    "water": {
        "unit_weight": Usual(
            "5 kN/m^3", "20 kN/m^3", "and that of water is 9.81 kN/m^3", "unit_weight", ("kN/m^3", "N/m^3"), "10 kN/m^3"
        )
    },
    "height": {"period": Usual(0.0, LONGEST_PERIOD, "is in seconds, and no building's first period is so long")},
    "spectrum": {"a_g": Usual(0.0, MOST_GROUND, OF_GROUND)},
}
"""By section and key."""


def unusual_values(tree: Tree, content: DeckContent, units: Units) -> Iterator[Notice]:
    """A warning for each value that is far from usual."""
    for path, section, item in _places(content):
        for key, usual in USUAL[section].items():
            value = getattr(item, key)
            remark = usual.remark(value, units) if value else ""
            if remark:
                yield _notice(tree, (*path, key), remark)
    for path, load in _loads(content):
        if load.kind == "acceleration" and math.hypot(*load.chosen) > MOST_ACCELERATION:
            yield _notice(tree, (*path, "acceleration"), "is in units of g = 9.81 m/s^2")
    for path, spectrum in _spectra(content):
        if spectrum.table is not None and spectrum.table[0][1] > MOST_GROUND:
            yield _notice(tree, (*path, "table", 0, 1), OF_GROUND)
        if spectrum.table is not None and spectrum.table[-1][0] > LONGEST_PERIOD:
            yield _notice(tree, (*path, "table", len(spectrum.table) - 1, 0), "is in seconds, and spectra end before")


def _notice(tree: Tree, path: KeyPath, words: str) -> Notice:
    return Notice("warning", "value-unusual", str(tree.fault(path, Message("value-unusual", words))))


def _places(content: DeckContent) -> Iterator[tuple[KeyPath, str, Any]]:
    """Places with values that are held against those of :data:`USUAL`, under which name, and what is there."""
    for section in ("materials", "joints"):
        for name, item in getattr(content, section).items():
            yield (section, name), section, item
            if section == "joints" and item.stiffness is not None:
                yield (section, name, "stiffness"), "stiffness", item.stiffness
    for path, soil in soils_of(content):
        yield path, "soil", soil
        yield (*path, "wall"), "sheared_soil", soil.wall
    for name, fill in content.fill.items():
        if fill.passive is not None:
            yield ("fill", name, "passive"), "sheared_soil", fill.passive
    for number, tie in enumerate(content.ties):
        yield ("ties", number), "ties", tie
        if tie.plate is not None:
            yield ("ties", number, "plate"), "plate", tie.plate
    for path, load in _loads(content):
        if load.kind == "pressure":
            yield (*path, "pressure"), "pressure", load.chosen
    for place, soil in soils_of(content):
        if soil.water is not None:
            yield (*place, "water"), "water", soil.water
    for name, case in content.load_cases.items():
        if case.pushover is not None:
            yield ("load_cases", name, "pushover"), "pushover", case.pushover
        for row, support in enumerate(supports_of(case)):
            several = isinstance(case.settlement, list)
            yield ("load_cases", name, "settlement", *((row,) if several else ())), "settlement", support
        if case.assessment is not None and case.assessment.height is not None:
            yield ("load_cases", name, "assessment", "height"), "height", case.assessment.height
    for path, spectrum in _spectra(content):
        for key in ("ntc_2018", "en_1998"):
            if getattr(spectrum, key) is not None:
                yield (*path, key), "spectrum", getattr(spectrum, key)


def _spectra(content: DeckContent) -> Iterator[tuple[KeyPath, SpectrumSection]]:
    for name, case in content.load_cases.items():
        spectra = None if case.assessment is None else case.assessment.spectra
        for state in LIMIT_STATES:
            if (spectrum := getattr(spectra, state, None)) is not None:
                yield ("load_cases", name, "assessment", "spectra", state), spectrum


def unusual_gravity(tree: Tree, content: DeckContent, units: Units) -> Iterator[Notice]:
    """Gravity far from 9.81 m/s2: mostly a deck in mm whose gravity is still in m."""
    for path, load in _loads(content):
        if load.kind != "gravity" or load.chosen == "none" or not any(load.chosen):
            continue
        size = math.hypot(*load.chosen) * METRES[units.length]
        if abs(size - STANDARD_GRAVITY) > GRAVITY_TOLERANCE * STANDARD_GRAVITY:
            fault = tree.fault((*path, "gravity"), Message("gravity-unusual", f"is {size:.4g} m/s^2, not 9.81"))
            words = f"{fault}: its numbers are in {units.unit('acceleration')}"
            yield Notice("warning", "gravity-unusual", words)


def _loads(content: DeckContent) -> Iterator[tuple[KeyPath, Load]]:
    for name, named in content.loads.items():
        yield from ((("loads", name, number), load) for number, load in enumerate(named))
    for name, case in content.load_cases.items():
        for key, loads in (("dead", case.dead or []), ("live", case.live or [])):
            for number, load in enumerate(loads):
                yield ("load_cases", name, key, number), load
