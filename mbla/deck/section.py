"""Base of all mappings of the deck, and the register of checks that need more than one key of a mapping.

A rule gets a section whose own keys are all valid and yields what is wrong below it; names across sections are in
``references``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, TypeAlias, TypeVar, get_args, get_origin

from pydantic import (
    BaseModel,
    ConfigDict,
    GetCoreSchemaHandler,
    ModelWrapValidatorHandler,
    TypeAdapter,
    ValidationError,
    ValidationInfo,
    create_model,
    model_validator,
)
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from mbla.deck.suggestions import listed
from mbla.errors import MOST_FAULTS, Finding
from mbla.process.signals import held_signals

MOST_WRONG = 20 * MOST_FAULTS
"""values that may be wrong before no more of them are examined"""
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


def rule(*sections: type) -> Callable[[R], R]:
    """Register a check that runs on every section of some types whose own keys are all valid."""

    def register(function: R) -> R:
        for section in sections:
            RULES.setdefault(section, []).append(function)
        return function

    return register


def exactly_one_of(*keys: str) -> Callable[[type[Model]], type[Model]]:
    """A section has exactly one of some keys, of all its keys if none is named."""

    def register(section: type[Model]) -> type[Model]:
        chosen = EXACTLY_ONE[section] = keys or tuple(section.model_fields)
        rule(section)(lambda item: one_of(item, chosen))
        return section

    return register


def with_keys(keys: Mapping[str, tuple[Any, Any]]) -> Callable[[type[Model]], type[Model]]:
    """A section with further keys: by attribute, the type of the value, and default or field."""

    def extended(section: type[Model]) -> type[Model]:
        fields: dict[str, Any] = dict(keys)
        return create_model(
            section.__name__, __base__=section, __module__=section.__module__, __doc__=section.__doc__, **fields
        )

    return extended


class TooManyWrongError(Exception):
    """Too many faults to be corrected one by one."""


@dataclass
class WrongValues:
    """Number of wrong values that a check has found so far.

    The library that checks builds an error for every wrong value: a list of a million wrong items would take
    gigabytes. An exception of ours that is no ValueError ends it at once.
    """

    number: int = 0

    def add(self, number: int = 1) -> None:
        """Count wrong values.

        Raises TooManyWrongError for more than ``MOST_WRONG``.
        """
        self.number += number
        if self.number > MOST_WRONG:
            raise TooManyWrongError


def wrong_values(context: dict[str, Any] | None) -> WrongValues:
    """Those of a check by its context; new ones where it does not count."""
    found = (context or {}).get(WRONG)
    return found if isinstance(found, WrongValues) else WrongValues()


_built: ContextVar[type | None] = ContextVar("section", default=None)
"""whose validator is being made by ``validator``"""


class Section(BaseModel):
    """A mapping of the deck: unknown keys are refused, nothing changes after reading.

    The validator of a section within another is made when a deck first has one: most decks have few of them.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        if _built.get() in (None, cls):
            return handler(source)

        def check(value: Any, info: core_schema.ValidationInfo) -> Any:
            return validator(cls).validate_python(value, context=info.context)

        return core_schema.with_info_plain_validator_function(check)

    @model_validator(mode="wrap")
    @classmethod
    def _check(cls, value: Any, handler: ModelWrapValidatorHandler[Section], info: ValidationInfo) -> Section:
        wrong = wrong_values(info.context)
        before = wrong.number
        try:
            section = handler(value)
        except ValidationError as error:
            wrong.add(max(error.error_count() - (wrong.number - before), 0))  # besides what was counted below it
            raise
        findings = [finding for kind in cls.__mro__ for check in RULES.get(kind, ()) for finding in check(section)]
        if findings:
            wrong.add()
            raise PydanticCustomError("rules", "breaks a rule", {"findings": findings})
        return section


@cache
def validator(kind: type[Model]) -> TypeAdapter[Model]:
    """What checks values of a type; signals wait, as pydantic reports an interruption as a fault of the type."""
    with held_signals():
        token = _built.set(kind)
        try:
            adapter = TypeAdapter(kind)
            adapter.rebuild()
        finally:
            _built.reset(token)
    return adapter


@dataclass(frozen=True)
class ByShape:
    """Annotation of a union of a single value, a mapping and a list, one of each at most: the shape of a value of the
    deck decides which it belongs to, so that a fault in it is reported once.

    otherwise : name, mapping or list: what a value of another shape is taken for
    """

    otherwise: str

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        branches = {_shape_of_type(branch): handler.generate_schema(branch) for branch in get_args(source)}
        return core_schema.tagged_union_schema(
            branches, discriminator=lambda value: found if (found := _shape(value)) in branches else self.otherwise
        )


def _shape(value: Any) -> str:
    return "mapping" if isinstance(value, (dict, Section)) else "list" if isinstance(value, (list, tuple)) else "name"


def _shape_of_type(annotation: Any) -> str:
    """Of the values of a type."""
    if get_origin(annotation) is Annotated:
        return _shape_of_type(get_args(annotation)[0])
    if get_origin(annotation) in (list, tuple):
        return "list"
    return "mapping" if isinstance(annotation, type) and issubclass(annotation, BaseModel) else "name"


# --- what rules share ---------------------------------------------------------------------------------------------


def given(section: Any, keys: Sequence[str]) -> list[str]:
    """Those of the keys that a section has."""
    return [key for key in keys if getattr(section, key) is not None]


def one_of(section: Any, keys: Sequence[str], what: str = "") -> Iterator[Finding]:
    """Findings where a section has none or several of some keys; ``what`` ends the sentence."""
    found = given(section, keys)
    if not found:
        yield Finding("missing-key", f"needs one of {listed(keys)}{what}")
    elif len(found) > 1:
        words = f"only one of {listed(keys)} may be given{what}, here are {listed(found, 'and')}"
        yield Finding("one-of-several", words, found[1])
