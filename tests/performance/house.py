"""How large the program is, and how much of it a plain run goes through.

``python -m tests.performance.house`` prints and records a row for each folder (files, lines), the names of classes
that stand twice, constants, and for a wall of 5 x 5 units, associative and without dilatancy: lines, files and
functions executed by stage, the deepest call, and for deck, model, contacts, program and solution

    stays   functions that are given one, each counted once
    climbs  of these, the ones called from a stage to their right

``python -m tests.performance.house CHECKOUT`` measures another state of the project, so that two are compared by the
same script.
"""

from __future__ import annotations

import ast
import json
import os
import subprocess
import sys
from collections import Counter, defaultdict
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from types import CodeType, FrameType
from typing import Any

FOLLOWED = ("Deck", "Model", "Contacts", "Program", "Solution")
STAGES = (
    "deck",
    "model",
    "contacts",
    "assembly",
    "questions",
    "program",
    "solution",
    "soil_mesh",
    "results",
    "codes",
    "sweeps",
)
TRACED = "--traced"


def sizes(package: Path) -> dict[str, tuple[int, int]]:
    """Files and lines by folder below the package, and together."""
    found: dict[str, tuple[int, int]] = defaultdict(lambda: (0, 0))
    for path in sorted(package.rglob("*.py")):
        lines = len(path.read_text(encoding="utf-8").splitlines())
        for folder in (path.relative_to(package).parts[0] if path.parent != package else "beside", "together"):
            files, before = found[folder]
            found[folder] = files + 1, before + lines
    return dict(found)


def definitions(package: Path) -> tuple[Counter[str], int]:
    """How often each class name stands, and how many constants there are: names of capitals bound to numbers."""
    classes: Counter[str] = Counter()
    constants = 0
    for path in package.rglob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        classes.update(node.name for node in ast.walk(tree) if isinstance(node, ast.ClassDef))
        for node in tree.body:
            targets = node.targets if isinstance(node, ast.Assign) else []
            names = [each for target in targets for each in ast.walk(target) if isinstance(each, ast.Name)]
            of_numbers = any(
                isinstance(each, ast.Constant) and type(each.value) in (int, float) for each in ast.walk(node)
            )
            constants += sum(name.id.isupper() for name in names) if of_numbers else 0
    return classes, constants


class Walk:
    """What a run goes through below a package."""

    def __init__(self, package: Path) -> None:
        self.root = f"{package}/"
        self.lines: set[tuple[str, int]] = set()
        self.functions: set[CodeType] = set()
        self.depth = self.deepest = 0
        self.stays: dict[str, set[CodeType]] = {name: set() for name in FOLLOWED}
        self.climbs: dict[str, set[CodeType]] = {name: set() for name in FOLLOWED}

    def stage(self, code: CodeType) -> str:
        """The folder that a function stands in."""
        return code.co_filename.removeprefix(self.root).split("/")[0]

    def call(self, frame: FrameType, event: str, _: Any) -> Callable[..., Any] | None:
        """For ``sys.settrace``."""
        code = frame.f_code
        if event != "call" or not code.co_filename.startswith(self.root):
            return None
        self.functions.add(code)
        self.depth += 1
        self.deepest = max(self.deepest, self.depth)
        if not code.co_name.startswith("<"):
            self._given(frame, code)
        return self._inside

    def _given(self, frame: FrameType, code: CodeType) -> None:
        n_arguments = code.co_argcount + code.co_kwonlyargcount
        kinds = {type(frame.f_locals.get(name)).__name__ for name in code.co_varnames[:n_arguments]}
        above = frame.f_back
        while above is not None and not above.f_code.co_filename.startswith(self.root):
            above = above.f_back
        here, there = self.stage(code), self.stage(above.f_code) if above is not None else ""
        for name in kinds & {*FOLLOWED}:
            self.stays[name].add(code)
            if here in STAGES and there in STAGES and STAGES.index(here) < STAGES.index(there):
                self.climbs[name].add(code)

    def _inside(self, frame: FrameType, event: str, _: Any) -> Callable[..., Any]:
        if event == "line":
            self.lines.add((frame.f_code.co_filename, frame.f_lineno))
        elif event == "return":
            self.depth -= 1
        return self._inside


def walk(project: Path, flow_rule: str, folder: Path) -> dict[str, object]:
    """A plain run of a wall, all files written, everything imported before: what it goes through."""
    import mbla.cli

    package = project / "mbla"
    assert Path(mbla.cli.__file__).is_relative_to(package), mbla.cli.__file__
    deck = project / "decks/tradeoff/wall.yaml"
    changes = [f"parameters.{name}=5" for name in "mn"] + [f"analysis.flow_rule={flow_rule}"]
    options = [each for change in changes for each in ("--set", change)]
    command = ["run", str(deck), *options, "--case", "in_plane", "--force", "-q", "-o", str(folder)]
    assert mbla.cli.main(command) == 0
    walked = Walk(package)
    sys.settrace(walked.call)
    mbla.cli.main(command)
    sys.settrace(None)
    by_stage = Counter(line[0].removeprefix(walked.root).split("/")[0] for line in walked.lines)
    return {
        "lines": len(walked.lines),
        "files": len({file for file, _ in walked.lines}),
        "functions": sum(not code.co_name.startswith("<") for code in walked.functions),
        "deepest": walked.deepest,
        **{stage: by_stage[stage] for stage in STAGES},
        **{f"{name} stays, climbs": f"{len(walked.stays[name])}, {len(walked.climbs[name])}" for name in FOLLOWED},
    }


def walked(project: Path, flow_rule: str) -> dict[str, object]:
    """``walk`` in a process that imports the program of that state."""
    command = [sys.executable, __file__, TRACED, str(project), flow_rule]
    environment = os.environ | {"PYTHONPATH": str(project)}
    answer = subprocess.run(command, capture_output=True, text=True, check=True, env=environment, cwd=project)
    found: dict[str, object] = json.loads(answer.stdout.splitlines()[-1])
    return found


def measure(project: Path) -> None:
    """Record every figure of a state of the project."""
    from tests.performance.recording import commit, record

    def note(what: str, figure: str, value: object) -> None:
        record("house", {"state": commit(project), "what": what, "figure": figure, "value": value})

    tests = {"tests": sizes(project / "tests")["together"]}
    for what, (files, lines) in (sizes(project / "mbla") | tests).items():
        note(what, "files", files)
        note(what, "lines", lines)
    classes, constants = definitions(project / "mbla")
    note("together", "class names that stand twice", sum(count > 1 for count in classes.values()))
    note("together", "constants", constants)
    for flow_rule in ("associative", "non_associative"):
        for figure, value in walked(project, flow_rule).items():
            note(f"wall, {flow_rule}", figure, value)


if __name__ == "__main__":
    if sys.argv[1:2] == [TRACED]:
        sys.path[0] = sys.argv[2]  # the program of that state, not the folder of this file
        with TemporaryDirectory() as folder:
            sys.stdout.write(json.dumps(walk(Path(sys.argv[2]), sys.argv[3], Path(folder))))
    else:
        measure(Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else Path(__file__).parents[2])
