"""A load case's results from the content of a result file: the way back from ``case_content``."""

from __future__ import annotations

from typing import Any, TypeVar, get_args

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.sections.analysis import AnalysisSection
from mbla.errors import Message
from mbla.model.model import LoadCase
from mbla.program.reductions import ProgramSize, ReductionStep, StepState
from mbla.program.reductions.steps import REDUCTIONS
from mbla.results.assessment import NAMES, REMARKS, Assessment, Figure
from mbla.results.hdf5.content import HISTORY, MOTIONS
from mbla.results.record.quantity import ANSWERS, stored
from mbla.results.results import CaseResult
from mbla.solution.further.further import Further
from mbla.solution.further.geometric_safety.geometric_safety import GeometricSafety
from mbla.solution.further.sensitivity.slopes import Side, Slope
from mbla.solution.pushover.pushed import CurveEnd, CurveRow
from mbla.solution.pushover.pushover import NOT_PUSHED, Pushover
from mbla.solution.pushover.record import PushedRows, RowPoints
from mbla.solution.solution import (
    Checks,
    ContactMode,
    Mechanics,
    ModelSize,
    Solution,
    Standing,
    StandingResult,
    Status,
)

Record = TypeVar("Record")


def case_from(load_case: LoadCase, get: dict[str, Any]) -> CaseResult:
    """The results of a load case from the content below it; raises ValueError where it contradicts itself."""
    answers: dict[str, Any] = {
        part: _mechanics(get, f"{group}/".lstrip("/"), part) for part, (group, _) in ANSWERS.items()
    }
    if answers["associative"] is None and get["flow_rule"] == "associative":
        answers["associative"] = answers["mechanics"]
    for name in ("flow_rule", "contact_model"):
        if get[name] not in _choices(name):
            raise ValueError(f"{name} of a load case")
    if not {get["solver"], *get["programs/solver"]} <= {"", *_choices("solver")}:
        raise ValueError("name of a solver")
    own = held(Solution, "cases/*", get) | {
        "status": Status(get["claimed_status"]),
        "stress_blocks": bool(get["stress_blocks"]),
        "remarks": _messages(get, "remarks"),
        "level_lock": get.get("level/lock"),
        "certificate": get.get("certificate"),
        "certificate_motions": _motions(get, "certificate_"),
        "standing": _standing(get),
        "size": _size(get),
        "reductions": _reductions(get),
        **{name: _records(kind, get, name) for name, kind in HISTORY.items()},
        "further": Further(
            pushover=_pushover(get),
            sensitivity=_records(Slope, get, "sensitivity") if "sensitivity/parameter" in get else (),
            geometric_safety=_geometric_safety(get),
        ),
    }
    checks = held(Checks, "cases/*", get) | {"failures": _messages(get, "failures")}
    solution = Solution(**own, **answers)
    assessment = _assessment(load_case, get, solution)
    return CaseResult(load_case, solution, Checks(**checks), Status(get["status"]), assessment)


def _assessment(load_case: LoadCase, get: dict[str, Any], solution: Solution) -> Assessment | None:
    """What a code said; its remarks are among those on the solution."""
    if load_case.assessment is None or "assessment/symbol" not in get:
        return None
    remarks = tuple(each for each in solution.remarks if each.identifier in REMARKS)
    return Assessment(NAMES[load_case.assessment.code], _records(Figure, get, "assessment"), remarks)


ENERGIES = ("live_work", "friction", "tie_work", "crushing", "potential")
"""Columns of the rows of a pushover, in the order of their record."""


def _pushover(get: dict[str, Any]) -> Pushover:
    """A pushover with what its rows follow from."""
    if "curve/step" not in get:
        return NOT_PUSHED
    points = RowPoints(
        bodies=get["pushed/bodies"],
        host=get["pushed/host"],
        arms=get["pushed/arms"],
        frames=get["pushed/frames"],
        laws=get["pushed/law"],
        areas=get["pushed/areas"],
        history=get["pushed/at_zero"],
        forces=get["pushed/contact_forces"],
    )
    rows = PushedRows(
        load_factors=get["curve/load_factor"],
        shifts=get["pushed/shift"],
        turns=get["pushed/rotation"],
        fallen=get["pushed/fallen"],
        energies=np.column_stack([get[f"curve/{name}"] for name in ENERGIES]),
        errors=get["curve/error"],
        jumps=get["curve/jumps"],
        unsolved=get["curve/unsolved"],
        point_start=get["pushed/point_start"],
        points=points,
        stiffness=get["pushed/stiffness"],
    )
    start = rows.point_start
    if not len(rows) or len(start) != len(rows) + 1 or start[0] != 0 or start[-1] != len(points.forces):
        raise ValueError("rows of a pushover")
    if (np.diff(start) < 0).any() or start[1] != 0:
        raise ValueError("points of a pushover")
    own = held(Pushover, "cases/*", get) | {"curve_end": CurveEnd(get["curve_end"])}
    return Pushover(**own, curve=_records(CurveRow, get, "curve"), rows=rows)


def _geometric_safety(get: dict[str, Any]) -> GeometricSafety | None:
    if "geometric_safety/sizes" not in get:
        return None
    values = {name: get[f"geometric_safety/{name}"] for name in stored(GeometricSafety, "cases/*/geometric_safety")}
    if not 1 <= len(values["sizes"]) <= 2 or not (values["sizes"] > 0.0).all():
        raise ValueError("sizes of joints")
    return GeometricSafety(**values | {"verified": bool(values["verified"])})


def _choices(key: str) -> tuple[str, ...]:
    """Of a key of the analysis."""
    return get_args(AnalysisSection.model_fields[key].annotation)


def held(kind: type, place: str, get: dict[str, Any]) -> dict[str, Any]:
    """Fields of a dataclass by name, those that are there."""
    return {name: get[name] for name in stored(kind, place) if name in get}


def _messages(get: dict[str, Any], group: str) -> tuple[Message, ...]:
    return tuple(map(Message, get[f"{group}/identifier"], get[f"{group}/message"]))


def _mechanics(get: dict[str, Any], group: str, part: str) -> Mechanics | None:
    if f"{group}load_factor" not in get:
        if f"{group}resultants" in get:
            raise ValueError(f"resultants without forces: {part}")
        return None
    if not np.isin(get[f"{group}modes"], [int(mode) for mode in ContactMode]).all():
        raise ValueError("contact modes")
    values: dict[str, Any] = {name: get.get(group + name) for name in stored(Mechanics, "cases/*")}
    return Mechanics(**values, interface_motions=_motions(get, group))


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
    return StandingResult(
        Standing(get["standing/verdict"]),
        falls[0] if falls else None,
        get["standing/reason"],
        get.get("standing/contact_forces"),
        get.get("standing/settlement"),
    )


def _size(get: dict[str, Any]) -> ModelSize | None:
    if "size/dimension" not in get:
        return None
    size = ModelSize(**{name: get[f"size/{name}"] for name in stored(ModelSize, "cases/*/size")})
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
    return tuple(ReductionStep(name, StepState(state), *row) for name, state, *row in rows)


def _records(kind: type[Record], get: dict[str, Any], group: str) -> tuple[Record, ...]:
    """A list of records from its columns."""
    names = stored(kind, f"cases/*/{group}")
    found = [get[f"{group}/{name}"] for name in names]
    columns = [column if isinstance(column, list) else column.tolist() for column in found]
    for name, choice in (("status", Status), ("side", Side)):
        if name in names:
            columns[names.index(name)] = [choice(value) for value in columns[names.index(name)]]
    return tuple(kind(**dict(zip(names, row, strict=True))) for row in zip(*columns, strict=True))
