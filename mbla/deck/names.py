"""Text fields of the deck: names that other parts of it refer to, and free lines of text."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import AfterValidator, Field
from pydantic_core import PydanticCustomError

from mbla.deck.expressions import CONSTANTS, FUNCTIONS

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
