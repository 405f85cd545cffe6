"""Comparisons of expressions, such as ``t < 0.2*radius``: true or false of values by name."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable
from dataclasses import dataclass

from mbla.deck.expressions import ExpressionError, evaluate, parse_source

_KEY_PATH = re.compile(r"(?<![\w.])[A-Za-z_]\w*(?:\.\w+)+")
_ASSIGNMENT = re.compile(r"(?<![<>=!])=(?!=)")
EQUAL = 1e-9
"""relative: numbers that differ by less are equal in comparisons, as 3 x 1.1 is not 3.3 in binary"""
_ORDER: dict[type[ast.cmpop], Callable[[float, float, bool], bool]] = {
    ast.Lt: lambda left, right, equal: left < right and not equal,
    ast.LtE: lambda left, right, equal: left < right or equal,
    ast.Gt: lambda left, right, equal: left > right and not equal,
    ast.GtE: lambda left, right, equal: left > right or equal,
    ast.Eq: lambda left, right, equal: equal,
}


@dataclass(frozen=True)
class ParameterComparison:
    """A comparison such as ``t < 0.2*radius``, or a chain of them, ``0.1 < t <= 0.5``.

    names : in it, in order, without those of functions that it calls
    """

    text: str
    names: tuple[str, ...]
    _node: ast.Compare

    def holds(self, value_of: Callable[[str], float]) -> bool:
        """Whether it is true of values by name; ExpressionError where it has no value."""
        left = evaluate(self._node.left, value_of, 1)
        holds = True
        for sign, node in zip(self._node.ops, self._node.comparators, strict=True):
            right = evaluate(node, value_of, 1)
            equal = abs(left - right) <= EQUAL * max(abs(left), abs(right))
            holds = holds and _ORDER[type(sign)](left, right, equal)
            left = right
        return holds


def read_comparison(text: str) -> ParameterComparison:
    """A comparison from its text.

    Raises ExpressionError with what is wrong; names are not looked up.
    """
    source = text.strip().removeprefix("=")
    if path := _KEY_PATH.search(source):
        words = f"{path.group()} is no name of letters, digits and _: give that parameter one, with its key"
        raise ExpressionError("wrong-comparison", words)
    if _ASSIGNMENT.search(source):
        raise ExpressionError("wrong-comparison", "= compares nothing: write == for equal numbers")
    node = parse_source(source)
    if isinstance(node, ast.BoolOp):
        raise ExpressionError(
            "wrong-comparison", "joins comparisons by and/or: write each as one of its own; all of them must hold"
        )
    if not isinstance(node, ast.Compare):
        raise ExpressionError("wrong-comparison", 'is no comparison: write one such as "t < 0.2*radius"')
    for sign in node.ops:
        if type(sign) not in _ORDER:
            raise ExpressionError("wrong-comparison", "compares by something other than < <= > >= ==")
    called = {part.func for part in ast.walk(node) if isinstance(part, ast.Call)}
    named = [part for part in ast.walk(node) if isinstance(part, ast.Name) and part not in called]
    named.sort(key=lambda part: (part.lineno, part.col_offset))
    return ParameterComparison(text, tuple(dict.fromkeys(part.id for part in named)), node)
