"""Base of all mappings of the deck, and the register of checks that need more than one key of a mapping."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, TypeAlias, TypeVar

from pydantic import (
    BaseModel,
    ConfigDict,
    ModelWrapValidatorHandler,
    ValidationError,
    ValidationInfo,
    model_validator,
)
from pydantic_core import PydanticCustomError

from mbla.deck.wrong_values import wrong_values
from mbla.errors import Message
from mbla.process.signals import held_signals

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


Model = TypeVar("Model", bound=BaseModel)


def built(kind: type[Model]) -> type[Model]:
    """A type whose validator is there; signals wait, as pydantic tells an interruption as a fault of the type."""
    with held_signals():
        kind.model_rebuild()
    return kind


class Section(BaseModel):
    """A mapping of the deck: unknown keys are refused, nothing changes after reading."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)

    @model_validator(mode="wrap")
    @classmethod
    def _check(cls, value: Any, handler: ModelWrapValidatorHandler[Section], info: ValidationInfo) -> Section:
        wrong = wrong_values(info.context)
        before = wrong.number
        try:
            section = handler(value)
        except ValidationError as error:
            wrong.add_section(value, error, before)
            raise
        if rules := RULES.get(cls):
            findings = [finding for check in rules for finding in check(section)]
            if findings:
                wrong.add()
                raise PydanticCustomError("rules", "breaks a rule", {"findings": findings})
        return section


def shape(value: Any) -> str:
    """Which branch of a union a value of the deck belongs to, so that a fault in it is reported once."""
    return "mapping" if isinstance(value, (dict, Section)) else "list" if isinstance(value, list) else "name"
