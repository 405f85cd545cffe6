"""Result files that are forged as a whole: something is left out, put in or exchanged, and all that follows made anew.

Nothing in such a file contradicts anything else in it. Only the deck, the rows of a curve, and what follows from forces
and mechanisms can say that it is not what a run leaves.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from mbla.deck.deck import sha256_of
from mbla.errors import Message
from mbla.process.run_options import RunOptions
from mbla.questions.angle import Angle
from mbla.results.exit_status import exit_code
from mbla.results.findings import FOUND_AGAIN
from mbla.results.hdf5.result_file import write_results_hdf5
from mbla.results.results import CaseResult, Results
from mbla.run import run
from mbla.solution.further.further import Further
from mbla.solution.pushover.curve_rows import CurveEnd
from mbla.solution.pushover.pushover import NOT_PUSHED, Pushover
from mbla.solution.pushover.record import PushedRows, RowPoints
from mbla.solution.solution import Mechanics, Solution
from mbla.verify import rebuilt, recomputed
from tests.asked import tilt_of
from tests.decks.folder import PATHS
from tests.line import HEAD

DECKS: dict[str, tuple[str, ...]] = {
    "assessed_facade": ("load_cases.outwards.pushover.step=0.05",),
    "rocking_block": ("load_cases.push.pushover.step=0.02", "load_cases.push.pushover.error=false"),
    "tied_wall": (),
    "beam_under_travelling_load": ("load_cases.crane.live.0.travel.positions=4",),
    "tilting_block": (),
    "slopes_of_blocks": (),
    "small_block": (),
    "small_wall": (),
    "small_beam": (),
}
"""decks with curves, codes, objectives, ties, travel, slopes and least states, and what is changed in them"""
WALL = (
    HEAD
    + """\
joints: {dry: {friction: 0.65}}
blocks:
  - wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.175], length: 2.4, courses: 8,
          openings: [{from: [0.8, 0], to: [1.2, 0.875]}]}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
)
"""a wall in the plane, with a state of a lower load factor than that of its path"""
BEAM = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: left, material: stone, min: [0, 0, 0], max: [0.5, 0.5, 1]}
  - box: {group: right, material: stone, min: [2.5, 0, 0], max: [3, 0.5, 1]}
  - box: {group: beam, material: stone, min: [-0.5, 0, 1], max: [3.5, 0.5, 1.4]}
supports: [{ground: {z: 0}}]
load_cases:
  crane: {live: [{travel: {force: [0, 0, -1000], path: [[-0.4, 0.25, 1.4], [3.4, 0.25, 1.4]], positions: 3}}]}
  thrust:
    at: 1
    live: [{acceleration: [0.1, 0, 0]}]
    objective: {force: {from: left, on: beam, direction: [0, 0, 1]}}
  pull:
    live: [{acceleration: [1, 0, 0]}]
    assessment:
      code: circolare_617_2009
      knowledge: LC1
      behaviour_factor: 2
      spectra: {SLV: {en_1998: {a_g: 0.15, type: 1, soil: B}}}
analysis: {sensitivity: [joints.dry.friction], geometric_safety: true}
"""
)
"""a beam under a load that travels, with a force that is sought and a verdict of a code"""
ROCKING = (
    HEAD
    + """\
joints: {dry: {friction: 0.8}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 2]}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}], pushover: {step: 0.1}}
  table: {live: [{tilt: {axis: [0, 1, 0]}}]}
