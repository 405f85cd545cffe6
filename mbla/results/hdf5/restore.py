"""Results from the content of a result file: its deck builds model and contacts again, its arrays are what was found.

The content has been checked against the layout already; what is checked here is what no table can say.
"""

from __future__ import annotations

import tempfile
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from mbla.assembly import Assembly, build_assembly
from mbla.errors import DeckError, FileError, Notice
from mbla.model import build_model
from mbla.model.model import LoadCase
from mbla.model.settlement import with_reference
from mbla.model.soil.soil_figure import SoilFigure
from mbla.model.soil.soil_mesh import SoilCorners, StrangeCornersError
from mbla.questions.angle import Angle
from mbla.questions.load_factor import LOAD_FACTOR
from mbla.questions.reaction import Reaction
from mbla.questions.tilt import chord
from mbla.questions.travel import Travel
from mbla.results.hdf5.case_restore import case_from, records
from mbla.results.hdf5.layout import Content
from mbla.results.provenance import deck_of
from mbla.results.quantities.registry import STORED_BY_PATH
from mbla.results.results import CaseResult, DeckRecord, Results
from mbla.solution.verification.tilting_table import angle_of_load, leads_across

LOADS_FOUND = tuple(
    STORED_BY_PATH[f"cases/*/{name}"]
    for name in ("live_load", "pushover/step", "settlement/reference", "tilt/angle", "tilt/tangent", "tilt/upright")
) + tuple(STORED_BY_PATH[f"cases/*/soil/{field.name}"] for field in fields(SoilFigure))
"""what solving finds of the loads of a case, so that no deck says it: the reaction from which a support gives way, the
angle of a tilting table, and at which position of a travelling load the structure is pushed, and load
factors on meshes of soil"""
SOIL_FOUND = tuple(
    STORED_BY_PATH[f"model/{name}"] for name in ("soil_names", "soil_sizes", "soil_moved", "soil_start", "soil_corners")
)
"""corners of cells of soil, as they were moved"""


def deck_record(get: Content, attributes: dict[str, str | int]) -> DeckRecord:
    """The deck of a file, from the content below ``deck``."""
    found: dict[str, Any] = get
    start, content = found["deck/file_start"], found["deck/file_bytes"].tobytes()
    files = ((name, content[start[row] : start[row + 1]]) for row, name in enumerate(found["deck/file_names"]))
    return DeckRecord(
        name=found["deck/name"],
        sources=tuple(zip(found["deck/source_names"], found["deck/source_texts"], strict=True)),
        overrides=tuple(found["deck/overrides"]),
        sha256=str(attributes["deck_sha256"]),
        files=tuple(files),
    )


def built_again(record: DeckRecord, path: Path, get: Content) -> Assembly:
    """Model and contacts of the deck in a file; FileError where that is not valid.

    get : with the corners of soil as they were moved
    """
    with tempfile.TemporaryDirectory() as name:
        try:
            deck = deck_of(record, Path(name), expected=False)
            return build_assembly(deck, build_model(deck, soil_corners(get)))
        except (DeckError, FileError, StrangeCornersError) as error:
            why = str(error.faults[0] if isinstance(error, DeckError) else error).replace(f"{name}/", "")
            words = f"{path}: the deck in the file is not valid: {why}"
            raise FileError("damaged-result-file", words) from error


def soil_corners(content: Content) -> dict[str, SoilCorners]:
    """Corners of cells by name of the soil."""
    get: dict[str, Any] = content
    if "model/soil_names" not in get:
        return {}
    start, points = get["model/soil_start"], get["model/soil_corners"]
    rows = zip(get["model/soil_names"], get["model/soil_sizes"].tolist(), get["model/soil_moved"].tolist(), strict=True)
    return {
        name: SoilCorners(size, points[start[row] : start[row + 1]], moved)
        for row, (name, size, moved) in enumerate(rows)
    }


def with_loads_found(assembly: Assembly, get: Content) -> Assembly:
    """The assembly with what was found of its loads by solving."""
    return assembly.with_load_cases(
        tuple(_found(case, _part(get, f"cases/{case.name}/")) for case in assembly.model.load_cases)
    )


