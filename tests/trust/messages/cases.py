"""Errors outside of faulty decks and sweep files: what brings each about, in a folder of its own.

The lines are in ``sentences.txt``, by the name of the function.
"""

from __future__ import annotations

import contextlib
import errno
import fcntl
import importlib.util
import platform
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from mbla import api
from mbla.assembly import build_assembly
from mbla.cli import main
from mbla.cli.given_decks import refuse_unfit_name
from mbla.deck import read_deck, validation
from mbla.deck.content import DeckContent
from mbla.deck.text import reader, sources
from mbla.deck.text.include import confined
from mbla.errors import DeckError, Fault, Place
from mbla.model import build_model
from mbla.model.geometry import readers
from mbla.program.kinematic import ConeProgram, kinematic_form
from mbla.results import disk as journal_lock
from mbla.results.hdf5.result_file import write_results_hdf5
from mbla.results.macro_blocks import refuse_joints_of_table
from mbla.results.notebook import run
from mbla.results.notebook.run import Run
from mbla.results.pictures import animation, renderer
from mbla.results.series import Series
from mbla.results.tables.tables import tables_of
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.linear_algebra.cholesky import factorization
from mbla.solution.linear_algebra.pattern import SymmetricPattern
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord
from mbla.sweeps.engine import child
from mbla.sweeps.engine.cluster import connected, lost
from mbla.sweeps.engine.engine import EngineOptions, check_options
from mbla.sweeps.engine.supervised import SupervisedRunner
from mbla.sweeps.journal import Journal, open_journal
from mbla.sweeps.pictures.plot import SweepPictures, plot_sweep
from tests.deck.decks import BLOCK, changed, write
from tests.line import BLOCK as LINE
from tests.line import line_of
from tests.results.changed_files import changing
from tests.results.synthetic import tower_results
from tests.sweeps.journal.points import HEADER, other_header
from tests.sweeps.pictures.hand_made import grid
from tests.sweeps.small_plan import plan_over

NAMED = "mesh: {group: block, material: stone, file: wall.obj}"
Patch = pytest.MonkeyPatch
Bring = Callable[[Path, Patch], object]


@dataclass(frozen=True)
class Case:
    """An error by its identifier, and a function of an empty folder that raises it, or prints it and returns."""

    identifier: str
    bring: Bring


CASES: dict[str, Case] = {}
"""by the name of the function"""


def brings(identifier: str) -> Callable[[Bring], Bring]:
    """Register what brings an error about."""

    def register(function: Bring) -> Bring:
        CASES[function.__name__] = Case(identifier, function)
        return function

    return register


def raising(error: type[Exception] | Exception) -> Callable[..., None]:
    """A function that fails."""

    def fails(*arguments: object) -> None:
        raise error

    return fails


def command(*arguments: str) -> int:
    """Run the program; what it prints is the error."""
    return main(arguments)


# --- files ----------------------------------------------------------------------------------------------------------


@brings("bad-file-name")
def name_with_a_zero_byte(folder: Path, patch: Patch) -> object:
    return confined(folder, "a\0.obj")


@brings("file-too-large")
def deck_beyond_all_size(folder: Path, patch: Patch) -> object:
    patch.setattr(sources, "MAX_BYTES", 1024**2)
    return read_deck(write(folder, "#" * (1024**2 + 1)))


@brings("too-many-entries")
def list_beyond_all_length(folder: Path, patch: Patch) -> object:
    patch.setattr(reader, "MOST_ITEMS", 2)
    return read_deck(write(folder, changed("min: [0, 0, 0]", "min: [0, 0, 0, 0]")))


@brings("geometry-too-large")
def geometry_beyond_all_size(folder: Path, patch: Patch) -> object:
    patch.setattr(readers, "LARGEST_FILE", 1024**2)
    (folder / "wall.obj").write_bytes(b"#" * (1024**2 + 1))
    named = changed("box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}", NAMED)
    return build_model(read_deck(write(folder, named)))


