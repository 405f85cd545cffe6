"""Where the program makes messages and errors, found in its syntax, and the identifiers that they have there."""

from __future__ import annotations

import ast
import inspect
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import mbla
from mbla import errors
from mbla.errors import DeckError, MblaError, Refusal

PACKAGE = Path(mbla.__file__).parent
BUILDERS = {"Message", "Finding"} | {
    name
    for name, kind in inspect.getmembers(errors, inspect.isclass)
    if issubclass(kind, (MblaError, Refusal)) and kind is not DeckError
}
NOT_PRINTED = frozenset({"key-idle", "gravity-unusual", "value-unusual"})
"""messages from which remarks are made, which have identifiers of their own kind"""
PRINTED_BY = {"internal-error": "results/failures.py", "deck-invalid": "errors.py"}
"""identifiers of what is no error of the program's own making, and the module that has each"""


@dataclass(frozen=True)
class ItemContext:
    """A call that makes a message or an error; ``identifier`` is None where it is no literal."""

    file: str
    line: int
    identifier: str | None
    handed_on: bool


@cache
def sites() -> tuple[ItemContext, ...]:
    """Every place at which a message or an error is made."""
    classes: list[ast.ClassDef] = []
    calls: list[tuple[Path, set[str], ast.Call]] = []
    for path in sorted(PACKAGE.rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        own = {node.name for node in tree.body if isinstance(node, ast.ClassDef)}  # of the same name, not of errors
        for node in ast.walk(tree):
            if isinstance(node, ast.ClassDef):
                classes.append(node)
            elif isinstance(node, ast.Call) and path != PACKAGE / "errors.py":  # it has the classes themselves
                calls.append((path, own & BUILDERS, node))
    names = _builders(classes)
    return tuple(_site(path, call) for path, own, call in calls if _makes(path, call, names - own))


def _builders(classes: list[ast.ClassDef]) -> set[str]:
    """Names of all classes that take an identifier, those derived in other modules too."""
    known = set(BUILDERS)
    while True:
        found = {node.name for node in classes if any(_name(base) in known for base in node.bases)} - {"DeckError"}
        if found <= known:
            return known
        known |= found


def _makes(path: Path, call: ast.Call, names: set[str]) -> bool:
    remarks = any(path.is_relative_to(PACKAGE / place) for place in ("solution", "codes", "results/collapse"))
    return _name(call.func) in names and not (remarks and _name(call.func) == "Message")


def _site(path: Path, call: ast.Call) -> ItemContext:
    given = call.args[0] if call.args else None
    literal = given.value if isinstance(given, ast.Constant) and isinstance(given.value, str) else None
    handed_on = isinstance(given, ast.Attribute) and given.attr == "identifier"
    return ItemContext(str(path.relative_to(PACKAGE)), call.lineno, literal, handed_on)


def _name(node: Any) -> str:
    return node.id if isinstance(node, ast.Name) else node.attr if isinstance(node, ast.Attribute) else ""


def identifiers() -> set[str]:
    """Every identifier that an error can have."""
    return {site.identifier for site in sites() if site.identifier is not None} | set(PRINTED_BY)
