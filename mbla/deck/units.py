"""Units of a deck, and the conversion of strings with a unit (only importer of pint)."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cache
from typing import Any

from mbla.errors import ValueRefused

METRES = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "ft": 0.3048, "in": 0.0254}
NEWTONS = {"N": 1.0, "kN": 1e3, "MN": 1e6, "lbf": 4.4482216152605, "kip": 4448.2216152605}
KILOGRAMS = {"kg": 1.0, "t": 1e3, "lb": 0.45359237}
STANDARD_GRAVITY = 9.81
"""m/s2; the g of load factors that are accelerations, and of unit weights"""


@dataclass(frozen=True)
class Dimension:
    """What a number measures.

    unit    : the deck's unit for it, with L, F, M for its units of length, force and mass; empty for plain numbers
    powers  : exponents of length, force, mass; time is in seconds, angles in degrees in every deck
    si      : the same unit in SI (angles: degree), as pint reads it
    example : a string that a message can offer
    """

    unit: str
    powers: tuple[int, int, int]
    si: str
    example: str


DIMENSIONS = {
    "number": Dimension("", (0, 0, 0), "", ""),
    "length": Dimension("L", (1, 0, 0), "m", "30 cm"),
    "area": Dimension("L^2", (2, 0, 0), "m**2", "300 mm^2"),
    "force": Dimension("F", (0, 1, 0), "N", "10 kN"),
    "moment": Dimension("F*L", (1, 1, 0), "N*m", "10 kN*m"),
    "force_per_length": Dimension("F/L", (-1, 1, 0), "N/m", "10 kN/m"),
    "mass": Dimension("M", (0, 0, 1), "kg", "500 kg"),
    "stress": Dimension("F/L^2", (-2, 1, 0), "N/m**2", "0.1 MPa"),
    "density": Dimension("M/L^3", (-3, 0, 1), "kg/m**3", "2000 kg/m^3"),
    "unit_weight": Dimension("F/L^3", (-3, 1, 0), "N/m**3", "18 kN/m^3"),
    "stiffness_per_area": Dimension("F/L^3", (-3, 1, 0), "N/m**3", "10 GPa/m"),
    "acceleration": Dimension("L/s^2", (1, 0, 0), "m/s**2", "9.81 m/s^2"),
    "base_acceleration": Dimension("L/s^2", (1, 0, 0), "m/s**2", "0.3 g"),
    "angle": Dimension("degree", (0, 0, 0), "degree", "0.5 rad"),
    "time": Dimension("s", (0, 0, 0), "s", "10 min"),
}


DECIMAL: dict[str, dict[str, float]] = {
    "length": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "km": 1e3},
    "area": {"m^2": 1.0, "mm^2": 1e-6, "cm^2": 1e-4},
    "force": {"N": 1.0, "kN": 1e3, "MN": 1e6},
    "moment": {"N*m": 1.0, "kN*m": 1e3, "N m": 1.0, "kN m": 1e3},
    "force_per_length": {"N/m": 1.0, "kN/m": 1e3},
    "mass": {"kg": 1.0, "t": 1e3},
    "stress": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "N/mm^2": 1e6, "kN/m^2": 1e3},
    "density": {"kg/m^3": 1.0, "t/m^3": 1e3},
    "unit_weight": {"N/m^3": 1.0, "kN/m^3": 1e3},
    "stiffness_per_area": {"N/m^3": 1.0, "Pa/m": 1.0, "kPa/m": 1e3, "MPa/m": 1e6, "GPa/m": 1e9, "N/mm^3": 1e9},
    "acceleration": {"m/s^2": 1.0},
    "base_acceleration": {"m/s^2": 1.0, "cm/s^2": 1e-2, "mm/s^2": 1e-3},
    "angle": {"degree": 1.0, "degrees": 1.0, "deg": 1.0},
    "time": {"s": 1.0, "min": 60.0},
}
"""Factors to ``Dimension.si`` of what decks mostly write; all else is for pint, which takes half a second to load."""

OF_EARTHQUAKES: dict[str, dict[str, float]] = {
    "base_acceleration": {"g": STANDARD_GRAVITY, "gal": 1e-2, "Gal": 1e-2},
}
"""of these dimensions alone: elsewhere g is a gram, gal a gallon"""


@dataclass(frozen=True)
class Units:
    """Units of length, force and mass; time is always in seconds, an angle of the deck in degrees."""

    length: str = "m"
    force: str = "N"
    mass: str = "kg"

    @property
    def standard_gravity(self) -> float:
        """9.81 m/s2 in the deck's unit of length per s2."""
        return STANDARD_GRAVITY / METRES[self.length]

    @property
    def force_per_mass_acceleration(self) -> float:
        """Factor from (unit of mass) x (unit of length)/s2 to the unit of force."""
        return KILOGRAMS[self.mass] * METRES[self.length] / NEWTONS[self.force]

    def unit(self, dimension: str) -> str:
        """The deck's unit for a dimension, such as ``kN/m^3``; empty for plain numbers."""
        symbols = {"L": self.length, "F": self.force, "M": self.mass}
        return re.sub(r"[LFM]", lambda match: symbols[match.group()], DIMENSIONS[dimension].unit)

    def convert(self, text: str, dimension: str) -> float:
        """Value of a string with a unit, in the deck's unit for a dimension (a key of DIMENSIONS).

        Raises ValueRefused with what is wrong with the string and what to write instead.
        """
        number, unit = _split(text, dimension)
        if dimension == "number":
            raise ValueRefused("wrong-unit", "must be a number without a unit")
        length, force, mass = DIMENSIONS[dimension].powers
        size = METRES[self.length] ** length * NEWTONS[self.force] ** force * KILOGRAMS[self.mass] ** mass
        value = number * (_si_factor(unit, dimension) / size)
        if not math.isfinite(value):
            raise ValueRefused("not-a-number", "is too large for a number")
        if number and not value:
            raise ValueRefused("not-a-number", "is too small for a number other than 0")
        return value


