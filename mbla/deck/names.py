"""Text fields of the deck: names that other parts of it refer to, and free lines of text."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import Field

NAME_PATTERN = r"^[A-Za-z0-9_][A-Za-z0-9_.-]*$"
PARAMETER_PATTERN = r"^[A-Za-z_][A-Za-z0-9_]*$"
LINE_PATTERN = r"^.*$"

PATTERNS = {
    NAME_PATTERN: "a name has letters, digits and . _ - only, and begins with a letter, digit or _",
    PARAMETER_PATTERN: "the name of a parameter has letters, digits and _ only, and does not begin with a digit",
    LINE_PATTERN: "must be on one line",
}
"""What each pattern allows, in words."""

Name: TypeAlias = Annotated[str, Field(pattern=NAME_PATTERN, max_length=64)]
ParameterName: TypeAlias = Annotated[str, Field(pattern=PARAMETER_PATTERN, max_length=64)]
Line: TypeAlias = Annotated[str, Field(pattern=LINE_PATTERN, max_length=200)]
