from __future__ import annotations

import subprocess
import sys
from contextlib import suppress
from typing import Annotated, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter, ValidationError

from mbla.deck.quantities import Count, Index, Integer, RealNumber, Switch
from mbla.deck.units import DECIMAL, DIMENSIONS, KILOGRAMS, METRES, NEWTONS, STANDARD_GRAVITY, Units, _factor_by_pint

SI = Units()


@pytest.mark.parametrize(
    ("units", "text", "dimension", "expected"),
    [
        (SI, "18 kN/m^3", "unit_weight", 18e3),
        (Units("m", "kN", "t"), "18 kN/m^3", "unit_weight", 18.0),
        (Units("mm", "N", "t"), "18 kN/m^3", "unit_weight", 18e-6),
        (Units("mm", "N", "t"), "0.1 MPa", "stress", 0.1),
        (Units("m", "kN", "t"), "0.1 N/mm**2", "stress", 100.0),
        (Units("in", "kip", "lb"), "12 ft", "length", 144.0),
        (SI, "1 in", "length", 0.0254),
        (SI, "30cm", "length", 0.3),
        (SI, "-3e2 mm", "length", -0.3),
        (SI, "1 kip", "force", 4448.2216152605),
        (SI, "2 t/m³", "density", 2000.0),
        (SI, "2000 kg/m3", "density", 2000.0),
        (SI, "18 kN/m3", "unit_weight", 18e3),
        (SI, "5 N/mm2", "stress", 5e6),
        (SI, "120 lbf/ft^3", "unit_weight", 120 * 4.4482216152605 / 0.3048**3),
        (Units("mm", "N", "t"), "9.81 m/s^2", "acceleration", 9810.0),
        (SI, "0.5 rad", "angle", 28.64788975654116),
        (SI, "30 deg", "angle", 30.0),
        (SI, "33°", "angle", 33.0),
        (SI, "10 min", "time", 600.0),
        (SI, "1 kN·s^2/m^4", "density", 1000.0),
        (SI, " 5 kg / m^3 ", "density", 5.0),
        (SI, "100 m^-3 kg", "density", 100.0),
        (SI, "3 m\n", "length", 3.0),
        (SI, "0 ym", "length", 0.0),
    ],
)
def test_conversion(units: Units, text: str, dimension: str, expected: float) -> None:
    assert units.convert(text, dimension) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("dimension", [name for name in DIMENSIONS if name != "number"])
def test_example_of_every_dimension_is_one(dimension: str) -> None:
    assert SI.convert(DIMENSIONS[dimension].example, dimension) > 0


