"""Fields of the deck: names, lines of text, and numbers.

A number is a plain one in the deck's units, an expression, or a string with a unit.

Numbers are checked by pydantic's compiled code, so that large vertex lists cost nothing; only strings, and what is no
number at all, come to Python. The validation context must hold ``convert``, a function (text, dimension) -> number in
the deck's units that raises ValueError.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, TypeAlias

from pydantic import AfterValidator, Field, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from mbla.deck.expressions import CONSTANTS, FUNCTIONS, ParameterFaultError
from mbla.deck.section import wrong_values
from mbla.deck.suggestions import listed
from mbla.deck.units import DIMENSIONS
from mbla.errors import Finding, Message, ValueRefused

NAME_PATTERN = r"^[A-Za-z0-9_][A-Za-z0-9_.-]*$"
PARAMETER_PATTERN = r"^[A-Za-z_][A-Za-z0-9_]*$"
LINE_PATTERN = r"^.*$"
PATTERNS = {
    NAME_PATTERN: "a name has letters, digits and . _ - only, and begins with a letter, digit or _",
    PARAMETER_PATTERN: "the name of a parameter has letters, digits and _ only, and does not begin with a digit",
    LINE_PATTERN: "must be on one line",
}
"""What each pattern allows, in words."""


def _no_reserved_name(name: str) -> str:
    """A parameter must not hide a function or a constant of expressions."""
    if name in FUNCTIONS or name in CONSTANTS:
        raise PydanticCustomError("reserved", "means something else in expressions: choose another name")
    return name


Name: TypeAlias = Annotated[str, Field(pattern=NAME_PATTERN, max_length=64)]
ParameterName: TypeAlias = Annotated[
    str, Field(pattern=PARAMETER_PATTERN, max_length=64), AfterValidator(_no_reserved_name)
]
Line: TypeAlias = Annotated[str, Field(pattern=LINE_PATTERN, max_length=200)]
EXPRESSION_PATTERN = "^="
QUANTITY_PATTERN = r"^(=|\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)? *[A-Za-zµμ°])"
"""What a JSON Schema can see of expressions and of strings with a unit."""
STRONGEST = 1e100
"""in the deck's unit of stress, of strengths: squares of forces are beyond the range of numbers not far from there"""


@dataclass(frozen=True)
class RealNumber:
    """Annotation of a number field: its dimension (a key of ``mbla.deck.units.DIMENSIONS``) and its bounds."""

    dimension: str
    gt: float | None = None
    ge: float | None = None
    lt: float | None = None
    le: float | None = None

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        number = core_schema.float_schema(
            strict=True, allow_inf_nan=False, gt=self.gt, ge=self.ge, lt=self.lt, le=self.le
        )
        return core_schema.union_schema(
            [number, _from_text(self.dimension, lambda value: value, number)], mode="left_to_right"
        )

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        pattern = EXPRESSION_PATTERN if self.dimension == "number" else QUANTITY_PATTERN
        return {"anyOf": [{"type": "number"} | _bounds(self), {"type": "string", "pattern": pattern}]}