def _found(case: LoadCase, get: dict[str, Any]) -> LoadCase:
    if "soil/cells" in get:
        case = replace(case, soil=records(SoilFigure, get, "soil"))
    match case.question:
        case Reaction() if "settlement/reference" in get:
            return with_reference(case, get["settlement/reference"])
        case Travel() if "pushover/step" not in get:
            return replace(case, pushover=None)
        case Angle(tilt) if "tilt/tangent" in get and "live_load" in get:
            angle, upright, live_load = get["tilt/angle"], get["tilt/upright"], get["live_load"]
            tilt = replace(tilt, angle=angle, tangent=bool(get["tilt/tangent"]), upright=upright)
            if not tilt.tangent and not leads_across(tilt, live_load):
                case = replace(case, live_load=chord(tilt, angle_of_load(tilt, live_load)))
            return replace(case, question=Angle(tilt))
    return case


def results_from(content: Content, attributes: dict[str, str | int], record: DeckRecord, assembly: Assembly) -> Results:
    """Results from content and root attributes; raises ValueError where they contradict themselves.

    assembly : of the deck of the file, with the loads as they were found
    """
    get: dict[str, Any] = content
    complete = bool(attributes["complete"])
    if complete is ("provenance/not_done" in get):
        raise ValueError("whether the run came to its end")
    load_cases = assembly.model.load_cases
    cases = tuple(
        case_from(load_case, _part(get, f"cases/{load_case.name}/"))
        for load_case in load_cases
        if f"cases/{load_case.name}/status" in get
    )
    for case in cases:
        check_carriers(assembly, case)
        check_rows(assembly, case)
    return Results(
        deck=record,
        assembly=assembly,
        cases=cases,
        notices=_notices(_part(get, "notices/")),
        provenance=dict(zip(get["provenance/names"], get["provenance/values"], strict=True)),
        settings=dict(zip(get["provenance/setting_names"], get["provenance/setting_values"], strict=True)),
        time=dict(zip(get["provenance/stage_names"], get["provenance/stage_seconds"].tolist(), strict=True)),
        exit_code=get["provenance/exit_code"],
        created=str(attributes["created"]),
        files=tuple(get["provenance/files"]),
        complete=complete,
        not_done=() if complete else tuple(get["provenance/not_done"]),
    )


def check_carriers(assembly: Assembly, case: CaseResult) -> None:
    """Raises ValueError where forces are not those of all contact points and of the ties behind them."""
    solution = case.solution
    standing = None if solution.standing is None else solution.standing.forces
    found = [forces for forces in (standing, solution.lock, solution.level_lock) if forces is not None]
    if found:
        carriers = assembly.of(replace(case.load_case, question=LOAD_FACTOR)).contacts.points
        if any(len(forces) != len(carriers) for forces in found):
            raise ValueError(f"{case.load_case.name}: forces of another number of contact points and ties")


def check_rows(assembly: Assembly, case: CaseResult) -> None:
    """Raises ValueError where contact points of a pushover are of bodies, joint laws or ties that are not there.

    Those of a row are points of solids and grounds, and after them ties, whose bodies are −1.
    """
    rows = case.solution.further.pushover.rows
    if rows is None:
        return
    model, solids = assembly.model.of_case(case.load_case), assembly.glued(case.load_case).model.blocks
    bodies, laws, place = rows.points.bodies, rows.points.laws, f"cases/{case.load_case.name}/pushed"
    tie = bodies[:, 0] < 0
    n_bodies = len(solids) + len(model.grounds)
    if (bodies[tie] != -1).any() or (bodies[~tie] < 0).any() or (bodies >= n_bodies).any():
        raise ValueError(f"{place}/bodies points outside the {n_bodies} bodies, or at none that is a tie")
    after_tie = tie[:-1] & ~tie[1:]
    after_tie[np.setdiff1d(rows.point_start[1:-1], [0, len(tie)]) - 1] = False
    if after_tie.any():
        raise ValueError(f"{place}/bodies has ties before contact points of their row")
    if (laws < 0).any() or (laws >= np.where(tie, len(model.ties), len(model.joints))).any():
        raise ValueError(f"{place}/law points outside the joint laws, or the ties, of the deck")


def _part(content: Content, prefix: str) -> dict[str, Any]:
    return {path[len(prefix) :]: value for path, value in content.items() if path.startswith(prefix)}


def _notices(get: dict[str, Any]) -> tuple[Notice, ...]:
    if not set(get["severity"]) <= {"notice", "warning"}:
        raise ValueError("severity of a notice")
    return tuple(Notice(*row) for row in zip(get["severity"], get["identifier"], get["message"], strict=True))