@brings("not-utf-8")
def deck_in_latin_1(folder: Path, patch: Patch) -> object:
    (folder / "deck.yaml").write_bytes("mbla: 1\ntitle: Bögen\n".encode("latin-1"))
    return read_deck(folder / "deck.yaml")


@brings("file-system")
def disk_that_fails(folder: Path, patch: Patch) -> object:
    patch.setattr(api, "_read", raising(OSError(errno.EIO, "Input/output error", "deck.yaml")))
    return api.run("deck.yaml")


@brings("out-of-memory")
def memory_that_is_used_up(folder: Path, patch: Patch) -> object:
    patch.setattr(api, "_read", raising(MemoryError))
    return api.run("deck.yaml")


@brings("internal-error")
def defect_of_the_program(folder: Path, patch: Patch) -> object:
    patch.setattr("mbla.cli.given_decks.refuse_unfit_name", raising(ZeroDivisionError("first second")))
    return command("run", "deck.yaml")


@brings("path-not-utf-8")
def deck_with_a_name_of_bytes(folder: Path, patch: Patch) -> None:
    refuse_unfit_name(Path("/decks/a\udcff.yaml"))


@brings("current-folder-gone")
def folder_that_was_removed(folder: Path, patch: Patch) -> object:
    (folder / "here").mkdir()
    patch.chdir(folder / "here")
    (folder / "here").rmdir()
    return command("schema")


@brings("damaged-result-file")
def result_of_zeros(folder: Path, patch: Patch) -> object:
    (folder / "a.h5").write_bytes(bytes(1000))
    return command("show", str(folder / "a.h5"))


@brings("old-result-file")
def result_of_an_earlier_layout(folder: Path, patch: Patch) -> object:
    path = result(folder)
    with changing(path) as file:
        file.attrs["version"] = 1
    return command("show", str(path))


def result(folder: Path) -> Path:
    """A result file."""
    path = folder / "tower.h5"
    path.write_bytes(write_results_hdf5(tower_results()))
    return path


# --- the command line -----------------------------------------------------------------------------------------------


@brings("same-result-files")
def two_decks_of_one_name(folder: Path, patch: Patch) -> object:
    return command("run", str(write(folder, BLOCK)), str(write(folder, BLOCK, "b/deck.yaml")), "-o", str(folder))


@brings("resume-of-another")
def rest_of_another_deck(folder: Path, patch: Patch) -> object:
    deck, left = write(folder, BLOCK), replace(tower_results(), complete=False, not_done=("not_run",))
    (folder / "deck.out").mkdir()
    (folder / "deck.out" / "deck.partial.h5").write_bytes(write_results_hdf5(left))
    (folder / "deck.out" / "deck.partial.json").write_text('{"complete": false}', encoding="utf-8")
    return command("run", str(deck), "--resume", "-q")


@brings("load-case-not-chosen")
def result_of_several_load_cases(folder: Path, patch: Patch) -> object:
    one = tower_results()
    other = replace(one.cases[0], load_case=replace(one.cases[0].load_case, name="pull"))
    return Run(replace(one, cases=(one.cases[0], other))).load_factor


@brings("extra-missing")
def cluster_without_dask(folder: Path, patch: Patch) -> None:
    patch.setattr(importlib.util, "find_spec", lambda name: None)
    check_options(EngineOptions(scheduler="tcp://stone:8786"))


@brings("no-mechanism")
def film_of_what_stands_still(folder: Path, patch: Patch) -> None:
    patch.setattr(animation, "scene_of", lambda *arguments: SimpleNamespace(motion=np.zeros(3)))
    animation.write_animation(tower_results(), tower_results().cases[0], folder / "a.gif")


