"""What a result comes from, and the results of a run as it goes: before any load case is solved, and after each.

The deck with everything that it is made of and the way back to it, the analysis settings in effect, versions of the
program and of the libraries that its numbers depend on, and what a load case needs. What belongs to solved load cases
is imported where there is one: ``mbla check`` solves none, and answers sooner.
"""

from __future__ import annotations

import platform
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from mbla import __version__
from mbla.assembly.assembly import Assembly
from mbla.deck import Deck, read_deck
from mbla.deck.deck import sha256_of
from mbla.deck.sections.accuracy import knobs_of
from mbla.deck.text.include import confined
from mbla.errors import FileError, Notice
from mbla.process.stopwatch import Stopwatch
from mbla.program.reductions.steps import ReductionStep
from mbla.results.results import CaseResult, DeckRecord, Results, now
from mbla.solution.settings import SolverSettings

LIBRARIES = (
    "numpy",
    "scipy",
    "clarabel",
    "qdldl",
    "shapely",
    "manifold3d",
    "meshio",
    "h5py",
    "pyyaml",
    "pydantic",
    "pint",
)

OPTIONAL = ("cvxopt",)
"""Libraries that are used where they are installed."""


@cache
def collect_provenance() -> dict[str, str]:
    """Versions and platform by name, read from the installed packages without importing them, once in a process."""
    versions = {"mbla": __version__, "python": platform.python_version()}
    for library in (*LIBRARIES, *OPTIONAL):
        try:
            versions[library] = version(library)
        except PackageNotFoundError:
            versions[library] = "not installed"
    return versions | {"platform": platform.platform(), "machine": platform.machine()}


def settings_in_words(deck: Deck, settings: SolverSettings) -> dict[str, str]:
    """Analysis settings in effect, by name, for the result files."""
    analysis = deck.analysis
    knobs = knobs_of(analysis)
    words = {
        "flow_rule": analysis.flow_rule,
        "contact_model": analysis.contact_model,
        "accuracy": analysis.accuracy,
        "solver": analysis.solver,
        **{name: f"{getattr(settings, name):g}" for name in ("tolerance", "gap", "residual")},
        "search": f"{settings.search:g}" + ("" if analysis.search is None else ", in space as well"),
        **{name: str(getattr(knobs, name)).lower() for name in ("torsion", "standing")},
        "max_iterations": str(settings.max_iterations),
        "contact_points": _points_in_words(deck),
        "contact_tolerance": f"{deck.contacts.tolerance:g}",
    }
    words |= _contacts_in_words(deck)
    if analysis.flow_rule == "non_associative":
        words["scheme"] = analysis.scheme
        parameters = getattr(analysis, analysis.scheme, None)  # none for auto
        if parameters is not None:
            words |= {f"scheme_{name}": f"{value:g}" for name, value in parameters.model_dump().items()}
    if settings.by_elastic_path:
        words |= {f"path_{name}": f"{value:g}" for name, value in analysis.path.model_dump().items()}
    if not analysis.reductions:
        words["reductions"] = "false"
    if analysis.sensitivity is not False:
        words["sensitivity"] = "true" if analysis.sensitivity is True else ", ".join(analysis.sensitivity)
    if analysis.geometric_safety:
        words["geometric_safety"] = "true"
    if analysis.soil_range:
        words["soil_range"] = "true"
    if analysis.time_limit is not None:
        words["time_limit"] = f"{analysis.time_limit:g} s"
    return words


def _contacts_in_words(deck: Deck) -> dict[str, str]:
    """What the deck says of finding contacts, beside points and tolerance."""
    contacts, words = deck.contacts, dict[str, str]()
    if contacts.joint_thickness is not None:
        words["joint_thickness"] = f"{contacts.joint_thickness:g} {deck.units.length}"
    if contacts.overlap_tolerance is not None:
        words["overlap_tolerance"] = f"{contacts.overlap_tolerance:g}"
    if contacts.table is not None:
        words["contact_table"] = contacts.table
    if contacts.isolated != "fail":
        words["isolated"] = contacts.isolated
    return words


def threads_in_words(cases: Sequence[CaseResult]) -> str:
    """Threads that factorisations of cone programs ran on, whatever was asked for: all are serial."""
    used = {program.factorization for case in cases for program in case.solution.programs} - {""}
    return f"1; factorisations by {', '.join(sorted(used))} are serial" if used else "1"


def _points_in_words(deck: Deck) -> str:
    """How an interface is represented."""
    contacts = deck.contacts
    if deck.analysis.contact_model == "convex":
        return "resultants of each interface"
    points, length = contacts.points, deck.units.length
    words = "corners"
    if points.spacing is not None:
        words = f"at most {points.spacing:g} {length} apart along each edge, and inside"
    elif (points.per_edge or 1) > 1:
        words = f"{points.per_edge} along each edge, and inside"
    inwards = f"{points.inset:g}" if points.inset else f"{points.rounding:g} {length}" if points.rounding else ""
    return words + (f", inset by {inwards}" if inwards else "")


