"""``"=..."`` strings: arithmetic over the deck's parameters, evaluated on a short list of Python's syntax nodes.

Angles are in degrees, as everywhere in a deck: ``sin``, ``cos`` and ``tan`` take them, ``asin``, ``acos``, ``atan`` and
``atan2`` give them. ``pi`` in the angle of a function is refused, for it was meant for radians.

Every number is a float; a result that is not finite, or an operation that Python refuses, is an error. Nothing but
the names and nodes listed here is ever evaluated, so that a deck from a stranger cannot do more than arithmetic.
"""

from __future__ import annotations

import ast
import math
import operator
import warnings
from collections.abc import Callable, Mapping
from graphlib import CycleError, TopologicalSorter
from typing import Any

from mbla.deck.suggestions import unknown
from mbla.errors import Message, ValueRefused

MAX_LENGTH = 300
MAX_DEPTH = 40
_LONGEST_CYCLE = 10

CONSTANTS: dict[str, float] = {"pi": math.pi, "e": math.e}
OF_ANGLES: dict[str, Callable[[float], float]] = {
    "sin": lambda angle: math.sin(math.radians(angle)),
    "cos": lambda angle: math.cos(math.radians(angle)),
    "tan": lambda angle: math.tan(math.radians(angle)),
}
FUNCTIONS: dict[str, Callable[..., float]] = {
    "sqrt": math.sqrt,
    **OF_ANGLES,
    "asin": lambda sine: math.degrees(math.asin(sine)),
    "acos": lambda cosine: math.degrees(math.acos(cosine)),
    "atan": lambda tangent: math.degrees(math.atan(tangent)),
    "atan2": lambda y, x: math.degrees(math.atan2(y, x)),
    "exp": math.exp,
    "log": math.log,
    "abs": abs,
    "min": min,
    "max": max,
    "floor": math.floor,
    "ceil": math.ceil,
    "round": round,
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


class ExpressionError(ValueRefused):
    """The expression cannot be evaluated; the message says why."""


def _wrong(words: str) -> ExpressionError:
    return ExpressionError("wrong-expression", words)


class ParameterFaultError(ExpressionError):
    """The expression uses a parameter whose own fault is reported where it is defined."""


def is_expression(value: object) -> bool:
    """Whether a value of the deck is to be evaluated."""
    return isinstance(value, str) and value.startswith("=")


class Parameters:
    """Values of the deck's parameters.

    A parameter without a value is either to blame for it (``failures``, with what is wrong) or depends on one that is.
    """

    def __init__(self, raw: Mapping[str, object]) -> None:
        """``raw`` maps names to numbers, ``"=..."`` strings, or whatever else the deck holds there."""
        self._raw = raw
        self._values: dict[str, float] = {}
        self._failures: dict[str, Message] = {}
        self._expressions: dict[str, ast.expr] = {}
        for name, value in raw.items():
            if isinstance(value, str) and is_expression(value):
                try:
                    self._expressions[name] = parse_source(value[1:])
                except ExpressionError as error:
                    self._failures[name] = error.message
        self._needs = {name: self._parameters_in(expression) for name, expression in self._expressions.items()}
        self.used = {name for needed in self._needs.values() for name in needed}
        for name in self._in_order():
            self._settle(name)

    def evaluate(self, text: str) -> float:
        """Value of an ``"=..."`` string.

        Raises ExpressionError with what is wrong; ParameterFaultError where a parameter is, rather than this
        expression.
        """
        expression = parse_source(text[1:])
        self.used.update(self._parameters_in(expression))
        return evaluate(expression, self.value, 0)

    def value(self, name: str) -> float:
        """Value of a name: of a parameter or a constant.

        Raises ExpressionError if there is none; ParameterFaultError where the parameter itself is at fault.
        """
        if name in CONSTANTS:
            return CONSTANTS[name]
        if name in self._values:
            return self._values[name]
        if name in self._raw:
            raise ParameterFaultError("wrong-expression", f"parameter {name} has no value")
        if name in FUNCTIONS:
            raise _wrong(f"{name} is a function: write {name}(...)")
        raise ExpressionError("unknown-name", unknown(f"parameter {name}", name, [*self._raw, *CONSTANTS], "known"))

    def failures(self) -> list[tuple[str, Message]]:
        """(name, message) of every parameter whose own expression is at fault."""
        return list(self._failures.items())

    def _parameters_in(self, expression: ast.expr) -> list[str]:
        return [node.id for node in ast.walk(expression) if isinstance(node, ast.Name) and node.id in self._raw]

    def _in_order(self) -> list[str]:
        """Parameters, each after those that it depends on; cycles, and what depends on them, are left out."""
        sorter = TopologicalSorter({name: self._needs.get(name, ()) for name in self._raw})
        try:
            sorter.prepare()
        except CycleError as error:  # what is not in one is given all the same
            self._blame_cycle(error.args[1][:0:-1])
        order: list[str] = []
        while ready := sorter.get_ready():
            order += ready
            sorter.done(*ready)
        return order

    def _settle(self, name: str) -> None:
        """Give a parameter its value, or say why it has none; one that needs another without value has none either."""
        raw = self._raw[name]
        try:
            if name in self._expressions:
                self._values[name] = evaluate(self._expressions[name], self.value, 0)
            elif isinstance(raw, (int, float)) and not isinstance(raw, bool):
                self._values[name] = float(raw)
        except ParameterFaultError:
            pass  # reported under the name of the other parameter
        except ExpressionError as error:
            self._failures[name] = error.message

    def _blame_cycle(self, names: list[str]) -> None:
        """Report a cycle from the member that stands first in the deck."""
        first = names.index(min(names, key=list(self._raw).index))
        cycle = [*names[first:], *names[:first], names[first]]
        shown = cycle if len(cycle) <= _LONGEST_CYCLE else [*cycle[: _LONGEST_CYCLE - 2], "...", cycle[-1]]
        self._failures[cycle[0]] = Message("wrong-expression", f"refers to itself: {' -> '.join(shown)}")


def parse_source(text: str) -> ast.expr:
    """Syntax of an expression without its ``=``; raises ExpressionError if it cannot be read."""
    source = text.strip()
    if not source:
        raise _wrong("is an expression without content: write a number or an expression after the =")
    if len(source) > MAX_LENGTH:
        raise _wrong(f"is an expression of more than {MAX_LENGTH} characters")
    if "^" in source:
        raise _wrong("^ is not an operator of expressions: write ** for powers")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Python's remarks on style ("1if") are not for the user of a deck
            return ast.parse(source, mode="eval").body
    except (SyntaxError, ValueError, MemoryError, RecursionError) as error:
        reason = getattr(error, "msg", None) or "too deeply nested"
        raise _wrong(f"cannot be read as an expression: {reason}") from None


def evaluate(node: ast.expr, value_of: Callable[[str], float], depth: int) -> float:
    """Value of a syntax node, by recursion; ``depth`` bounds it. Raises ExpressionError where it has none."""
    if depth > MAX_DEPTH:
        raise _wrong(f"is an expression nested more than {MAX_DEPTH} levels deep")
    match node:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            return _number(float, (value,), "number")
        case ast.Name(id=name):
            return value_of(name)
        case ast.UnaryOp(op=sign, operand=operand) if type(sign) in _UNARY:
            return _UNARY[type(sign)](evaluate(operand, value_of, depth + 1))
        case ast.BinOp(left=left, op=sign, right=right) if type(sign) in _BINARY:
            operands = (evaluate(left, value_of, depth + 1), evaluate(right, value_of, depth + 1))
            return _number(_BINARY[type(sign)], operands, "operation")
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]):
            _refuse_radians(name, args)
            return _call(name, [evaluate(argument, value_of, depth + 1) for argument in args])
        case _:
            raise _wrong(
                "holds something other than numbers, parameters, + - * / % **, parentheses and functions "
                f"({', '.join(FUNCTIONS)})"
            )


