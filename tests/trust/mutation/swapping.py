"""A mutant put in the place of the right program, in a process that has it imported."""

from __future__ import annotations

import ast
import functools
import gc
import sys
from pathlib import Path
from types import CodeType, FunctionType

from tests.trust.mutation.mutants import Mutant


class Swapper:
    """Functions that are there, by file and first line: looked up once, before processes are forked."""

    def __init__(self, files: set[str]) -> None:
        self.functions: dict[tuple[str, str, int], list[FunctionType]] = {}
        things = gc.get_objects()
        for function in [thing for thing in things if type(thing) is FunctionType]:
            if function.__code__.co_filename in files:
                self.functions.setdefault(_key(function.__code__), []).append(function)
        kept = [thing for thing in things if type(thing) is functools._lru_cache_wrapper]
        self.caches = [one for one in kept if getattr(one, "__module__", "").startswith("mbla")]

    def put(self, mutant: Mutant) -> bool:
        """Whether the mutant is now what runs: its function is there, or its constant."""
        swapped = _swap_constant(mutant) if mutant.named else False
        for code in wrong_codes(mutant):
            for function in self.functions.get(_key(code), ()):
                if function.__code__.co_freevars == code.co_freevars:
                    function.__code__ = code
                    swapped = True
        for kept in self.caches:
            kept.cache_clear()  # the right answers are not the mutant's
        return swapped


@functools.cache
def wrong_codes(mutant: Mutant) -> tuple[CodeType, ...]:
    """The functions that a mutant changes, those around its place."""
    source = mutant.path.read_text(encoding="utf-8")
    right = set(_codes(compile(source, str(mutant.path), "exec", dont_inherit=True)))
    return tuple(
        code
        for code in _codes(compile(mutant.tree(source), str(mutant.path), "exec", dont_inherit=True))
        if code not in right
    )


def _key(code: CodeType) -> tuple[str, str, int]:
    return code.co_filename, code.co_name, code.co_firstlineno


def _codes(code: CodeType) -> list[CodeType]:
    """Code objects inside one, all depths."""
    inner = [const for const in code.co_consts if isinstance(const, CodeType)]
    return [*inner, *(deeper for one in inner for deeper in _codes(one))]


def _swap_constant(mutant: Mutant) -> bool:
    """A number with a name, in the module and wherever it was imported."""
    for node in mutant.tree(mutant.path.read_text(encoding="utf-8")).body:
        if not isinstance(node, (ast.Assign, ast.AnnAssign)) or node.lineno not in mutant.lines:
            continue
        target = node.targets[0] if isinstance(node, ast.Assign) else node.target
        if not isinstance(target, ast.Name) or not isinstance(node.value, ast.Constant):
            continue
        home = [module for module in list(sys.modules.values()) if _file(module) == mutant.path]
        for module in list(sys.modules.values()) if home else ():
            if getattr(module, "__dict__", {}).get(target.id, home) is vars(home[0])[target.id] and module not in home:
                setattr(module, target.id, node.value.value)
        for module in home:
            setattr(module, target.id, node.value.value)
        return bool(home)
    return False


def _file(module: object) -> Path | None:
    file = getattr(module, "__file__", None)
    return Path(file) if isinstance(file, str) else None
