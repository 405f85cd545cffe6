"""``"=..."`` strings: arithmetic over the deck's parameters, evaluated on a short list of Python's syntax nodes.

Every number is a float; a result that is not finite, or an operation that Python refuses, is an error. Nothing but
the names and nodes listed here is ever looked at, so that a deck from a stranger cannot do more than arithmetic.
"""

from __future__ import annotations

import ast
import math
import operator
import warnings
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from mbla.deck.suggestions import unknown

MAX_LENGTH = 300
MAX_DEPTH = 40
MAX_CHAIN = 64
"""Parameters that a parameter may pass through; nobody reads longer chains."""

CONSTANTS: dict[str, float] = {"pi": math.pi, "e": math.e}
FUNCTIONS: dict[str, Callable[..., float]] = {
    "sqrt": math.sqrt,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "atan2": math.atan2,
    "exp": math.exp,
    "log": math.log,
    "abs": abs,
    "min": min,
    "max": max,
    "floor": math.floor,
    "ceil": math.ceil,
    "round": round,
    "radians": math.radians,
    "degrees": math.degrees,
}
_ARGUMENTS = {"atan2": (2, 2), "log": (1, 2), "min": (2, 16), "max": (2, 16)}
_BINARY: dict[type[ast.operator], Callable[[float, float], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
}
_UNARY: dict[type[ast.unaryop], Callable[[float], float]] = {ast.UAdd: operator.pos, ast.USub: operator.neg}


class ExpressionError(ValueError):
    """The expression cannot be evaluated; the message says why."""


class ParameterFaultError(ExpressionError):
    """The expression uses a parameter whose own fault is reported where it is defined."""


def is_expression(value: object) -> bool:
    """Whether a value of the deck is to be evaluated."""
    return isinstance(value, str) and value.startswith("=")


class Parameters:
    """Values of the deck's parameters, each evaluated when first used."""

    def __init__(self, raw: Mapping[str, object]) -> None:
        """``raw`` maps names to numbers, ``"=..."`` strings, or whatever else the deck holds there."""
        self._raw = raw
        self._values: dict[str, float] = {}
        self._failures: dict[str, str] = {}
        self._active: list[str] = []
        self.used: set[str] = set()

    def evaluate(self, text: str) -> float:
        """Value of an ``"=..."`` string.

        Raises
        ------
        ExpressionError
            with what is wrong; ParameterFaultError where a parameter is, rather than this expression
        """
        return _evaluate(_parse(text), self._value, 0)

    def failures(self) -> list[tuple[str, str]]:
        """(name, message) of every parameter whose own expression is at fault."""
        for name, raw in self._raw.items():
            if is_expression(raw):
                with suppress(ExpressionError):  # kept under the name of the parameter that is to blame
                    self._evaluated(name)
        return list(self._failures.items())

    def _value(self, name: str) -> float:
        if name in CONSTANTS:
            return CONSTANTS[name]
        if name not in self._raw:
            if name in FUNCTIONS:
                raise ExpressionError(f"{name} is a function: write {name}(...)")
            raise ExpressionError(unknown(f"parameter {name}", name, [*self._raw, *CONSTANTS], "known"))
        self.used.add(name)
        return self._evaluated(name)

    def _evaluated(self, name: str) -> float:
        if name not in self._values:
            self._values[name] = self._resolve(name)
        return self._values[name]

    def _resolve(self, name: str) -> float:
        raw = self._raw[name]
        if isinstance(raw, (int, float)) and not isinstance(raw, bool):
            return float(raw)
        if name in self._failures or not isinstance(raw, str) or not is_expression(raw):
            raise ParameterFaultError(f"parameter {name} has no value")
        if name in self._active:
            cycle = [*self._active[self._active.index(name) :], name]
            self._failures[min(cycle, key=list(self._raw).index)] = f"refers to itself: {' -> '.join(cycle)}"
            raise ParameterFaultError(f"parameter {name} refers to itself")
        if len(self._active) >= MAX_CHAIN:
            raise ExpressionError(f"passes through more than {MAX_CHAIN} parameters")
        self._active.append(name)
        try:
            return self.evaluate(raw)
        except ParameterFaultError:
            raise
        except ExpressionError as error:
            self._failures[name] = str(error)
            raise ParameterFaultError(f"parameter {name} has no value") from None
        finally:
            self._active.pop()


def _parse(text: str) -> ast.expr:
    source = text[1:].strip()
    if not source:
        raise ExpressionError("is an expression without content: write a number or an expression after the =")
    if len(source) > MAX_LENGTH:
        raise ExpressionError(f"is an expression of more than {MAX_LENGTH} characters")
    if "^" in source:
        raise ExpressionError("^ is not an operator of expressions: write ** for powers")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Python's remarks on style ("1if") are not for the user of a deck
            return ast.parse(source, mode="eval").body
    except (SyntaxError, ValueError, MemoryError, RecursionError) as error:
        reason = getattr(error, "msg", None) or "too deeply nested"
        raise ExpressionError(f"cannot be read as an expression: {reason}") from None


def _evaluate(node: ast.expr, value_of: Callable[[str], float], depth: int) -> float:
    """Value of a syntax node, by recursion; ``depth`` bounds it."""
    if depth > MAX_DEPTH:
        raise ExpressionError(f"is an expression nested more than {MAX_DEPTH} levels deep")
    match node:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            return _number(float, (value,), "number")
        case ast.Name(id=name):
            return value_of(name)
        case ast.UnaryOp(op=sign, operand=operand) if type(sign) in _UNARY:
            return _UNARY[type(sign)](_evaluate(operand, value_of, depth + 1))
        case ast.BinOp(left=left, op=sign, right=right) if type(sign) in _BINARY:
            operands = (_evaluate(left, value_of, depth + 1), _evaluate(right, value_of, depth + 1))
            return _number(_BINARY[type(sign)], operands, "operation")
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]):
            return _call(name, [_evaluate(argument, value_of, depth + 1) for argument in args])
        case _:
            raise ExpressionError(
                "holds something other than numbers, parameters, + - * / % **, parentheses and functions "
                f"({', '.join(FUNCTIONS)})"
            )


def _call(name: str, arguments: list[float]) -> float:
    if name not in FUNCTIONS:
        raise ExpressionError(unknown(f"function {name}", name, FUNCTIONS))
    least, most = _ARGUMENTS.get(name, (1, 1))
    if not least <= len(arguments) <= most:
        wanted = str(least) if least == most else f"{least} to {most}"
        raise ExpressionError(f"{name} takes {wanted} argument{'s' if most > 1 else ''}, has {len(arguments)}")
    return _number(FUNCTIONS[name], arguments, name)


def _number(function: Callable[..., Any], arguments: Any, name: str) -> float:
    """Finite real result of an operation."""
    try:
        result = function(*arguments)
    except ZeroDivisionError:
        raise ExpressionError("divides by zero") from None
    except OverflowError:
        raise ExpressionError("gives a number that is too large") from None
    except ValueError:
        shown = ", ".join(f"{argument:g}" for argument in arguments)
        raise ExpressionError(f"{name}({shown}) is not defined") from None
    if isinstance(result, complex):
        raise ExpressionError("gives a root of a negative number")
    if not math.isfinite(result):
        raise ExpressionError("gives a number that is too large")
    return float(result)
