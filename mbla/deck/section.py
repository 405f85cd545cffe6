"""Base of all mappings of the deck, and the register of checks that need more than one key of a mapping."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, TypeAlias, TypeVar

from pydantic import BaseModel, ConfigDict, ValidationInfo, model_validator
from pydantic_core import PydanticCustomError

from mbla.errors import Message

Finding: TypeAlias = tuple[tuple[str | int, ...], Message]
"""Key path below the section, and what is wrong there."""
Rule: TypeAlias = Callable[[Any], Iterator[Finding]]

RULES: dict[type, list[Rule]] = {}
S = TypeVar("S")


def rule(section: type[S]) -> Callable[[Callable[[S], Iterator[Finding]]], Callable[[S], Iterator[Finding]]]:
    """Register a check that runs on every section of a type whose own keys are all valid."""

    def register(function: Callable[[S], Iterator[Finding]]) -> Callable[[S], Iterator[Finding]]:
        RULES.setdefault(section, []).append(function)
        return function

    return register


class Section(BaseModel):
    """A mapping of the deck: unknown keys are refused, nothing changes after reading."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)

    @model_validator(mode="after")
    def _check_rules(self, info: ValidationInfo) -> Section:
        if rules := RULES.get(type(self)):
            findings = [finding for check in rules for finding in check(self)]
            if findings:
                raise PydanticCustomError("rules", "breaks a rule", {"findings": findings})
        return self


def shape(value: Any) -> str:
    """Which branch of a union a value of the deck belongs to, so that a fault in it is reported once."""
    return "mapping" if isinstance(value, (dict, Section)) else "list" if isinstance(value, list) else "name"
