"""The registry of explanations against the source: nothing unexplained, nothing explained that cannot occur."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

import mbla
from mbla.cli import EXIT_STATUS, main
from mbla.deck.sections.analysis import APPLIES
from mbla.errors import DeckError, FileError, LimitError, MblaError, SolverError, UsageError
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.exit_status import EXIT_CODES, UNEXPECTED
from mbla.results.explanations import TOLD, explanations, find_explanations, sections
from mbla.results.findings import REMARKS_THAT_WARN, WITHOUT_REASON
from mbla.results.listing.sections.figures import residual_rows
from mbla.solution.solution import Standing, Status
from mbla.sweeps.command import FAILED_POINTS
from tests.results.synthetic import tower_results

PACKAGE = Path(mbla.__file__).parent
WRITTEN_BY = {"Notice": 1, "warn": 0, "note": 0, "_drop": 2, "take_welded": 1, "_counted": 0, "_worst": 0}
"""Functions that take an identifier, and which argument it is."""
COMPUTED = {
    "f'{key}-not-applied'": {"inset-not-applied", "rounding-not-applied"},
    "UNEXPECTED": {UNEXPECTED},
    "identifier": set(),  # passed on; the caller has it
    "*row": set(),  # read back from a file
    "own": set(),  # positions of a travelling load, no identifier
    "cases": set(),  # the same
}
"""Identifiers that are no constants, as the source has them, and what they can be."""


@cache
def sources() -> dict[Path, ast.Module]:
    """The modules of the program, read when the first test asks: every process that collects tests loads this file."""
    return {path: ast.parse(path.read_text(encoding="utf-8")) for path in sorted(PACKAGE.rglob("*.py"))}


def identifiers_in_source() -> Iterator[tuple[str, str]]:
    """Every identifier of a notice and the file that has it; ``f'...'`` where it is computed."""
    for path, tree in sources().items():
        for node in ast.walk(tree):
            if isinstance(node, ast.Call):
                name = getattr(node.func, "id", getattr(node.func, "attr", ""))
                place = WRITTEN_BY.get(name)
                if place is not None and len(node.args) > place:
                    argument = node.args[place]
                    if isinstance(argument, ast.Constant):
                        yield str(argument.value), path.name
                    else:
                        yield ast.unparse(argument), path.name


def expanded(found: str, file: str) -> set[str]:
    if re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)+|mirrored", found):
        return {found}
    if file == "notices.py" and found == "identifier":  # names of sections in the singular
        return {"parameter-unused", "material-unused", "joint-unused", "load-unused", "vehicle-unused"}
    if file in ("findings.py", "outcome.py") and found == "identifier":
        return {"least-not-verified", "torsion-not-verified", "geometric-safety-not-verified"}
    return COMPUTED[found]


@cache
def notices() -> set[str]:
    return {name for found, file in identifiers_in_source() for name in expanded(found, file)}


@cache
def of_solutions() -> set[str]:
    """Identifiers of what solver and verification say."""
    return {
        value.value
        for path, tree in sources().items()
        if any(path.is_relative_to(PACKAGE / each) for each in ("solution", "codes", "results/collapse"))
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Message"
        for value in ast.walk(node.args[0])
        if isinstance(value, ast.Constant) and isinstance(value.value, str)
    }


def findings() -> set[str]:
    return of_solutions() | {status.value.replace("_", "-") for status in WITHOUT_REASON}


def test_the_walk_finds_notices_of_every_stage() -> None:
    assert {"key-idle", "faces-flat", "force-outside-block", "near-misses", "law-residual"} <= notices()
    assert APPLIES  # key-idle can occur


def test_every_notice_is_explained_and_every_explained_notice_occurs() -> None:
    assert set(explanations()) >= notices() | findings()
    told = {name for name, entry in explanations().items() if entry.kind in ("notice", "warning", "warning or notice")}
    assert told <= notices() | findings()


def test_severity_is_that_of_the_source() -> None:
    severities: dict[str, set[str]] = {}
    for tree in sources().values():
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Notice" and len(node.args) > 1:
                severity, identifier = node.args[:2]
                if isinstance(severity, ast.Constant) and isinstance(identifier, ast.Constant):
                    severities.setdefault(str(identifier.value), set()).add(str(severity.value))
    for name, found in severities.items():
        kind = explanations()[name].kind
        if kind not in ("standing", "verification"):
            assert kind == " or ".join(sorted(found, reverse=True)), name
    remarks = {name for name in of_solutions() if explanations()[name].kind in ("notice", "warning")}
    assert {name for name in remarks if explanations()[name].kind == "warning"} == REMARKS_THAT_WARN


def test_statuses_verdicts_and_modes() -> None:
    assert {entry.identifier for entry in sections()["Statuses of load cases"]} == {
        status.value.replace("_", "-") for status in Status
    }
    assert {mode.name.lower() for mode in InterfaceMode} == {e.identifier for e in sections()["Modes of joints"]}
    verdicts = {alias for entry in sections()["Standing under dead load"] for alias in entry.aliases}
    assert verdicts == {verdict.value for verdict in Standing}


def test_exit_statuses() -> None:
    errors = (MblaError, UsageError, DeckError, SolverError, FileError, LimitError)
    known = {0, FAILED_POINTS, 130, 143, *EXIT_CODES.values(), *(error.exit_status for error in errors)}
    assert {entry.identifier for entry in sections()["Exit statuses"]} == {f"exit-{number}" for number in known}
    in_help = {int(number) for number in re.findall(r"\b(\d{1,3})(?=  |, )", EXIT_STATUS)} | {143}
    assert known == in_help


def test_residuals_of_the_listing() -> None:
    for name, *_ in residual_rows(tower_results().cases[0]):
        assert len(find_explanations(name)) == 1, name
    bounds = ("associative, static bound", "associative, kinematic bound", "relative gap")
    for name in (*bounds, "least found", "path_last"):
        assert len(find_explanations(name)) == 1, name


def sentences(tree: ast.AST) -> Iterator[str]:
    """Texts of a module with formatted values left out, docstrings left out."""
    docs = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            yield "".join(part.value if isinstance(part, ast.Constant) else "X" for part in node.values)  # type: ignore[misc]
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docs:
            yield node.value


def test_messages_of_errors_occur_in_the_source() -> None:
    texts = [text for tree in sources().values() for text in sentences(tree)]
    for entry in explanations().values():
        for words in entry.says:
            kind = words.removeprefix("unknown ")  # "unknown {kind}" is written in one place for all kinds
            there = any(words in text for text in texts) or (
                kind != words and any(text in (kind, f"{kind} X") for text in texts)
            )
            assert there, (entry.identifier, words)


def test_identifiers_are_in_kebab_case_and_unique() -> None:
    names = [entry.identifier for entries in sections().values() for entry in entries]
    assert len(names) == len(set(names)) == len(explanations())
    assert all(re.fullmatch(r"[a-z]+(-[a-z0-9]+)*", name) for name in names)
    others = [alias for entry in explanations().values() for alias in entry.aliases]
    assert len(others) == len(set(others))


def test_every_entry_is_complete() -> None:
    for entry in explanations().values():
        parts = ("title", "meaning") if entry.title == TOLD else ("title", "meaning", "cause", "remedy")
        for part in parts:
            text = getattr(entry, part)
            assert text.endswith("."), (entry.identifier, part)
            assert "$" not in text, (entry.identifier, part)


# --- the command ---------------------------------------------------------------------------------------------------


def test_all_and_one(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain"]) == 0
    everything = capsys.readouterr().out
    assert all(re.search(rf"\s{name}[ ,.\n]", everything) for name in explanations())
    assert all(len(line) <= 100 for line in everything.splitlines())
    for asked in (["4"], ["exit-4"], ["exit", "status", "4"]):
        assert main(["explain", *asked]) == 0
        assert capsys.readouterr().out.startswith("exit-4   (exit status)\n")


def test_found_by_status_message_and_word(capsys: pytest.CaptureFixture[str]) -> None:
    found = {
        "no_equilibrium": "no-equilibrium",
        "only by self-stress": "only-by-self-stress",
        "deck.yaml:8:9 joints.dry.fricton = 0.6: unknown key; did you mean friction?  [unknown-key]": "unknown-key",
        "a.yaml:7:5 blocks[0].polyhedron: block wedge[0]: is not closed: 4 edges have one face only": "open-polyhedron",
        "warning [near-misses]: 2 pairs of bodies nearly touch": "near-misses",
        "supports = []: nothing holds the structure: give ground or fixed blocks  [no-support]": "no-support",
    }
    for asked, identifier in found.items():
        assert [entry.identifier for entry in find_explanations(asked)] == [identifier], asked
    assert {"blocks-overlap", "overlap-not-checked"} <= {entry.identifier for entry in find_explanations("overlap")}


def test_an_identifier_whose_message_says_all(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "unknown-key"]) == 0
    out = capsys.readouterr().out
    assert out.startswith(f"unknown-key   (error in a deck)\n  {TOLD}\n")
    assert "What to do" not in out


def test_misspelt(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "near-mises"]) == 2
    assert "did you mean near-misses?" in capsys.readouterr().err
    assert main(["explain", "xyzzy"]) == 2
    assert "lists every identifier" in capsys.readouterr().err


def test_json(capsys: pytest.CaptureFixture[str]) -> None:
    import json

    assert main(["explain", "--json"]) == 0
    assert [entry["identifier"] for entry in json.loads(capsys.readouterr().out)["explanations"]] == list(
        explanations()
    )
    assert main(["explain", "least-found", "--json"]) == 0
    (entry,) = json.loads(capsys.readouterr().out)["explanations"]
    assert entry["kind"] == "figure"
    assert entry["example"] is None
