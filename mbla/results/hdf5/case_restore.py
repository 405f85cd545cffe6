"""A load case's results from the content of a result file: the way back from ``case_content``."""

from __future__ import annotations

from typing import Any, TypeVar, get_args

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.sections.analysis import AnalysisSection
from mbla.errors import Message
from mbla.model.model import LoadCase
from mbla.program.reductions import ProgramSize, ReductionOutcome, ReductionStep
from mbla.program.reductions.steps import REDUCTIONS
from mbla.results.assessment import NAMES, REMARKS, Assessment, Figure
from mbla.results.hdf5.held import held
from mbla.results.hdf5.history_restore import history_from
from mbla.results.quantities.answers import ANSWERS, MOTIONS
from mbla.results.results import CaseResult
from mbla.solution.further.further import Further
from mbla.solution.further.geometric_safety.geometric_safety import GeometricSafety
from mbla.solution.further.sensitivity.slopes import Side, Slope
from mbla.solution.further.soil_range.soil_path import SoilPath
from mbla.solution.modes.modes import NO_MODES, Modes
from mbla.solution.pushover.curve_rows import CurveEnd, CurveRow
from mbla.solution.pushover.pushover import NOT_PUSHED, Pushover
from mbla.solution.pushover.record import PushedRows, RowPoints
from mbla.solution.solution import (
    Checks,
    ContactMode,
    IterationRecord,
    Mechanics,
    ModelSize,
    PathByStiffness,
    PathPoint,
    ProgramRecord,
    Solution,
    Standing,
    StandingResult,
    Status,
)

Record = TypeVar("Record")


def case_from(load_case: LoadCase, get: dict[str, Any]) -> CaseResult:
    """The results of a load case from the content below it; raises ValueError where it contradicts itself."""
    answers: dict[str, Any] = {
        part: _mechanics(get, f"{group}/".lstrip("/"), part) for part, (group, *_) in ANSWERS.items()
    }
    if answers["associative"] is None and get["flow_rule"] == "associative":
        answers["associative"] = answers["mechanics"]
    for name in ("flow_rule", "contact_model"):
        if get[name] not in _choices(name):
            raise ValueError(f"{name} of a load case")
    if not {get["solver"], *get["programs/solver"]} <= {"", *_choices("solver")}:
        raise ValueError("name of a solver")
    own = held(Solution, "", get) | {
        "status": Status(get["claimed_status"]),
        "stress_blocks": bool(get["stress_blocks"]),
        "remarks": _messages(get, "remarks"),
        "level_lock": get.get("level/lock"),
        "certificate": get.get("certificate"),
        "lock": get.get("lock"),
        "certificate_motions": _motions(get, "certificate_"),
        "standing": _standing(get),
        "size": _size(get),
        "reductions": _reductions(get),
        "programs": records(ProgramRecord, get, "programs"),
        "iterations": records(IterationRecord, get, "iterations"),
        "path": records(PathPoint, get, "path"),
        "path_by_stiffness": records(PathByStiffness, get, "path_by_stiffness"),
        "further": Further(
            pushover=_pushover(get),
            time_history=history_from(get),
            sensitivity=records(Slope, get, "sensitivity") if "sensitivity/parameter" in get else (),
            geometric_safety=_geometric_safety(get),
            modes=_modes(get, "vibration"),
            modes_after=_modes(get, "vibration_after"),
            soil_range=records(SoilPath, get, "soil_range") if "soil_range/share" in get else (),
        ),
    }
    checks = held(Checks, "", get) | {"failures": _messages(get, "failures")}
    solution = Solution(**own, **answers)
    assessment = _assessment(load_case, get, solution)
    return CaseResult(load_case, solution, Checks(**checks), Status(get["status"]), assessment)


def _assessment(load_case: LoadCase, get: dict[str, Any], solution: Solution) -> Assessment | None:
    """What a code said; its remarks are among those on the solution."""
    if load_case.assessment is None or "assessment/symbol" not in get:
        return None
    remarks = tuple(each for each in solution.remarks if each.identifier in REMARKS)
    return Assessment(NAMES[load_case.assessment.code], records(Figure, get, "assessment"), remarks)


ENERGIES = ("live_work", "friction", "tie_work", "crushing", "potential")
"""Columns of the rows of a pushover, in the order of their record."""