@brings("macro-blocks-not-possible")
def glue_after_a_table_of_joints(folder: Path, patch: Patch) -> None:
    refuse_joints_of_table(b"# of a survey\ninterface; group_a; index_a; group_b; index_b; x; y; z; joint\n")


@brings("unknown-table")
def table_that_is_none(folder: Path, patch: Patch) -> object:
    return tables_of(tower_results(), ["walls"], None)


@brings("strengthen-not-possible")
def strengthening_against_a_tilting_table(folder: Path, patch: Patch) -> object:
    deck = changed("{acceleration: [1, 0, 0]}", "{tilt: {axis: [0, 1, 0]}}")
    added = "strengthen: {required: {push: 0.5}, candidates: [{ring: {around: block, z: [0.5]}}]}\n"
    return command("strengthen", str(write(folder, deck + added)))


@brings("too-many-candidates")
def a_bar_at_every_millimetre(folder: Path, patch: Patch) -> object:
    added = "strengthen: {required: {push: 0.5}, candidates: [{vertical: {down: block, every: 1e-3}}]}\n"
    return command("strengthen", str(write(folder, BLOCK + added)))


@brings("interact-load")
def load_without_a_horizontal_part(folder: Path, patch: Patch) -> object:
    return command("interact", str(write(folder, changed("[1, 0, 0]", "[0, 0, 1]"))))


@brings("no-assessment")
def result_that_no_code_is_asked_of(folder: Path, patch: Patch) -> object:
    return api.assess(api.run(BLOCK))


@brings("changes-the-analysis")
def assessment_of_another_structure(folder: Path, patch: Patch) -> object:
    return api.assess(api.run(BLOCK), set={"joints.dry.friction": 0.3})


COMMANDS = {
    "folder_for_a_deck": ("folder-given", "run {folder}"),
    "deck_for_a_folder_that_is_not_there": ("file-missing", "new {folder}/none/deck"),
    "deck_that_is_not_there": ("file-unreadable", "run {folder}/none.yaml"),
    "deck_that_is_a_device": ("not-a-regular-file", "check /dev/null"),
    "starter_below_a_file": ("file-not-written", "new {folder}/" + "n" * 300),
    "starter_over_an_earlier_deck": ("result-exists", "new {deck}"),
    "command_without_a_deck": ("command-line", "run"),
    "identifier_that_nothing_has": ("explain-unknown", "explain xyzzy"),
    "load_case_that_the_deck_lacks": ("unknown-load-case", "run {deck} --case pull"),
    "nothing_that_was_stopped": ("nothing-to-resume", "run {deck} --resume -q"),
    "nothing_expected": ("no-expectations", "run {deck} --expected -q"),
    "picture_as_a_text": ("output-format", "plot {result} -o {folder}/a.bmp"),
    "picture_of_an_unknown_kind": ("picture-option", "plot {result} --dpi 9"),
    "pictures_in_one_file": ("several-pictures-one-file", "plot {result} --kind model,forces -o {folder}/a.png"),
    "angles_of_directions": ("interact-option", "interact {deck} --from 10"),
    "value_of_nothing": ("find-option", "find {deck}"),
    "strengthening_by_nothing": ("no-strengthening", "strengthen {deck}"),
    "knob_without_a_value": ("tradeoff-option", "tradeoff {deck} --knob analysis.accuracy"),
    "folder_without_a_table": ("sweep-table-damaged", "sweep-plot {folder}"),
}
"""commands that end with an error of their own: its identifier, and their words, with a deck, a result and a folder"""


def calling(line: str) -> Bring:
    """A command, with the files that it names."""

    def bring(folder: Path, patch: Patch) -> object:
        made = {"folder": str(folder)}
        made |= {"deck": str(write(folder, BLOCK))} if "{deck}" in line else {}
        made |= {"result": str(result(folder))} if "{result}" in line else {}
        return command(*(word.format(**made) for word in line.split()))

    return bring


CASES |= {name: Case(identifier, calling(line)) for name, (identifier, line) in COMMANDS.items()}