@pytest.mark.parametrize(
    ("text", "dimension", "message"),
    [
        ("18 kN/m", "unit_weight", r"\"kN/m\" does not measure unit weight: write for example \"18 kN/m\^3\""),
        ("18 kg/m^3", "unit_weight", '"kg/m\\^3" does not measure unit weight'),
        ("3 s", "length", "does not measure length"),
        ("1 g", "acceleration", "does not measure acceleration"),
        ("5 percent", "angle", "does not measure angle"),
        ("5 rad", "length", "does not measure length"),
        ("5 degC", "length", "does not measure length"),
        ("0.6", "number", "write the number without quotes"),
        ("0.6", "length", "write the number without quotes"),
        ("0.6 m", "number", "without a unit"),
        ("3 furlongz", "length", 'unknown unit "furlongz"'),
        ("3 __import__", "length", "must be a number"),
        ("3 m^9^9^9^9", "length", "must be a number"),
        ("3 m**99999999", "length", "must be a number"),
        ("3 (m)", "length", "must be a number"),
        ("3 m; 4", "length", "must be a number"),
        ("m", "length", "must be a number"),
        ("", "length", "must be a number"),
        ("1e999 m", "length", "too large"),
        ("3 " + "m" * 200, "length", "must be a number"),
        ("3 " + "m*" * 8 + "m", "length", "must be a number"),
        ("1,5 m", "length", "must be a number"),
        ("٣ m", "length", "must be a number"),
        ("5 dB*m", "length", r'"dB\*m" cannot be converted: write for example "30 cm"'),
        ("5 dBm*s/m", "length", "cannot be converted"),
        ("5 decade*m", "length", "cannot be converted"),
        ("5 octave*m", "length", "cannot be converted"),
        ("5 Np*m", "length", "cannot be converted"),
        ("5 dB^2*m", "length", "cannot be converted"),
        ("5 dB rad", "angle", 'cannot be converted: write for example "0.5 rad"'),
        ("1 Ym^9*Ym^9*m^-9*m^-8", "length", "cannot be converted"),
        ("1 ym^9*ym^9*m^-9*m^-8", "length", "cannot be converted"),
        ("1 Ym^9/ym^9*m", "length", "cannot be converted"),
        ("1e300 Ym", "length", "is too large for a number"),
        ("-1e-310 ym", "length", "is too small for a number other than 0"),
    ],
)
def test_refusals(text: str, dimension: str, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        SI.convert(text, dimension)


@pytest.mark.parametrize("units", [Units(a, b, c) for a in METRES for b in NEWTONS for c in KILOGRAMS])
def test_own_units_convert_to_themselves(units: Units) -> None:
    for dimension in DIMENSIONS:
        if dimension != "number":
            assert units.convert(f"7 {units.unit(dimension)}", dimension) == pytest.approx(7.0, rel=1e-13)


@pytest.mark.parametrize("units", [SI, Units("mm", "kN", "t"), Units("ft", "lbf", "lb")])
def test_gravity(units: Units) -> None:
    assert units.convert("9.81 m/s^2", "acceleration") == pytest.approx(units.standard_gravity, rel=1e-14)
    weight = units.convert("1 kg/m^3", "density") * units.standard_gravity * units.force_per_mass_acceleration
    assert weight == pytest.approx(units.convert(f"{STANDARD_GRAVITY} N/m^3", "unit_weight"), rel=1e-13)


@given(st.text("0123456789.eE+- mkNsftinlb/*^°²³·()[]'\";:=!\n\t", max_size=30), st.sampled_from(sorted(DIMENSIONS)))
def test_any_text_is_a_number_or_a_value_error(text: str, dimension: str) -> None:
    with suppress(ValueError):
        assert isinstance(SI.convert(text, dimension), float)


@pytest.mark.parametrize(("dimension", "unit"), [(name, unit) for name, units in DECIMAL.items() for unit in units])
def test_units_read_without_the_library_are_what_it_makes_of_them(dimension: str, unit: str) -> None:
    assert DECIMAL[dimension][unit] == pytest.approx(_factor_by_pint(unit, dimension), rel=1e-15)


def test_units_library_is_loaded_only_when_needed() -> None:
    program = "import sys, mbla.deck; sys.exit('pint' in sys.modules or 'numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


CONTEXT = {"convert": lambda text, dimension: {"=big": 1e20, "=six": 6.0, "=almost": 2.9999999999999996}[text]}


def check(annotation: Any, value: object) -> Any:
    return TypeAdapter(annotation).validate_python(value, context=CONTEXT)


def accepts(annotation: Any, value: object) -> bool:
    try:
        check(annotation, value)
    except ValidationError:
        return False
    return True


@pytest.mark.parametrize(("value", "whole"), [(6, 6), (6.0, 6), ("=six", 6), ("=almost", 3)])
def test_whole_numbers(value: object, whole: int) -> None:
    result = check(Count, value)
    assert result == whole
    assert type(result) is int


@pytest.mark.parametrize("value", [0, 1_000_001, 2.5, True, None, [], float("nan"), float("inf"), 1e300, "=big"])
def test_not_a_count(value: object) -> None:
    assert not accepts(Count, value)


def test_index_from_zero() -> None:
    assert check(Index, 0) == 0
    assert not accepts(Index, -1)


@pytest.mark.parametrize(
    ("bounds", "good", "bad"),
    [
        (RealNumber("number", gt=0), [1e-300, 5], [0, 0.0, -1]),
        (RealNumber("number", ge=0), [0, 1], [-1e-300]),
        (RealNumber("number", lt=90), [89.999], [90]),
        (RealNumber("number", le=1), [1, "=six"][:1], [1.0000001, "=six"]),
        (RealNumber("number"), [-1, 0, 1e300], [True, None, [1], {}, float("nan"), float("-inf")]),
    ],
)
def test_bounds_hold_for_numbers_and_expressions(bounds: RealNumber, good: list[object], bad: list[object]) -> None:
    annotation = Annotated[float, bounds]
    assert all(accepts(annotation, value) for value in good)
    assert not any(accepts(annotation, value) for value in bad)


def test_bounds_of_whole_numbers() -> None:
    annotation = Annotated[int, Integer(ge=2, le=5)]
    assert [value for value in range(8) if accepts(annotation, value)] == [2, 3, 4, 5]
    assert not accepts(annotation, "=six")


def test_switch_takes_nothing_but_booleans() -> None:
    assert check(Switch, True) is True
    assert not any(accepts(Switch, value) for value in (1, 0, "true", "yes", None))
