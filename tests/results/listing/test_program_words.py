import ast
import fnmatch
from dataclasses import replace
from pathlib import Path

import pytest

import mbla
from mbla.results.listing.solving import MOST_PROGRAMS, PURPOSES, program_lines
from mbla.results.listing.text import WIDTH
from tests.results.synthetic import tower_results

SOLUTION = Path(mbla.__file__).parent / "solution"
FIRST = tower_results().cases[0].solution


def kinds_in(*paths: Path) -> dict[str, str]:
    """Texts that end up as the kind of a program, and the file that each is in.

    That is what ProgramRecord is given, and every function that hands its own ``kind`` on to it; and what is assigned
    to a name ``kind``.
    """
    trees = {path.name: ast.parse(path.read_text(encoding="utf-8")) for path in paths}
    functions = [node for tree in trees.values() for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
    places = {"ProgramRecord": 1}
    for _ in functions:  # as often as one hands on to another
        places |= {node.name: _place_of_kind(node) for node in functions if _hands_on(node, places)}
    found = ((name, value) for name, tree in trees.items() for node in ast.walk(tree) for value in _given(node, places))
    return {text: name for name, value in found for text in _texts(value)}


def _place_of_kind(function: ast.FunctionDef) -> int:
    """Position of the parameter ``kind``, ``self`` not counted; beyond all others where it is given by name only."""
    names = [argument.arg for argument in function.args.args if argument.arg != "self"]
    return names.index("kind") if "kind" in names else len(names)


def _hands_on(function: ast.FunctionDef, places: dict[str, int]) -> bool:
    """Whether a function gives its own ``kind`` to one that is known."""
    arguments = (*function.args.args, *function.args.kwonlyargs)
    if "kind" not in [argument.arg for argument in arguments]:
        return False
    given = (value for node in ast.walk(function) if isinstance(node, ast.Call) for value in _given(node, places))
    return any(isinstance(part, ast.Name) and part.id == "kind" for value in given for part in ast.walk(value))


def _given(node: ast.AST, places: dict[str, int]) -> list[ast.expr]:
    """Values that one statement or call hands on as a kind."""
    if isinstance(node, ast.Call):
        name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        if name not in places:
            return []
        return node.args[places[name] :][:1] + [word.value for word in node.keywords if word.arg == "kind"]
    if isinstance(node, ast.FunctionDef) and node.name in places:
        preset = node.args.args[len(node.args.args) - len(node.args.defaults) :]
        return [v for argument, v in zip(preset, node.args.defaults, strict=True) if argument.arg == "kind"]
    if isinstance(node, ast.Assign) and [getattr(target, "id", "") for target in node.targets] == ["kind"]:
        return [node.value]
    return []


def _texts(value: ast.expr) -> set[str]:
    """A text, both of a choice between two, or of a text with something put in the pattern that it follows."""
    if isinstance(value, ast.IfExp):
        return _texts(value.body) | _texts(value.orelse)
    if isinstance(value, ast.JoinedStr):
        return {"".join(str(part.value) if isinstance(part, ast.Constant) else "*" for part in value.values)}
    return {value.value} if isinstance(value, ast.Constant) and isinstance(value.value, str) else set()


RECORDS = """
def note(run, kind, solution):
    run.add(kind)

class Run:
    def add(self, kind, words="not this"):
        self.records.append(ProgramRecord(len(self.records), kind, self.status))

def other(kind, reason): ...
"""

SCHEME = """
run.records.append(ProgramRecord(1, "a", status))
run.records.append(ProgramRecord(1, kind="b"))
note(run, "c" if first else "d", solution)
other("nor this", kind="nor that")
def solve(form, kind="e", words="nor these"):
    note(form, kind, words)
kind = "f" if first else "g"
order = np.argsort(x, kind="nor here")
run.add(f"h, {end}")
"""


def test_the_search_finds_kinds_however_they_are_given(tmp_path: Path) -> None:
    (tmp_path / "records.py").write_text(RECORDS)
    (tmp_path / "schemes.py").write_text(SCHEME)
    found = kinds_in(tmp_path / "records.py", tmp_path / "schemes.py")
    assert set(found) == {*"abcdefg", "h, *"}
    assert set(found.values()) == {"schemes.py"}


def test_every_kind_of_program_is_said_in_words() -> None:
    found = kinds_in(*sorted(SOLUTION.rglob("*.py")))
    assert {"associative", "reverse", "gravity"} <= set(found)
    assert {kind: file for kind, file in found.items() if not fnmatch.filter(PURPOSES, kind)} == {}


@pytest.mark.parametrize("count", [0, 1, MOST_PROGRAMS, MOST_PROGRAMS + 1, 500])
def test_long_sequences_show_both_ends_and_say_what_is_left_out(count: int) -> None:
    program = FIRST.programs[1]
    programs = tuple(replace(program, program=i + 1) for i in range(count))
    lines = program_lines(replace(FIRST, programs=programs))
    if not count:
        assert lines == []
        return
    assert max(map(len, lines)) <= WIDTH
    assert f"{count} program" in lines[1]
    numbers = [int(line.split()[0]) for line in lines[3:] if line.split()[0].isdigit()]
    assert numbers[0] == 1
    assert numbers[-1] == count
    if count > MOST_PROGRAMS:
        assert len(numbers) == MOST_PROGRAMS
        assert any(f"{count - MOST_PROGRAMS} more" in line for line in lines)
    else:
        assert len(numbers) == count