# --- models ---------------------------------------------------------------------------------------------------------


@brings("blocks-overlap")
def blocks_in_one_place(folder: Path, patch: Patch) -> object:
    other = "  - box: {group: block, material: stone, min: [0, 0, 0.9], max: [1, 1, 2]}\ncontacts: {joint: dry}"
    deck = read_deck(write(folder, changed("contacts: {joint: dry}", other)))
    return build_assembly(deck, build_model(deck))


@brings("more-faults")
def table_full_of_words(folder: Path, patch: Patch) -> object:
    write(folder, "group,index,fx,fy,fz\n" + "block,0,word,0,0\n" * 12, "loads.csv")
    return build_model(read_deck(write(folder, changed("{acceleration: [1, 0, 0]}", "{table: loads.csv}"))))


@brings("table-unreadable")
def table_that_is_empty(folder: Path, patch: Patch) -> object:
    write(folder, "", "loads.csv")
    return build_model(read_deck(write(folder, changed("{acceleration: [1, 0, 0]}", "{table: loads.csv}"))))


# --- solvers --------------------------------------------------------------------------------------------------------


def cone_program() -> ConeProgram:
    program = line_of(LINE).program
    return kinematic_form(program, program.limits).cone_program


def ignored(record: IterationRecord) -> None:
    """A log that nobody reads."""


@brings("solver-status")
def status_of_another_version(folder: Path, patch: Patch) -> object:
    patch.setattr("mbla.solution.cone_solvers.clarabel_adapter.STATUS_MAP", {})
    return ClarabelProgram(cone_program(), SolverSettings(1e-8), ignored).solve(1, 1.0)


@brings("unknown-solver")
def solver_that_is_none(folder: Path, patch: Patch) -> object:
    return cone_solver(cone_program(), SolverSettings(1e-8, solver="simplex"), ignored)


@brings("program-not-finite")
def program_with_an_infinite_cost(folder: Path, patch: Patch) -> object:
    program = cone_program()
    return ClarabelProgram(
        replace(program, cost=np.full_like(program.cost, np.inf)), SolverSettings(1e-8), ignored
    ).solve(1, 1.0)


@brings("factorisation-missing")
def factorisation_that_is_none(folder: Path, patch: Patch) -> object:
    pattern = SymmetricPattern(1, np.zeros(1, dtype=np.int32), np.array([0, 1], dtype=np.int32))
    return factorization(pattern, "mumps")


# --- sweeps ---------------------------------------------------------------------------------------------------------


@brings("sweep-option")
def resume_and_force(folder: Path, patch: Patch) -> object:
    return open_journal(folder / "journal.csv", HEADER, resume=True, force=True).__enter__()


def journal(folder: Path, resume: bool = False) -> contextlib.AbstractContextManager[Journal]:
    """The journal of a sweep, to be opened."""
    return open_journal(folder / "journal.csv", HEADER, resume=resume, force=False)


@brings("sweep-exists")
def sweep_that_was_run(folder: Path, patch: Patch) -> object:
    with journal(folder):
        pass
    return journal(folder).__enter__()


@brings("journal-damaged")
def journal_of_something_else(folder: Path, patch: Patch) -> object:
    (folder / "journal.csv").write_text("point,state\n1,done\n")
    return journal(folder, resume=True).__enter__()


@brings("journal-of-another-sweep")
def journal_of_another_deck(folder: Path, patch: Patch) -> object:
    with open_journal(folder / "journal.csv", other_header(base_deck="beef"), resume=False, force=False):
        pass
    return journal(folder, resume=True).__enter__()


@brings("locks-missing")
def file_system_without_locks(folder: Path, patch: Patch) -> object:
    patch.setattr(fcntl, "flock", raising(OSError(errno.ENOSYS, "Function not implemented")))
    return journal(folder).__enter__()