@dataclass(frozen=True)
class WithUnit(RealNumber):
    """Annotation of a number field that takes texts with a unit alone, for what would be too often meant in another."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        number = core_schema.float_schema(gt=self.gt, ge=self.ge, lt=self.lt, le=self.le)
        return core_schema.chain_schema([core_schema.with_info_plain_validator_function(self._number), number])

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        return {"type": "string", "pattern": QUANTITY_PATTERN.replace("=|", "")}

    def _number(self, value: Any, info: core_schema.ValidationInfo) -> float:
        example = DIMENSIONS[self.dimension].example
        if isinstance(value, str) and not value.lstrip().startswith("="):
            return _converted(value, self.dimension, info)
        wrong_values(info.context).add()
        words = f'needs its unit, in a text such as "{example}"'
        raise PydanticCustomError("quantity", "{reason}", {"reason": Message("wrong-unit", words)})


@dataclass(frozen=True)
class UnitOf:
    """Annotation of a text field for a unit of a dimension, in which a file has its numbers: ``cm/s2``.

    examples : to be offered
    """

    dimension: str
    examples: tuple[str, ...]

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        check = core_schema.with_info_plain_validator_function(self._checked)
        return core_schema.chain_schema([core_schema.str_schema(strict=True), check])

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        return {"type": "string", "examples": list(self.examples)}

    def _checked(self, value: str, info: core_schema.ValidationInfo) -> str:
        try:
            _converted(f"1 {value}", self.dimension, info)
        except PydanticCustomError:
            words = f"is no unit of {self.dimension.rpartition('_')[2]}: write {listed(self.examples)}"
            raise PydanticCustomError("quantity", "{reason}", {"reason": Message("wrong-unit", words)}) from None
        return value


@dataclass(frozen=True)
class Integer:
    """Annotation of a field for integers, with its bounds; ``6.0`` and expressions that give 6 are integers."""

    ge: int
    le: int

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        number = core_schema.int_schema(strict=True, ge=self.ge, le=self.le)
        return core_schema.union_schema([number, _from_text("number", _integer, number)], mode="left_to_right")

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        bounds = {"minimum": self.ge, "maximum": self.le}
        return {"anyOf": [{"type": "integer"} | bounds, {"type": "string", "pattern": EXPRESSION_PATTERN}]}


def _bounds(quantity: RealNumber) -> dict[str, float]:
    names = {"gt": "exclusiveMinimum", "ge": "minimum", "lt": "exclusiveMaximum", "le": "maximum"}
    bounds = {name: getattr(quantity, key) for key, name in names.items()}
    return {name: value for name, value in bounds.items() if value is not None}


def _from_text(dimension: str, accept: Callable[[Any], Any], then: CoreSchema) -> CoreSchema:
    """Schema that converts a text, passes the result through ``accept``, and checks the bounds again."""

    def convert(value: Any, info: core_schema.ValidationInfo) -> Any:
        if not isinstance(value, str):
            accepted = accept(value)
            if accepted is value:  # a number that was right would not have come here
                wrong_values(info.context).add()
            return accepted
        return accept(_converted(value, dimension, info))

    return core_schema.chain_schema([core_schema.with_info_plain_validator_function(convert), then])


def _converted(text: str, dimension: str, info: core_schema.ValidationInfo) -> float:
    """A text as a number in the deck's units."""
    function: Callable[[str, str], float] = (info.context or {})["convert"]
    try:
        return function(text, dimension)
    except ParameterFaultError:
        raise PydanticCustomError("reported", "uses a parameter that is at fault itself") from None
    except ValueRefused as error:
        wrong_values(info.context).add()
        raise PydanticCustomError("quantity", "{reason}", {"reason": error.message}) from None


def _integer(value: Any) -> Any:
    """The integer that a float is, up to the rounding of an expression such as 0.3 / 0.1."""
    if isinstance(value, float) and abs(value) < 1e15 and abs(value - round(value)) <= 1e-9 * max(1.0, abs(value)):
        return round(value)
    return value


def _with_direction(vector: tuple[float, ...]) -> tuple[float, ...]:
    if not any(vector):
        raise PydanticCustomError("zero_vector", "must not be the zero vector")
    return vector


def _with_extents(box: tuple[Sequence[float], Sequence[float]]) -> tuple[Sequence[float], Sequence[float]]:
    if findings := list(corners_in_order(*box, 1)):
        raise PydanticCustomError("rules", "breaks a rule", {"findings": findings})
    return box


def corners_in_order(low: Sequence[float], high: Sequence[float], *path: str | int) -> Iterator[Finding]:
    """Findings where a corner in space does not lie beyond the other along every axis; ``path`` is its own."""
    for axis, (least, greatest) in enumerate(zip(low, high, strict=True)):
        if not least < greatest:
            yield Finding("out-of-bounds", f"must be > {least:g}, the {'xyz'[axis]} of the other corner", *path, axis)


