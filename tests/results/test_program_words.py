import ast
import fnmatch
from dataclasses import replace
from pathlib import Path

import pytest

from mbla.results.program_words import MOST_ROWS, PURPOSES, program_lines
from mbla.results.text import WIDTH

from .synthetic import tower_results

SOLUTION = Path(__file__).parents[2] / "mbla" / "solution"
FIRST = tower_results().cases[0].solution


def kinds_in(path: Path) -> set[str]:
    """Texts that a file hands to whatever makes records of programs (ProgramRecord, _record and its like).

    What is given, assigned or preset by the name of ``kind`` counts wherever it is.
    """
    kinds: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        given: list[ast.expr] = []
        if isinstance(node, ast.Call):
            name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            given += [word.value for word in node.keywords if word.arg == "kind" and not name.endswith("sort")]
            given += node.args if "record" in name.lower() else []
        elif isinstance(node, ast.FunctionDef):
            named = node.args.args[len(node.args.args) - len(node.args.defaults) :]
            given += [v for argument, v in zip(named, node.args.defaults, strict=True) if argument.arg == "kind"]
        elif isinstance(node, ast.Assign) and [getattr(target, "id", "") for target in node.targets] == ["kind"]:
            given.append(node.value)
        kinds |= {text for value in given for text in _texts(value)}
    return kinds


def _texts(value: ast.expr) -> set[str]:
    """A text, both of a choice between two, or of a text with something put in the pattern that it follows."""
    if isinstance(value, ast.IfExp):
        return _texts(value.body) | _texts(value.orelse)
    if isinstance(value, ast.JoinedStr):
        return {"".join(str(part.value) if isinstance(part, ast.Constant) else "*" for part in value.values)}
    return {value.value} if isinstance(value, ast.Constant) and isinstance(value.value, str) else set()


def test_the_search_finds_kinds_however_they_are_given(tmp_path: Path) -> None:
    path = tmp_path / "schemes.py"
    path.write_text(
        "run.records.append(ProgramRecord(1, 'a', status))\n"
        "_record(run, 'b' if first else 'c', solution)\n"
        "other(kind='d', reason='not this')\n"
        "def solve(form, kind='e', words='nor this'): ...\n"
        "kind = 'f' if first else 'g'\n"
        "order = np.argsort(x, kind='nor that')\n"
        "record(f'h, {end}')\n"
    )
    assert kinds_in(path) == {*"abcdefg", "h, *"}


def test_every_kind_of_program_is_said_in_words() -> None:
    found = {kind: path.name for path in sorted(SOLUTION.rglob("*.py")) for kind in kinds_in(path)}
    assert {"associative", "reverse", "gravity"} <= set(found)
    assert {kind: file for kind, file in found.items() if not fnmatch.filter(PURPOSES, kind)} == {}


@pytest.mark.parametrize("count", [0, 1, MOST_ROWS, MOST_ROWS + 1, 500])
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
    if count > MOST_ROWS:
        assert len(numbers) == MOST_ROWS
        assert any(f"{count - MOST_ROWS} more" in line for line in lines)
    else:
        assert len(numbers) == count