"""
)
"""a block that is pushed until it falls, and on a tilting table"""
OWN = {"small_block": ROCKING, "small_wall": WALL, "small_beam": BEAM}

Forgery = Callable[[Results, random.Random], Results | None]
"""A forged file of a sound one; None where there is nothing to forge in that way."""


def sound_files(folder: Path, names: tuple[str, ...] = tuple(DECKS)) -> dict[str, Results]:
    """Results of the decks, by name."""
    found, known = {}, {path.stem: path for path in PATHS}
    for name in names:
        deck = known.get(name, folder / f"{name}.yaml")
        if name in OWN:
            deck.write_text(OWN[name], encoding="utf-8")
        found[name] = run(deck, RunOptions(folder=folder / name, overrides=(*DECKS[name], "output.vtu=false")))
    return found


def written_anew(path: Path, kind: str, forged: Results) -> None:
    """The file of results forged in some way, with every figure that follows from what they hold."""
    deck, _ = rebuilt(forged, {})
    whole = forged if kind in FOLLOWING else recomputed(forged, deck)
    path.write_bytes(write_results_hdf5(replace(whole, exit_code=exit_code(whole.cases, whole.notices))))


def _of_case(
    results: Results, generator: random.Random, change: Callable[[CaseResult], CaseResult | None]
) -> Results | None:
    """One of the cases in which something can be changed, changed."""
    changed = [(row, new) for row, case in enumerate(results.cases) if (new := change(case)) is not None]
    if not changed:
        return None
    row, new = generator.choice(changed)
    return replace(results, cases=(*results.cases[:row], new, *results.cases[row + 1 :]))


def _with(case: CaseResult, **changes: Any) -> CaseResult:
    """A case with another solution; further results go by their own names, and those of a pushover."""
    solution = case.solution
    further, pushover = solution.further, solution.further.pushover
    own = {name: changes.pop(name) for name in list(changes) if name in Pushover.__dataclass_fields__}
    others = {name: changes.pop(name) for name in list(changes) if name in Further.__dataclass_fields__}
    further = replace(further, **{"pushover": replace(pushover, **own), **others})
    return replace(case, solution=replace(solution, further=further, **changes))


def _case_removed(results: Results, generator: random.Random) -> Results | None:
    row = generator.randrange(len(results.cases))
    return replace(results, cases=results.cases[:row] + results.cases[row + 1 :])


def _all_cases_removed(results: Results, generator: random.Random) -> Results | None:
    return replace(results, cases=())


def _some_of_a_series_removed(results: Results, generator: random.Random) -> Results | None:
    """Positions of a load that travels, or an end of an objective."""
    series = [case for case in results.cases if case.load_case.question.series]
    if not series:
        return None
    gone = {case.load_case.name for case in generator.sample(series, generator.randint(1, len(series)))}
    return replace(results, cases=tuple(case for case in results.cases if case.load_case.name not in gone))


def _rows_cut_off(results: Results, generator: random.Random) -> Results | None:
    def cut(case: CaseResult) -> CaseResult | None:
        steps = case.solution.further.pushover.rows
        if steps is None or len(steps) < 3:
            return None
        rows = generator.randint(1, len(steps) - 1)
        return _with(case, rows=first_of(steps, rows), curve=case.solution.further.pushover.curve[:rows])

    return _of_case(results, generator, cut)


def first_of(every: PushedRows, rows: int) -> PushedRows:
    """The first rows of a pushover."""
    names = ("load_factors", "shifts", "turns", "fallen", "energies", "errors", "jumps", "unsolved")
    kept = {name: getattr(every, name)[:rows] for name in names}
    start = every.point_start[: rows + 1]
    points = RowPoints(**{name: values[: int(start[-1])] for name, values in vars(every.points).items()})
    return replace(every, **kept, point_start=start, points=points)


def _another_end(results: Results, generator: random.Random) -> Results | None:
    def end(case: CaseResult) -> CaseResult | None:
        others = [each for each in CurveEnd if each not in (CurveEnd.NONE, case.solution.further.pushover.curve_end)]
        return None if case.solution.further.pushover.rows is None else _with(case, curve_end=generator.choice(others))

    return _of_case(results, generator, end)


def _left_out(what: str, none: object, identifier: str, words: str) -> Forgery:
    """A part of a solution left out, with the remark that a run makes where it has none, or without a word."""

    def forgery(results: Results, generator: random.Random) -> Results | None:
        said = (Message(identifier, words),) if generator.random() < 0.7 else ()

        def change(case: CaseResult) -> CaseResult | None:
            solution = case.solution
            if not _present(solution, what):
                return None
            return _with(case, **{what: none}, remarks=(*solution.remarks, *said))

        return _of_case(results, generator, change)

    return forgery


def _present(solution: Solution, what: str) -> bool:
    if what == "associative" and solution.flow_rule == "associative":
        return False  # the case's own answer is that one
    part = getattr(solution.further if what in Further.__dataclass_fields__ else solution, what)
    return part is not None and part not in ((), NOT_PUSHED)


def _least(change: Callable[[CaseResult, Mechanics, random.Random], Mechanics | None]) -> Forgery:
    """Another state in place of the least, where that has one."""

    def forgery(results: Results, generator: random.Random) -> Results | None:
        def changed(case: CaseResult) -> CaseResult | None:
            least = case.solution.least
            other = None if least is None else change(case, least, generator)
            return None if other is None else _with(case, least=other)

        return _of_case(results, generator, changed)

    return forgery


def _other_factor(case: CaseResult, least: Mechanics, generator: random.Random) -> Mechanics:
    return replace(least, load_factor=least.load_factor * generator.choice([0.5, 0.9, 1.1]))


def _other_forces(case: CaseResult, least: Mechanics, generator: random.Random) -> Mechanics:
    return replace(least, contact_forces=least.contact_forces * generator.choice([0.9, 1.1]))


def _by_associative(case: CaseResult, least: Mechanics, generator: random.Random) -> Mechanics | None:
    """Where joints of the associative mechanism lift as they slide."""
    other = case.solution.associative
    return other if other is not None and other.load_factor > 1.01 * least.load_factor else None


def _state_by_least(results: Results, generator: random.Random) -> Results | None:
    """The least state passed for that of the path, with its history or with none."""
    with_history = generator.random() < 0.5

    def change(case: CaseResult) -> CaseResult | None:
        own, least = case.solution.mechanics, case.solution.least
        if own is None or least is None or own.load_factor < 1.01 * least.load_factor:
            return None
        known = (own.remembered, own.stiffness) if with_history else (None, None)
        return _with(case, mechanics=replace(least, remembered=known[0], stiffness=known[1]))

    return _of_case(results, generator, change)


def _history_removed(results: Results, generator: random.Random) -> Results | None:
    def change(case: CaseResult) -> CaseResult | None:
        own = case.solution.mechanics
        if own is None or own.remembered is None:
            return None
        rigid = replace(own, remembered=None, stiffness=None, tie_remembered=None, tie_stiffness=None)
        return _with(case, mechanics=rigid)

    return _of_case(results, generator, change)


def _path_not_followed(results: Results, generator: random.Random) -> Results | None:
    """Its rows removed, or the end of a path that was lost."""
    lost = {"path_end": generator.choice(["", "stuck", "breaks down", "budget"])}
    changes: dict[str, Any] = generator.choice([{"path": ()}, lost])

    def change(case: CaseResult) -> CaseResult | None:
        return _with(case, **changes) if case.solution.path else None

    return _of_case(results, generator, change)


def _remark_removed(results: Results, generator: random.Random) -> Results | None:
    def change(case: CaseResult) -> CaseResult | None:
        remarks = case.solution.remarks
        known = [row for row, remark in enumerate(remarks) if remark.identifier in FOUND_AGAIN]
        if not known:
            return None
        row = generator.choice(known)
        return _with(case, remarks=remarks[:row] + remarks[row + 1 :])

    return _of_case(results, generator, change)


def _remark_invented(results: Results, generator: random.Random) -> Results | None:
    identifier = generator.choice([*sorted(FOUND_AGAIN), "certified", "livesley-confirms", "tilt-by-steps"])

    def change(case: CaseResult) -> CaseResult | None:
        if identifier == "tilt-by-steps" and case.load_case.question.by_steps:
            return None
        return _with(case, remarks=(*case.solution.remarks, Message(identifier, "all is well")))

    return _of_case(results, generator, change)


def _angle(results: Results, generator: random.Random) -> Results | None:
    """Below an angle that the file may state."""
    return _of_table(results, angle=generator.choice([45.0, 10.0, 0.1]))


def _no_tangent(results: Results, generator: random.Random) -> Results | None:
    """The load factor is no tangent of the angle any more, and the angle is lost."""
    return _of_table(results, tangent=False)


def _of_table(results: Results, **changes: Any) -> Results | None:
    """All tilting tables changed."""
    cases = tuple(
        replace(case, question=Angle(replace(tilt_of(case), **changes))) if case.question.tilts else case
        for case in results.model.load_cases
    )
    if not any(case.question.tilts for case in cases):
        return None
    known = {case.name: case for case in cases}
    solved = tuple(replace(case, load_case=known[case.load_case.name]) for case in results.cases)
    return replace(
        results, assembly=replace(results.assembly, model=replace(results.model, load_cases=cases)), cases=solved
    )


def _search_written(results: Results, generator: random.Random) -> Results | None:
    """Written into what the user changed, with the hash of that."""
    record = results.deck
    overrides = (*record.overrides, f"analysis.search={generator.choice([2, 4, 50])}")
    sha256 = sha256_of([*(text for _, text in record.sources), *overrides])
    return replace(results, deck=replace(record, overrides=overrides, sha256=sha256))


def _end_of_path(results: Results, generator: random.Random) -> Results | None:
    """Another load factor while it moves, or other rows, as where the load falls."""

    def change(case: CaseResult) -> CaseResult | None:
        path, by = case.solution.path, generator.choice([0.5, 0.9])
        if not path:
            return None
        rows = tuple(replace(step, load_factor=step.load_factor * by) for step in path)
        last: dict[str, Any] = {"path_end": "falls", "path_last": case.solution.path_last * by}
        return _with(case, **generator.choice([last, {"path": rows}]))

    return _of_case(results, generator, change)


FORGERIES: Mapping[str, Forgery] = {
    "a case removed": _case_removed,
    "all cases removed": _all_cases_removed,
    "positions or ends removed": _some_of_a_series_removed,
    "rows of a pushover cut off": _rows_cut_off,
    "another end of a pushover": _another_end,
    "pushover removed": _left_out(
        "pushover", NOT_PUSHED, "pushover-not-done", "there is no pushover: joints can crush"
    ),
    "slopes removed": _left_out("sensitivity", (), "sensitivity-not-done", "there is no sensitivity: it is not proved"),
    "geometric safety removed": _left_out(
        "geometric_safety", None, "geometric-safety-not-done", "there is no geometric factor of safety: there are ties"
    ),
    "associative answer removed": _left_out("associative", None, "associative-bounds-apart", "with associative flow"),
    "least state removed": _left_out("least", None, "lower-not-searched", "states of lower load factors: none"),
    "load factor of the least state": _least(_other_factor),
    "forces of the least state": _least(_other_forces),
    "least state by the associative one": _least(_by_associative),
    "state of the path by the least": _state_by_least,
    "history of joints removed": _history_removed,
    "path not followed": _path_not_followed,
    "end of a path": _end_of_path,
    "remark removed": _remark_removed,
    "remark invented": _remark_invented,
    "angle of a table": _angle,
    "tangent of a table": _no_tangent,
    "search written into the deck": _search_written,
}
"""by what is done"""
FOLLOWING = ("angle of a table", "tangent of a table", "slopes removed")
"""what is forged here follows from the rest, and is not made anew"""