@brings("another-run-at-work")
def sweep_that_is_running(folder: Path, patch: Patch) -> object:
    patch.setattr(journal_lock, "PATIENCE", 0.0)
    patch.setattr(fcntl, "flock", raising(BlockingIOError))
    return journal_lock._taken(folder / "journal.csv", folder / "lock", False, None)


@brings("nothing-to-draw")
def map_of_one_parameter(folder: Path, patch: Patch) -> object:
    return plot_sweep(grid({"mu": [0.5, 0.6]}, lambda mu: mu), folder, SweepPictures(kinds=("map",)))


@brings("unknown-column")
def column_of_another_sweep(folder: Path, patch: Patch) -> object:
    return plot_sweep(grid({"mu": [0.5, 0.6]}, lambda mu: mu), folder, SweepPictures(by="nu"))


@brings("sweep-no-point")
def constraints_that_leave_nothing(folder: Path, patch: Patch) -> object:
    text = "mbla_sweep: 1\ndeck: deck.yaml\nparameters: {mu: {values: [0.5]}}\nconstraints: [mu > 1]\n"
    write(folder, BLOCK)
    return command("sweep", str(write(folder, text, "sweep.yaml")), "--dry-run")


@brings("wrong-comparison")
def constraint_that_compares_nothing(folder: Path, patch: Patch) -> object:
    text = "mbla_sweep: 1\ndeck: deck.yaml\nparameters: {mu: {values: [0.5]}}\nconstraints: [mu]\n"
    write(folder, BLOCK)
    return command("sweep", str(write(folder, text, "sweep.yaml")), "--dry-run")


@brings("workers-differ")
def plan_of_another_program(folder: Path, patch: Patch) -> object:
    patch.setattr(child, "program_identity", lambda: "0.2.0+fedcba")
    return child.prepared(plan_over(folder, BLOCK, program="0.1.0+abcdef"))


@brings("deck-changed")
def plan_of_another_deck(folder: Path, patch: Patch) -> object:
    patch.setattr(platform, "node", lambda: "stone")
    return child.prepared(plan_over(folder, BLOCK, fingerprint="f00d"))


@brings("memory-limit-unknown")
def machine_without_limits(folder: Path, patch: Patch) -> object:
    patch.setattr(child, "can_limit", lambda: False)
    patch.setattr(sys, "platform", "plan9")
    return child.prepared(plan_over(folder, BLOCK, memory_limit=1e9))


@brings("scheduler-lost")
def scheduler_without_workers(folder: Path, patch: Patch) -> object:
    raise lost(EngineOptions(scheduler="tcp://stone:8786"))


@brings("scheduler-file")
def scheduler_file_that_is_not_there(folder: Path, patch: Patch) -> object:
    return connected(EngineOptions(scheduler_file=folder / "s.json"))


@brings("no-opengl")
def machine_without_opengl(folder: Path, patch: Patch) -> object:
    pytest.importorskip("pyvista")
    patch.setattr(renderer, "can_draw", lambda: False)
    return renderer.pyvista()


@brings("no-least-load-factor")
def load_that_travels_without_an_answer(folder: Path, patch: Patch) -> object:
    patch.setattr(run, "series_of", lambda cases: (Series("truck", tuple(cases), None),))
    return Run(tower_results()).load_factor


@brings("worker-refused")
def worker_that_does_not_start(folder: Path, patch: Patch) -> None:
    SupervisedRunner(plan_over(folder, BLOCK), (sys.executable, "-c", "raise SystemExit(3)"))._make_ready()


@brings("wrong-value")
def value_that_no_type_describes(folder: Path, patch: Patch) -> object:
    found = {"type": "of_a_later_version", "msg": "is not as it should be", "input": 1, "loc": ("title",)}
    message, _ = validation._words(DeckContent, {"title": 1}, ("title",), found)
    raise DeckError([Fault(Place("deck.yaml", 2, 8), "title", message, "1")])