_TERM = r"[A-Za-zµμ°]{1,24}(?:(?:\^|\*\*)-?[1-9]|[23²³])?"
_BARE_POWER = re.compile(r"(?<=[A-Za-z])[23]")
"""of ``kg/m3``, as results write it"""
_UNIT = rf"{_TERM}(?:[ ]*[*/·][ ]*{_TERM}|[ ]+{_TERM}){{0,5}}"
# A unit is checked against this before pint sees it: pint evaluates what it is given, powers included.
_QUANTITY = re.compile(
    rf"([-+]?(?:\d{{1,30}}(?:\.\d{{0,30}})?|\.\d{{1,30}})(?:[eE][-+]?\d{{1,3}})?)[ ]*({_UNIT})?", re.ASCII
)


def _split(text: str, dimension: str) -> tuple[float, str]:
    """Number and unit of a string."""
    example = DIMENSIONS[dimension].example
    remedy = f', or a text such as "{example}"' if example else ""
    match = _QUANTITY.fullmatch(text.strip()) if len(text) <= 100 else None
    if match is None:
        raise ValueRefused("not-a-number", f"must be a number{remedy}")
    number = float(match[1])
    if abs(number) == float("inf"):
        raise ValueRefused("not-a-number", "is too large for a number")
    if match[2] is None:
        raise ValueRefused("not-a-number", f"is a text: write the number without quotes{remedy}")
    return number, _BARE_POWER.sub(r"^\g<0>", match[2])


@cache
def _registry() -> Any:
    """Registry of units; loading it takes half a second, so only strings with a unit do."""
    import pint

    return pint.UnitRegistry(cache_folder=None)


def _si_factor(unit: str, dimension: str) -> float:
    """Factor from a unit to the SI unit of a dimension (angles: degree)."""
    decimal = (DECIMAL[dimension] | OF_EARTHQUAKES.get(dimension, {})).get(unit)
    factor = _factor_by_pint(unit, dimension) if decimal is None else decimal
    if isinstance(factor, str):
        raise ValueRefused("wrong-unit", factor)
    return factor


@cache
def _factor_by_pint(unit: str, dimension: str) -> float | str:
    """The same of any unit, or what is wrong with it: kept as well, as pint takes a millisecond each time."""
    import pint

    registry = _registry()
    wanted = DIMENSIONS[dimension]
    shown = dimension.replace("_", " ")
    try:
        parsed = registry.parse_units(unit.replace("·", "*").replace("°", "degree"))
    except Exception:  # pint raises its own, tokenize's and plain errors on what it does not know
        return f'has an unknown unit "{unit}": write for example "{wanted.example}"'
    try:
        root = registry.Quantity(1.0, parsed).to_root_units()
        # To pint an angle is a plain ratio; `percent` must not pass for one.
        is_angle = "radian" in str(root.units)
        fits = parsed.dimensionality == registry.parse_units(wanted.si).dimensionality
        if not fits or is_angle != (dimension == "angle"):
            return f'"{unit}" does not measure {shown}: write for example "{wanted.example}"'
        factor = float(registry.Quantity(1.0, parsed).to(wanted.si).magnitude)
    except (pint.errors.PintError, ArithmeticError):  # a logarithm in a product, a power beyond what a double holds
        factor = 0.0
    return factor if 0.0 < factor < math.inf else f'"{unit}" cannot be converted: write for example "{wanted.example}"'