Number: TypeAlias = Annotated[float, RealNumber("number")]
NonNegativeNumber: TypeAlias = Annotated[float, RealNumber("number", ge=0)]
PositiveNumber: TypeAlias = Annotated[float, RealNumber("number", gt=0)]
Share: TypeAlias = Annotated[float, RealNumber("number", gt=0, le=1)]
Length: TypeAlias = Annotated[float, RealNumber("length")]
PositiveLength: TypeAlias = Annotated[float, RealNumber("length", gt=0)]
NonNegativeLength: TypeAlias = Annotated[float, RealNumber("length", ge=0)]
Force: TypeAlias = Annotated[float, RealNumber("force")]
PositiveForce: TypeAlias = Annotated[float, RealNumber("force", gt=0)]
PositiveArea: TypeAlias = Annotated[float, RealNumber("area", gt=0)]
Moment: TypeAlias = Annotated[float, RealNumber("moment")]
ForcePerLength: TypeAlias = Annotated[float, RealNumber("force_per_length")]
PositiveMass: TypeAlias = Annotated[float, RealNumber("mass", gt=0)]
Stress: TypeAlias = Annotated[float, RealNumber("stress")]
UnitWeight: TypeAlias = Annotated[float, RealNumber("unit_weight")]
NonNegativeStress: TypeAlias = Annotated[float, RealNumber("stress", ge=0, le=STRONGEST)]
PositiveStress: TypeAlias = Annotated[float, RealNumber("stress", gt=0, le=STRONGEST)]
PositiveDensity: TypeAlias = Annotated[float, RealNumber("density", gt=0)]
PositiveUnitWeight: TypeAlias = Annotated[float, RealNumber("unit_weight", gt=0)]
PositiveStiffness: TypeAlias = Annotated[float, RealNumber("stiffness_per_area", gt=0, le=STRONGEST)]
Acceleration: TypeAlias = Annotated[float, RealNumber("acceleration")]
Angle: TypeAlias = Annotated[float, RealNumber("angle")]
FacingAngle: TypeAlias = Annotated[float, RealNumber("angle", gt=0, le=90)]
FrictionAngle: TypeAlias = Annotated[float, RealNumber("angle", ge=0, lt=90)]
EmbraceAngle: TypeAlias = Annotated[float, RealNumber("angle", gt=0, lt=360)]
SideAngle: TypeAlias = Annotated[float, RealNumber("angle", gt=0, lt=90)]
SpreadAngle: TypeAlias = Annotated[float, RealNumber("angle", gt=0, le=60)]
WallFrictionAngle: TypeAlias = Annotated[float, RealNumber("angle", gt=-90, lt=90)]
SkewAngle: TypeAlias = Annotated[float, RealNumber("angle", gt=-80, lt=80)]
Time: TypeAlias = Annotated[float, RealNumber("time", gt=0)]
NonNegativeTime: TypeAlias = Annotated[float, RealNumber("time", ge=0)]
BaseAcceleration: TypeAlias = Annotated[float, WithUnit("base_acceleration", gt=0)]
UnitOfAcceleration: TypeAlias = Annotated[str, UnitOf("base_acceleration", ("g", "m/s2", "cm/s2"))]
UnitOfForce: TypeAlias = Annotated[str, UnitOf("force", ("N", "kN"))]
Index: TypeAlias = Annotated[int, Integer(ge=0, le=2**31 - 1)]
Position: TypeAlias = Annotated[int, Integer(ge=-(2**31), le=2**31 - 1)]
Count: TypeAlias = Annotated[int, Integer(ge=1, le=1_000_000)]
Positions: TypeAlias = Annotated[int, Integer(ge=2, le=1000)]
Switch: TypeAlias = Annotated[bool, Field(strict=True)]
Point: TypeAlias = tuple[Length, Length, Length]
PlanePoint: TypeAlias = tuple[Length, Length]
Vector: TypeAlias = tuple[Number, Number, Number]
Direction: TypeAlias = Annotated[Vector, AfterValidator(_with_direction)]
Box: TypeAlias = Annotated[tuple[Point, Point], AfterValidator(_with_extents)]
"""Least and greatest coordinates."""