def _refuse_radians(name: str, arguments: list[ast.expr]) -> None:
    """Conversions from and to radians, and pi in an angle: whoever writes them expects functions of radians."""
    if name in ("radians", "degrees"):
        words = f"{name} is not needed: angles of sin, cos, tan, asin, acos, atan and atan2 are in degrees"
        raise _wrong(words)
    inside = (node for argument in arguments for node in ast.walk(argument))
    if name in OF_ANGLES and any(isinstance(node, ast.Name) and node.id == "pi" for node in inside):
        raise _wrong(f"{name} takes degrees: write 180 for pi in its angle")


def _call(name: str, arguments: list[float]) -> float:
    if name not in FUNCTIONS:
        raise _wrong(unknown(f"function {name}", name, FUNCTIONS))
    least, most = _ARGUMENTS.get(name, (1, 1))
    if not least <= len(arguments) <= most:
        wanted = str(least) if least == most else f"{least} to {most}"
        raise _wrong(f"{name} takes {wanted} argument{'s' if most > 1 else ''}, has {len(arguments)}")
    return _number(FUNCTIONS[name], arguments, name)


def _number(function: Callable[..., Any], arguments: Any, name: str) -> float:
    """Finite real result of an operation."""
    try:
        result = function(*arguments)
    except ZeroDivisionError:
        raise _wrong("divides by zero") from None
    except OverflowError:
        raise _wrong("gives a number that is too large") from None
    except ValueError:
        shown = ", ".join(f"{argument:g}" for argument in arguments)
        raise _wrong(f"{name}({shown}) is not defined") from None
    if isinstance(result, complex):
        raise _wrong("gives a root of a negative number")
    if not math.isfinite(result):
        raise _wrong("gives a number that is too large")
    return float(result)
