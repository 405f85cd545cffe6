"""A load case's results from the content of a result file: the way back from ``case_content``."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, get_args

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.analysis import AnalysisSection, ReductionSwitches
from mbla.model.model import LoadCase
from mbla.program.reductions import ProgramSize, ReductionStep, StepState
from mbla.results.hdf5.case_content import (
    CHECKED,
    ITERATION_FIELDS,
    MECHANICS_FIELDS,
    PATH_FIELDS,
    PROGRAM_FIELDS,
    SIZE_FIELDS,
    SOLVER_FIELDS,
    STEP_ENDS,
    STEP_SIZES,
)
from mbla.results.hdf5.mechanism_fields import MECHANICS_GROUPS
from mbla.results.listing.solver_words import METHODS
from mbla.results.results import CaseResult
from mbla.solution.solution import (
    Checks,
    ContactMode,
    IterationRecord,
    Mechanics,
    ModelSize,
    PathPoint,
    ProgramRecord,
    Solution,
    Standing,
    StandingResult,
    Status,
)

Record = TypeVar("Record", ProgramRecord, IterationRecord, PathPoint)


def case_from(load_case: LoadCase, get: dict[str, Any]) -> CaseResult:
    """The results of a load case from the content below it; ValueError where it contradicts itself."""
    answers = {part: _mechanics(get, group, part) for group, part, _ in MECHANICS_GROUPS}
    if answers["associative"] is None and get["flow_rule"] == "associative":
        answers["associative"] = answers["mechanics"]
    if answers["outer"] is not None and answers["associative"] is None:
        raise ValueError("a circumscribed polyhedron without an inscribed one")
    lower, upper = get["range"].tolist()
    for name in ("flow_rule", "contact_model"):
        if get[name] not in get_args(AnalysisSection.model_fields[name].annotation):
            raise ValueError(f"{name} of a load case")
    solution = Solution(
        flow_rule=get["flow_rule"],
        status=Status(get["claimed_status"]),
        mechanics=answers["mechanics"],
        associative=answers["associative"],
        lower=answers["lower"],
        upper=answers["upper"],
        peak=answers["peak"],
        outer=answers["outer"],
        level=answers["level"],
        level_lock=get.get("level/lock"),
        certificate=get.get("certificate"),
        reason=get["reason"],
        programs=_records(ProgramRecord, (*PROGRAM_FIELDS, *SOLVER_FIELDS), get, "programs/"),
        iterations=_records(IterationRecord, ITERATION_FIELDS, get, "iterations/"),
        seconds=get["seconds"],
        scheme=get["scheme"],
        contact_model=get["contact_model"],
        stress_blocks=bool(get["stress_blocks"]),
        certificate_motions=_motions(get, "certificate_"),
        remarks=tuple(get["remarks"]),
        spread=_spread(get),
        standing=_standing(get),
        lock=get.get("lock"),
        force_ranges=get.get("force_ranges"),
        path=_records(PathPoint, PATH_FIELDS, get, "path/"),
        size=_size(get),
        reductions=_reductions(get),
        sides=get["sides"],
        solver=_solver(get),
        asked=get.get("asked"),
    )
    checks = Checks(
        **{name: get[name] for name in CHECKED},
        lower=lower,
        upper=upper,
        verified=get["verified"],
        failures=tuple(get["failures"]),
    )
    return CaseResult(load_case, solution, checks, Status(get["status"]))


def _mechanics(get: dict[str, Any], group: str, part: str) -> Mechanics | None:
    if f"{group}load_factor" not in get:
        if f"{group}resultants" in get:
            raise ValueError(f"resultants without forces: {part}")
        return None
    if not np.isin(get[f"{group}modes"], [int(mode) for mode in ContactMode]).all():
        raise ValueError("contact modes")
    values = {name: get[group + name] for name in MECHANICS_FIELDS}
    return Mechanics(**values, resultants=get.get(f"{group}resultants"), interface_motions=_motions(get, group))


def _motions(get: dict[str, Any], group: str) -> FloatArray | None:
    """Motions of interfaces by torsion and by crushing."""
    if f"{group}torsion_motions" not in get:
        return None
    return np.stack([get[f"{group}torsion_motions"], get[f"{group}crushing_motions"]], axis=1)


def _spread(get: dict[str, Any]) -> tuple[float, float] | None:
    if "spread" not in get:
        return None
    least, greatest = get["spread"].tolist()
    return least, greatest


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
    size = ModelSize(**{name: get[f"size/{name}"] for name in SIZE_FIELDS})
    if size.dimension not in (2, 3):
        raise ValueError("dimension of the model")
    return size


def _reductions(get: dict[str, Any]) -> tuple[ReductionStep, ...]:
    """Files of runs that looked for none have no such table."""
    if "reductions/name" not in get:
        return ()
    columns = {when: [get[f"reductions/{name}_{when}"] for name in STEP_SIZES] for when in STEP_ENDS}
    sizes = {when: [ProgramSize(*row) for row in np.column_stack(of).tolist()] for when, of in columns.items()}
    found = get["reductions/name"], get["reductions/state"], get["reductions/found"].tolist()
    if not set(found[0]) <= {"glued", *ReductionSwitches.model_fields}:
        raise ValueError("name of a reduction")
    rows = zip(*found, sizes["before"], sizes["after"], strict=True)
    return tuple(ReductionStep(name, StepState(state), *row) for name, state, *row in rows)


def _solver(get: dict[str, Any]) -> str:
    """The solver asked for, once all names of solvers are known ones."""
    asked: str = get["solver"]
    if not {asked, *get["programs/solver"]} <= {"", "auto", *METHODS}:
        raise ValueError("name of a solver")
    return asked


def _records(
    kind: Callable[..., Record], names: tuple[str, ...], get: dict[str, Any], group: str
) -> tuple[Record, ...]:
    found = [get[group + name] for name in names]
    columns = [column if isinstance(column, list) else column.tolist() for column in found]
    if "status" in names:
        columns[names.index("status")] = [Status(value) for value in columns[names.index("status")]]
    return tuple(kind(*row) for row in zip(*columns, strict=True))