def _pushover(get: dict[str, Any]) -> Pushover:
    """A pushover with what its rows follow from."""
    if "curve/step" not in get:
        return NOT_PUSHED
    points = RowPoints(**held(RowPoints, "pushed", get))
    rows = PushedRows(
        **held(PushedRows, "pushed", get),
        load_factors=get["curve/load_factor"],
        energies=np.column_stack([get[f"curve/{name}"] for name in ENERGIES]),
        errors=get["curve/error"],
        jumps=get["curve/jumps"],
        unsolved=get["curve/unsolved"],
        points=points,
    )
    start = rows.point_start
    if not len(rows) or len(start) != len(rows) + 1 or start[0] != 0 or start[-1] != len(points.forces):
        raise ValueError("rows of a pushover")
    if (np.diff(start) < 0).any() or start[1] != 0:
        raise ValueError("points of a pushover")
    own = held(Pushover, "", get) | {"curve_end": CurveEnd(get["curve_end"])}
    return Pushover(**own, curve=records(CurveRow, get, "curve"), rows=rows)


def _geometric_safety(get: dict[str, Any]) -> GeometricSafety | None:
    if "geometric_safety/sizes" not in get:
        return None
    values = held(GeometricSafety, "geometric_safety", get)
    if not 1 <= len(values["sizes"]) <= 2 or not (values["sizes"] > 0.0).all():
        raise ValueError("sizes of joints")
    return GeometricSafety(**values | {"verified": bool(values["verified"])})


def _modes(get: dict[str, Any], group: str) -> Modes:
    if f"{group}/periods" not in get:
        return NO_MODES
    values = held(Modes, group, get)
    if not (len(values["periods"]) and (values["periods"] > 0.0).all() and (np.diff(values["periods"]) <= 0.0).all()):
        raise ValueError("periods of modes")
    return Modes(**values | {"verified": bool(values["verified"])})


def _choices(key: str) -> tuple[str, ...]:
    """Of a key of the analysis."""
    return get_args(AnalysisSection.model_fields[key].annotation)


def _messages(get: dict[str, Any], group: str) -> tuple[Message, ...]:
    return tuple(map(Message, get[f"{group}/identifier"], get[f"{group}/message"]))


def _mechanics(get: dict[str, Any], group: str, part: str) -> Mechanics | None:
    if f"{group}load_factor" not in get:
        if f"{group}resultants" in get:
            raise ValueError(f"resultants without forces: {part}")
        return None
    if not np.isin(get[f"{group}modes"], [int(mode) for mode in ContactMode]).all():
        raise ValueError("contact modes")
    return Mechanics(**held(Mechanics, group.removesuffix("/"), get), interface_motions=_motions(get, group))


def _motions(get: dict[str, Any], group: str) -> FloatArray | None:
    """Motions of interfaces by torsion and by crushing."""
    if f"{group}torsion_motions" not in get:
        return None
    return np.stack([get[group + name] for name in MOTIONS], axis=1)


def _standing(get: dict[str, Any]) -> StandingResult | None:
    if "standing/verdict" not in get:
        return None
    falls = get["standing/falls"].tolist()
    if len(falls) > 1:
        raise ValueError("more than one block that falls first")
    own = held(StandingResult, "standing", get) | {"verdict": Standing(get["standing/verdict"])}
    return StandingResult(**own, block=falls[0] if falls else None)


def _size(get: dict[str, Any]) -> ModelSize | None:
    if "size/dimension" not in get:
        return None
    size = ModelSize(**held(ModelSize, "size", get))
    if size.dimension not in (2, 3):
        raise ValueError("dimension of the model")
    return size


def _reductions(get: dict[str, Any]) -> tuple[ReductionStep, ...]:
    """Files of runs without any have no such table."""
    if "reductions/name" not in get:
        return ()
    sizes = {}
    for when in ("before", "after"):
        columns = [get[f"reductions/{name}_{when}"] for name in ProgramSize.__dataclass_fields__]
        sizes[when] = [ProgramSize(*row) for row in np.column_stack(columns).tolist()]
    found = get["reductions/name"], get["reductions/state"], get["reductions/found"].tolist()
    if not set(found[0]) <= {"glued", *REDUCTIONS}:
        raise ValueError("name of a reduction")
    rows = zip(*found, sizes["before"], sizes["after"], strict=True)
    return tuple(ReductionStep(name, ReductionOutcome(state), *row) for name, state, *row in rows)


def records(kind: type[Record], get: dict[str, Any], group: str) -> tuple[Record, ...]:
    """A list of records from its columns."""
    found = held(kind, group, get)
    columns = {name: column if isinstance(column, list) else column.tolist() for name, column in found.items()}
    for name, choice in (("status", Status), ("side", Side)):
        if name in columns:
            columns[name] = [choice(value) for value in columns[name]]
    return tuple(kind(**dict(zip(columns, row, strict=True))) for row in zip(*columns.values(), strict=True))
