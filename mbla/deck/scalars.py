"""Plain YAML scalars by the core schema of YAML 1.2 (https://yaml.org/spec/1.2.2/#103-core-schema).

Unlike YAML 1.1: ``1e3`` is a number, ``017`` is seventeen, ``no``, ``on``, dates and ``12:30:45`` are text.
"""

from __future__ import annotations

import re
from typing import TypeAlias

from mbla.errors import ValueRefused

Scalar: TypeAlias = str | int | float | bool | None

_NUMBER = re.compile(
    r"(?P<int>[-+]?[0-9]+)|(?P<float>[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?)"
    r"|(?P<octal>0o[0-7]+)|(?P<hex>0x[0-9a-fA-F]+)|(?P<nonfinite>[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN))"
)
_NUMBER_START = frozenset("+-.0123456789")
_WORDS: dict[str, Scalar] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}
_EXACT = 2**53
"""Up to here every whole number is a float too; beyond, the deck's numbers are floats."""


def plain_scalar(text: str) -> Scalar:
    """Value of an unquoted scalar.

    Raises
    ------
    ValueRefused
        for infinity, not-a-number, and numbers too large for double precision
    """
    if text[:1] not in _NUMBER_START or (match := _NUMBER.fullmatch(text)) is None:
        return _WORDS.get(text, text)
    kind = match.lastgroup
    if kind == "float":
        return _finite(float(text))
    if kind == "nonfinite":
        raise ValueRefused("not-a-number", "must be a finite number")
    if kind == "int" and len(text) <= 15:
        return int(text)
    base = {"int": 10, "octal": 8, "hex": 16}[kind or "int"]
    if len(text) > 400:  # int() itself refuses more than 4300 digits; nothing finite has as many as 400
        raise ValueRefused("not-a-number", "is too large for a number")
    number = int(text, base if base == 10 else 0)
    if abs(number) <= _EXACT:
        return number
    try:
        return _finite(float(number))
    except OverflowError:
        raise ValueRefused("not-a-number", "is too large for a number") from None


def _finite(number: float) -> float:
    if abs(number) == float("inf"):
        raise ValueRefused("not-a-number", "is too large for a number")
    return number
