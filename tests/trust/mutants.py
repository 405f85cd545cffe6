"""Mutants of a module: each its syntax tree with one node replaced.

Replaced are comparisons, arithmetic, numbers, truth values, conditions, returned values, minima and maxima, and
statements that are calls, augmented assignments, raises, breaks or continues. Left alone are texts, annotations,
decorators, default values, assertions, and what runs once at import but numbers with a name.
"""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

COMPARISONS: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
}
ARITHMETIC: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Mult,
    ast.Mod: ast.Mult,
    ast.Pow: ast.Mult,
    ast.BitAnd: ast.BitOr,
    ast.BitOr: ast.BitAnd,
    ast.MatMult: ast.Add,
}
NAMES = {
    "min": "max",
    "max": "min",
    "any": "all",
    "all": "any",
    "minimum": "maximum",
    "maximum": "minimum",
    "argmin": "argmax",
    "argmax": "argmin",
    "floor": "ceil",
    "ceil": "floor",
    "zeros": "ones",
    "zeros_like": "ones_like",
}
LEFT_ALONE = ("annotation", "returns", "decorator_list", "args", "ctx", "type_comment", "format_spec", "targets")
"""Fields of nodes in which nothing is replaced; ``args`` are those of a definition"""


@dataclass(frozen=True)
class Mutant:
    """One wrong program.

    place  : fields and indices from the module to the node
    change : in words, right -> wrong
    """

    path: Path
    place: tuple[str | int, ...]
    line: int
    change: str
    wrong: ast.AST

    def text(self) -> str:
        """The whole module with this one thing made wrong."""
        tree = ast.parse(self.path.read_text(encoding="utf-8"))
        node: object = tree
        for step in self.place[:-1]:
            node = getattr(node, step) if isinstance(step, str) else node[step]  # type: ignore[index]
        last = self.place[-1]
        wrong = copy.deepcopy(self.wrong)
        if isinstance(last, str):
            setattr(node, last, wrong)
        else:
            node[last] = wrong  # type: ignore[index]
        return ast.unparse(ast.fix_missing_locations(tree))


def mutants_of(path: Path) -> list[Mutant]:
    """Every mutant of a module, in the order of its text."""
    return [
        Mutant(path, place, node.lineno, f"{_short(node)} -> {_short(wrong)}", wrong)
        for place, node in _nodes(ast.parse(path.read_text(encoding="utf-8")), (), False)
        for wrong in _wrong(node)
    ]


def _nodes(
    node: ast.AST, place: tuple[str | int, ...], inside: bool
) -> Iterator[tuple[tuple[str | int, ...], ast.expr | ast.stmt]]:
    """Nodes that may be replaced, with their place."""
    named = len(place) == 2 and isinstance(node, (ast.Assign, ast.AnnAssign)) and _number(node.value)
    if isinstance(node, (ast.expr, ast.stmt)) and inside:
        yield place, node
    for field, value in ast.iter_fields(node):
        if field in LEFT_ALONE and not isinstance(node, ast.Call):
            continue
        if isinstance(node, ast.Assert) or (field == "target" and not isinstance(node, ast.comprehension)):
            continue
        within = inside or isinstance(node, ast.FunctionDef) or named
        for step, child in enumerate(value) if isinstance(value, list) else ((None, value),):
            if isinstance(child, ast.AST):
                yield from _nodes(child, (*place, field, *(() if step is None else (step,))), within)


def _short(node: ast.AST) -> str:
    """The first line of its text."""
    return ast.unparse(node).splitlines()[0]


def _number(value: ast.expr | None) -> bool:
    return isinstance(value, ast.Constant) and isinstance(value.value, (int, float))


def _wrong(node: ast.expr | ast.stmt) -> Iterator[ast.AST]:
    """What may stand in place of a node."""
    match node:
        case ast.Compare(left, [op], right):
            for other in COMPARISONS[type(op)]:
                yield ast.Compare(left, [other()], right)
        case ast.Compare(left, ops, right):
            for at, op in enumerate(ops):
                for other in COMPARISONS[type(op)]:
                    yield ast.Compare(left, [*ops[:at], other(), *ops[at + 1 :]], right)
        case ast.BinOp(left, op, right) if type(op) in ARITHMETIC and not isinstance(left, (ast.JoinedStr)):
            yield ast.BinOp(left, ARITHMETIC[type(op)](), right)
        case ast.BoolOp(op, values):
            yield ast.BoolOp(ast.Or() if isinstance(op, ast.And) else ast.And(), values)
        case ast.UnaryOp(ast.USub() | ast.Not() | ast.Invert(), operand):
            yield operand
        case ast.Constant(bool() as value):
            yield ast.Constant(not value)
        case ast.Constant(int() | float() as value):
            yield ast.Constant(value + 1)
        case ast.IfExp(test, body, orelse):
            yield ast.IfExp(test, orelse, body)
        case ast.Name(name) if name in NAMES:
            yield ast.Name(NAMES[name], node.ctx)
        case ast.Attribute(value, name) if name in NAMES:
            yield ast.Attribute(value, NAMES[name], node.ctx)
        case ast.If(ast.Name() | ast.Attribute() | ast.Call() as test, body, orelse):
            yield ast.If(ast.UnaryOp(ast.Not(), test), body, orelse)
        case ast.Return(ast.expr() as value) if not (isinstance(value, ast.Constant) and not value.value):
            yield ast.Return(ast.Constant(None))
        case ast.Expr(ast.Call()) | ast.AugAssign() | ast.Raise():
            yield ast.copy_location(ast.Pass(), node)
        case ast.Break():
            yield ast.copy_location(ast.Continue(), node)
        case ast.Continue():
            yield ast.copy_location(ast.Break(), node)
