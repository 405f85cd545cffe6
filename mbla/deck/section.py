"""Base of all mappings of the deck, and the register of checks that need more than one key of a mapping.

A rule gets a section whose own keys are all valid and yields what is wrong below it; names across sections are in
``references``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
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

from mbla.deck.suggestions import listed
from mbla.errors import MOST_FAULTS, Finding
from mbla.process.signals import held_signals

MOST_WRONG = 20 * MOST_FAULTS
"""values that may be wrong before no more of them are looked at"""
WRONG = "wrong"
"""of the context of a check, under which it has its ``WrongValues``"""
ROUNDING = 1e-9
"""Relative: sums of lengths such as 6 x 0.175 are not exact in binary."""

Rule: TypeAlias = Callable[[Any], Iterator[Finding]]
R = TypeVar("R", bound=Rule)
Model = TypeVar("Model", bound=BaseModel)

RULES: dict[type, list[Rule]] = {}
"""By the type of section that they check; they hold for the types made from it too."""
EXACTLY_ONE: dict[type, tuple[str, ...]] = {}
"""Keys of which a section has exactly one; the schema says so too."""
AT_LEAST_ONE: dict[type, tuple[str, ...]] = {}
"""Keys of which a section has one or more; the schema says so too."""
KINDS: dict[type, str] = {}
"""What the keys are where they are too many for one line; messages then leave the list to the key reference."""


def rule(*sections: type) -> Callable[[R], R]:
    """Register a check that runs on every section of some types whose own keys are all valid."""

    def register(function: R) -> R:
        for section in sections:
            RULES.setdefault(section, []).append(function)
        return function

    return register


def exactly_one_of(*keys: str, kind: str = "") -> Callable[[type[Model]], type[Model]]:
    """A section has exactly one of some keys, of all its keys if none is named; ``kind`` as in ``KINDS``."""

    def register(section: type[Model]) -> type[Model]:
        chosen = EXACTLY_ONE[section] = keys or tuple(section.model_fields)
        if kind:
            KINDS[section] = kind
        rule(section)(lambda item: one_of(item, chosen, kind=kind))
        return section

    return register


def at_least_one_of(*keys: str) -> Callable[[type[Model]], type[Model]]:
    """A section has one or more of some keys."""

    def register(section: type[Model]) -> type[Model]:
        AT_LEAST_ONE[section] = keys
        rule(section)(lambda item: some_of(item, keys))
        return section

    return register


class TooManyWrongError(Exception):
    """So much is wrong that nobody corrects it fault by fault."""


@dataclass
class WrongValues:
    """Number of wrong values that a check has found so far, and the first mappings with what is wrong in each.

    The library that checks builds an error for every wrong value, of which only the first ``MOST_FAULTS`` are told: a
    list of a million wrong items would take gigabytes. An exception of ours that is no ValueError ends it at once.
    """

    number: int = 0
    mappings: list[tuple[dict[str, Any], ValidationError]] = field(default_factory=list)

    def add(self, number: int = 1) -> None:
        """Count wrong values.

        Raises
        ------
        TooManyWrongError
            for more than ``MOST_WRONG``
        """
        self.number += number
        if self.number > MOST_WRONG:
            raise TooManyWrongError

    def add_section(self, value: Any, error: ValidationError, before: int) -> None:
        """Count what is wrong in a section beside what was counted in it; ``before`` is the number at its beginning."""
        if isinstance(value, dict) and len(self.mappings) <= MOST_FAULTS:
            self.mappings.append((value, error))
        self.add(max(error.error_count() - (self.number - before), 0))


def wrong_values(context: dict[str, Any] | None) -> WrongValues:
    """Those of a check by its context; new ones where it does not count."""
    found = (context or {}).get(WRONG)
    return found if isinstance(found, WrongValues) else WrongValues()


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
        findings = [finding for kind in cls.__mro__ for check in RULES.get(kind, ()) for finding in check(section)]
        if findings:
            wrong.add()
            raise PydanticCustomError("rules", "breaks a rule", {"findings": findings})
        return section


def built(kind: type[Model]) -> type[Model]:
    """A type whose validator is there; signals wait, as pydantic tells an interruption as a fault of the type."""
    with held_signals():
        kind.model_rebuild()
    return kind


def shape(value: Any) -> str:
    """Which branch of a union a value of the deck belongs to, so that a fault in it is reported once."""
    return "mapping" if isinstance(value, (dict, Section)) else "list" if isinstance(value, list) else "name"


# --- what rules share ---------------------------------------------------------------------------------------------


def given(section: Any, keys: Sequence[str]) -> list[str]:
    """Those of the keys that a section has."""
    return [key for key in keys if getattr(section, key) is not None]


def one_of(section: Any, keys: Sequence[str], what: str = "", kind: str = "") -> Iterator[Finding]:
    """Findings where a section has none or several of some keys.

    what : ends the sentence
    kind : stands for the list of keys, where they are too many for one line
    """
    found = given(section, keys)
    if not found:
        some = (
            f"one {kind}, such as {listed(keys[:3])}: the key reference lists all" if kind else f"one of {listed(keys)}"
        )
        yield Finding("missing-key", f"needs {some}{what}")
    elif len(found) > 1:
        one = f"one {kind}" if kind else f"one of {listed(keys)}"
        yield Finding("one-of-several", f"only {one} may be given{what}, here are {listed(found, 'and')}", found[1])


def some_of(section: Any, keys: Sequence[str]) -> Iterator[Finding]:
    """A finding where a section has none of some keys."""
    if not given(section, keys):
        yield Finding("missing-key", f"needs one of {listed(keys)}")
