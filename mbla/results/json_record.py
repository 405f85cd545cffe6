"""The object that ``--json`` prints: keys and nesting as scripts rely on them; no number but finite ones."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mbla import __version__
from mbla.errors import Notice
from mbla.model.model import Model
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import ContactMode, Status

DIMENSION = 3
"""of the models that this version solves; planar models would say 2"""


def results_json(results: Results) -> dict[str, Any]:
    """The record of a run; values that do not exist are None."""
    return {
        "mbla": results.provenance.get("mbla", __version__),
        "deck": results.deck.name,
        "deck_sha256": results.deck.sha256,
        "created": results.created,
        "exit_code": results.exit_code,
        "model": {"standing": standing(results.cases)} | model_json(results.model) | contacts_json(results),
        "cases": [_case(case) for case in results.cases],
        "settings": results.settings,
        "notices": [notice_json(notice) for notice in results.notices],
        "time": {stage: number(seconds) for stage, seconds in results.time.items()},
        "files": list(results.files),
    }


def check_json(results: Results, needs: Mapping[str, Mapping[str, int]]) -> dict[str, Any]:
    """The record of a check: no cases; ``needs`` says by load case what reaches the solver."""
    report = results.contacts.report
    record = results_json(results)
    for key in ("cases", "files"):
        del record[key]
    record["model"] |= {
        "load_cases": [case.name for case in results.model.load_cases],
        "joints": {
            name: {"interfaces": results.contacts.count_by_joint[name], "area": number(area)}
            for name, area in results.contacts.area_by_joint.items()
        },
        "slivers": len(report.slivers),
        "near_misses": len(report.near_misses),
        "overlaps": len(report.overlaps),
        "isolated_blocks": [results.model.blocks.name(int(b)) for b in report.isolated],
        "unsupported_parts": len(report.unsupported),
    }
    return record | {"needs": {case: dict(counts) for case, counts in needs.items()}}


def verification_json(results: Results, disagreements: Sequence[str]) -> dict[str, Any]:
    """The record of a verification: figures recomputed, and where the file says otherwise."""
    return results_json(results) | {"agrees": not disagreements, "disagreements": list(disagreements)}


def json_line(record: dict[str, Any]) -> str:
    """One line of JSON, without newline; ValueError if a number in it is not finite."""
    return json.dumps(record, ensure_ascii=False, allow_nan=False, separators=(", ", ": "))


def number(value: float | None) -> float | None:
    """A finite number or None."""
    return None if value is None or not math.isfinite(value) else float(value)


def notice_json(notice: Notice) -> dict[str, str]:
    """A notice with its keys."""
    return {"severity": notice.severity, "identifier": notice.identifier, "message": notice.message}


def standing(cases: Sequence[CaseResult]) -> str | None:
    """Whether the dead load of every case is carried by some state of equilibrium: ``yes``, ``no``, or None if unknown.

    A load factor by the associative rule is claimed only after the dead load alone was found to be carried.
    """
    if any(case.status is Status.NO_EQUILIBRIUM for case in cases):
        return "no"
    carried = [case.solution.associative is not None or case.status is Status.UNBOUNDED for case in cases]
    return "yes" if carried and all(carried) else None


def model_json(model: Model) -> dict[str, Any]:
    """Counts and totals."""
    units = model.units
    low, high = model.blocks.vertices.min(axis=0), model.blocks.vertices.max(axis=0)
    return {
        "title": model.title,
        "blocks": len(model.blocks),
        "free_blocks": len(model.free),
        "dimension": DIMENSION,
        "extents": [[number(value) for value in corner] for corner in (low, high)],
        "total_volume": number(model.blocks.volumes.sum()),
        "total_weight": number(model.total_weight),
        "units": {"length": units.length, "force": units.force, "mass": units.mass},
    }


def contacts_json(results: Results) -> dict[str, Any]:
    """Counts of interfaces and contact points."""
    contacts = results.contacts
    return {
        "interfaces": len(contacts),
        "contact_points": len(contacts.points),
        "contact_area": number(contacts.areas.sum()),
    }


def _case(case: CaseResult) -> dict[str, Any]:
    solution, checks = case.solution, case.checks
    mechanics, associative = solution.mechanics, solution.associative
    solver = float(sum(program.seconds for program in solution.programs))
    return {
        "name": case.load_case.name,
        "status": case.status.value,
        "reason": solution.reason or None,
        "flow_rule": solution.flow_rule,
        "load_factor": None if mechanics is None else number(mechanics.load_factor),
        "static_bound": number(checks.static_bound),
        "kinematic_bound": number(checks.kinematic_bound),
        "gap": number(checks.gap),
        "associative_load_factor": None if associative is None else number(associative.load_factor),
        "equilibrium_residual": number(checks.equilibrium_residual),
        "yield_violation": number(checks.yield_violation),
        "penetration": number(checks.penetration),
        "complementarity_residual": number(checks.complementarity_residual),
        "live_power": number(checks.live_power),
        "power_balance": number(checks.power_balance),
        "verified": checks.verified,
        "failures": list(checks.failures),
        "programs": len(solution.programs),
        "iterations": sum(program.iterations for program in solution.programs),
        "mechanism": None if mechanics is None else _mode_counts(mechanics.modes),
        "time": {"total": number(solution.seconds), "solver": number(solver)},
    }


def _mode_counts(modes: np.typing.NDArray[np.int64]) -> dict[str, int]:
    """Contact points by mode."""
    return {
        mode.name.lower(): int(np.sum(modes == mode))
        for mode in (ContactMode.OPEN, ContactMode.SLIDE, ContactMode.STICK)
    }