def deck_record(deck: Deck) -> DeckRecord:
    """Texts, overrides and side files of a deck; FileError where a side file has gone since it was read."""
    return DeckRecord(
        name=deck.path.name,
        sources=tuple((source.name, source.text) for source in deck.sources),
        overrides=deck.overrides,
        sha256=deck.sha256,
        files=tuple(dict(_side_files(deck)).items()),
    )


def has_its_hash(record: DeckRecord) -> bool:
    """Whether the hash of a deck on record is that of its texts and overrides."""
    return sha256_of([*(text for _, text in record.sources), *record.overrides]) == record.sha256


def _side_files(deck: Deck) -> Iterator[tuple[str, bytes]]:
    """Name and content of each file that the deck names."""
    for side in deck.side_files:
        file = deck.resolve_file(side.key, side.value)
        try:
            yield Path(side.name).as_posix(), file.read_bytes()
        except OSError as error:
            raise FileError("file-unreadable", f"{file}: cannot be read: {error.strerror or error}") from error


def deck_of(record: DeckRecord, folder: Path, *, expected: bool) -> Deck:
    """The deck read again from its record, in an empty folder that holds nothing but what it is made of.

    expected : whether its expectations are read

    Raises
    ------
    DeckError
        it is not valid
    FileError
        it is not complete, or the folder cannot be written
    """
    texts = ((name, text.encode()) for name, text in record.sources)
    for name, content in (*texts, *record.files):
        path = confined(folder, name)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        except (OSError, ValueError) as error:
            raise FileError("file-unreadable", f"{name}: cannot be put in place: {error}") from error
    return read_deck(folder / record.sources[0][0], record.overrides, expected=expected)


@dataclass(frozen=True)
class CaseNeeds:
    """Of one load case.

    counts     : what reaches the solver, by name; ``solver``: which takes its associative programs
    reductions : what each reduction left out, in the order in which they are applied
    """

    counts: Mapping[str, int | str]
    reductions: tuple[ReductionStep, ...] = ()


PARTS_OF_SOLVE = ("assemble", "programs", "repair", "standing", "verify")
"""What is timed inside ``solve``: equilibrium, yield conditions and reductions; programs and steps of the law;
forces and velocities repaired, which prove the bounds; standing under dead load; verification."""


def results_before(deck: Deck, assembly: Assembly, settings: SolverSettings, seconds: dict[str, float]) -> Results:
    """Results without load cases.

    seconds : by stage, of those that are done
    """
    return Results(
        deck=deck_record(deck),
        assembly=assembly,
        cases=(),
        notices=notices_of(deck, assembly),
        provenance=dict(collect_provenance()),
        settings=settings_in_words(deck, settings),
        time=seconds,
        exit_code=0,
    )


def notices_of(deck: Deck, assembly: Assembly) -> tuple[Notice, ...]:
    """What every stage before the solver remarked, in their order."""
    model, contacts = assembly.model, assembly.contacts
    return (
        *deck.notices,
        *model.notices,
        *contacts.report.notices,
    )


def with_case(results: Results, case: CaseResult, seconds: float, stopwatch: Stopwatch) -> Results:
    """Results so far with one load case more, or with more of one that was solved before.

    seconds : since solving began
    """
    from mbla.results.exit_status import exit_code

    name = case.load_case.name
    known = name in {each.load_case.name for each in results.cases}
    cases = tuple(case if each.load_case.name == name else each for each in results.cases)
    cases = cases if known else (*cases, case)
    return replace(
        results,
        assembly=with_loads_found(results.assembly, [case]),
        cases=cases,
        settings=results.settings | {"threads": threads_in_words(cases)},
        time=results.time | {"solve": seconds} | parts_of_solve(cases, stopwatch),
        exit_code=exit_code(cases, results.notices),
        created=now(),
        not_done=results.not_done[1:],
    )


def with_loads_found(assembly: Assembly, cases: Sequence[CaseResult]) -> Assembly:
    """The assembly with the load cases as they were solved.

    The loads of a tilting table are those of its angle, and those of a settling support have the reaction from
    which it starts.
    """
    found = {case.load_case.name: case.load_case for case in cases}
    return assembly.with_load_cases(tuple(found.get(case.name, case) for case in assembly.model.load_cases))


def as_expected(results: Results, deck: Deck) -> Results:
    """Results with a warning for every figure that is not what the deck expects."""
    from mbla.results.exit_status import UNEXPECTED, differences, exit_code

    name_of = results.model.blocks.name
    found = [Notice("warning", UNEXPECTED, text) for text in differences(results.cases, deck.content.expected, name_of)]
    notices = (*results.notices, *found)
    return replace(results, notices=notices, exit_code=exit_code(results.cases, notices))


def parts_of_solve(cases: Sequence[CaseResult], stopwatch: Stopwatch) -> dict[str, float]:
    """Seconds of the programs, as they were recorded, and of what is done before, between and after them."""
    programs = float(sum(program.seconds for case in cases for program in case.solution.programs))
    parts = {"programs": programs, **stopwatch.seconds}
    return {f"solve/{part}": parts[part] for part in PARTS_OF_SOLVE if part in parts}
