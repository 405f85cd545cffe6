"""Number fields of the deck: a plain number in the deck's units, or a string with a unit that is converted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any, TypeAlias

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema


@dataclass(frozen=True)
class Quantity:
    """Annotation of a number field: its dimension (a key of ``mbla.deck.units.DIMENSIONS``) and its bounds.

    Numbers are checked by pydantic's compiled code, so that large vertex lists cost nothing; only strings come here.
    The validation context must hold ``convert``, a function (text, dimension) -> number in the deck's units.
    """

    dimension: str
    gt: float | None = None
    ge: float | None = None
    lt: float | None = None
    le: float | None = None

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        number = core_schema.float_schema(
            strict=True, allow_inf_nan=False, gt=self.gt, ge=self.ge, lt=self.lt, le=self.le
        )
        text = core_schema.chain_schema(
            [core_schema.with_info_plain_validator_function(self._from_text), number],
        )
        return core_schema.union_schema([number, text], mode="left_to_right")

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        bounds = {
            "exclusiveMinimum": self.gt,
            "minimum": self.ge,
            "exclusiveMaximum": self.lt,
            "maximum": self.le,
        }
        number = {"type": "number"} | {key: value for key, value in bounds.items() if value is not None}
        return {"anyOf": [number, {"type": "string"}]}

    def _from_text(self, text: Any, info: core_schema.ValidationInfo) -> float:
        if not isinstance(text, str):
            raise PydanticCustomError("not_a_number", "must be a number")
        convert: Callable[[str, str], float] = (info.context or {})["convert"]
        try:
            return convert(text, self.dimension)
        except ValueError as error:
            raise PydanticCustomError("quantity", "{reason}", {"reason": str(error)}) from None


Number: TypeAlias = Annotated[float, Quantity("number")]
NonNegativeNumber: TypeAlias = Annotated[float, Quantity("number", ge=0)]
PositiveNumber: TypeAlias = Annotated[float, Quantity("number", gt=0)]
Length: TypeAlias = Annotated[float, Quantity("length")]
PositiveLength: TypeAlias = Annotated[float, Quantity("length", gt=0)]
Force: TypeAlias = Annotated[float, Quantity("force")]
NonNegativeStress: TypeAlias = Annotated[float, Quantity("stress", ge=0)]
PositiveStress: TypeAlias = Annotated[float, Quantity("stress", gt=0)]
PositiveDensity: TypeAlias = Annotated[float, Quantity("density", gt=0)]
PositiveUnitWeight: TypeAlias = Annotated[float, Quantity("unit_weight", gt=0)]
Acceleration: TypeAlias = Annotated[float, Quantity("acceleration")]
Angle: TypeAlias = Annotated[float, Quantity("angle")]
FrictionAngle: TypeAlias = Annotated[float, Quantity("angle", ge=0, lt=90)]
EmbraceAngle: TypeAlias = Annotated[float, Quantity("angle", gt=0, lt=360)]
Time: TypeAlias = Annotated[float, Quantity("time", gt=0)]
