"""A run as one JSON object: what ``--json`` prints and ``STEM.json`` holds; its load cases below it.

Values that do not exist are None, numbers are finite.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mbla import __version__
from mbla.arrays import FloatArray
from mbla.contacts.glue import solid_sizes
from mbla.errors import Notice
from mbla.model.model import Model
from mbla.questions.force import Force
from mbla.results.collapse.mechanics import reactions_of
from mbla.results.collapse.ties import tie_rows
from mbla.results.findings import remarks_of_run
from mbla.results.force_range import ForceRange, end_value, force_ranges_of
from mbla.results.hdf5.content import unverified_kinds
from mbla.results.listing.answers import reaction_json
from mbla.results.listing.figures import solver_json
from mbla.results.listing.history_words import NOT_CHECKED, NOT_FOLLOWED, history_words, pushovers_words
from mbla.results.outcome import (
    RESIDUALS,
    answer_bounds,
    associative_of,
    best_iterate,
    dimension_of,
    notices_of,
    result_of,
    standing_of,
    unproved_words,
)
from mbla.results.provenance import CaseNeeds
from mbla.results.record.columns import CASE_COLUMNS, Column
from mbla.results.record.json_values import as_json, number, numbers
from mbla.results.record.mechanism_json import mechanism_json
from mbla.results.record.scene import Scene, scene_of
from mbla.results.results import CaseResult, Results
from mbla.results.series import Series, factor_of, position_of, series_of
from mbla.solution.solution import Checks, Mechanics, Solution
from mbla.solution.verification.statics import power


def results_json(results: Results) -> dict[str, Any]:
    """The record of a run; values that do not exist are None, those of mechanisms are found when they are asked for."""
    return {
        "mbla": results.provenance.get("mbla", __version__),
        "deck": results.deck.name,
        "deck_sha256": results.deck.sha256,
        "created": results.created,
        "exit_code": results.exit_code,
        "model": {"standing": standing_of(results.cases), "dimension": dimension_of(results.cases)}
        | model_json(results.model)
        | contacts_json(results),
        "cases": [case_json(scene_of(results, case)) for case in results.cases],
        "series": [series_json(results.model, series) for series in series_of(results.cases)],
        "objectives": [force_range_json(found) for found in force_ranges_of(results.cases)],
        "settings": results.settings,
        "notices": [notice_json(notice) for notice in notices_of(results)],
        "time": {stage: number(seconds) for stage, seconds in results.time.items()},
        "files": list(results.files),
        "complete": results.complete,
        "not_done": list(results.not_done),
    }


def check_json(results: Results, needs: Mapping[str, CaseNeeds]) -> dict[str, Any]:
    """The record of a check: no cases; ``needs`` says by load case what reaches the solver."""
    report = results.contacts.report
    record = results_json(results)
    for key in ("cases", "series", "objectives", "files", "complete", "not_done"):
        del record[key]
    record["model"] |= {
        "load_cases": [case.name for case in results.model.load_cases],
        "joints": {
            name: {"interfaces": count, "area": number(area)}
            for name, (count, area) in results.contacts.by_joint.items()
        },
        "slivers": len(report.slivers),
        "near_misses": len(report.near_misses),
        "overlaps": len(report.overlaps),
        "isolated_blocks": [results.model.blocks.name(int(b)) for b in report.isolated],
        "unsupported_parts": len(report.unsupported),
    }
    return record | {"needs": {case: _needs(own) for case, own in needs.items()}}


def _needs(needs: CaseNeeds) -> dict[str, Any]:
    return dict(needs.counts) | {"reductions": as_json(needs.reductions)}


def verification_json(results: Results, disagreements: Sequence[str]) -> dict[str, Any]:
    """The record of a verification: figures recomputed, where the file says otherwise, and what was not verified."""
    return results_json(results) | {
        "agrees": not disagreements and not results.unconfirmed,
        "disagreements": list(disagreements),
        "not_confirmed": list(results.unconfirmed),
        "paths_again": as_json(results.paths_again),
        "pushovers_again": as_json(results.pushovers_again),
        "not_verified": [
            *unverified_kinds(results),
            *((NOT_CHECKED,) if NOT_CHECKED in history_words(results) else ()),
            *((NOT_FOLLOWED,) if NOT_FOLLOWED in pushovers_words(results) else ()),
            *unproved_words(results.cases),
            *remarks_of_run(results.cases),
        ],
    }


def notice_json(notice: Notice) -> dict[str, str]:
    """A notice with its keys; ``case`` only where it is about one load case."""
    record = {"severity": notice.severity, "identifier": notice.identifier, "message": notice.message}
    return record | ({"case": notice.case} if notice.case else {})


def model_json(model: Model) -> dict[str, Any]:
    """Counts and totals."""
    units = model.units
    low, high = model.blocks.vertices.min(axis=0), model.blocks.vertices.max(axis=0)
    return {
        "title": model.title,
        "blocks": len(model.blocks),
        "free_blocks": len(model.free),
        "extents": [numbers(corner) for corner in (low, high)],
        "total_volume": number(model.blocks.volumes.sum()),
        "total_weight": number(model.total_weight),
        "added_mass": number(float(model.blocks.added_masses.sum())),
        "fill_mass": number(0.0 if model.fill is None else float(model.fill.masses.sum())),
        "units": {"length": units.length, "force": units.force, "mass": units.mass},
    }


def contacts_json(results: Results) -> dict[str, Any]:
    """Counts of interfaces and contact points, and of what open and glued joints take out of them."""
    contacts = results.contacts
    sizes = solid_sizes(contacts.solid_of_block)
    return {
        "open_interfaces": contacts.report.open_interfaces,
        "glued_interfaces": len(contacts.report.glued),
        "glued_blocks": int(sizes.sum()),
        "rigid_bodies": len(sizes),
        "held_blocks": len(contacts.report.held),
        "interfaces": len(contacts),
        "contact_points": len(contacts.points),
        "contact_area": number(contacts.areas.sum()),
    }


def case_json(scene: Scene) -> dict[str, Any]:
    """Everything that is reported of a case; ``load_factor`` and ``mechanism`` only where they are results."""
    case = scene.case
    assert case is not None  # the record of a model alone has no cases
    solution, mechanics, model = case.solution, result_of(case), scene.model
    solver = float(sum(program.seconds for program in solution.programs))
    return {
        "name": case.load_case.name,
        **{each.quantity.name: _value(each, scene) for each in CASE_COLUMNS if "json" in each.files},
        "reaction": reaction_json(case),
        "best_iterate": _best_iterate(case),
        "powers": powers_json(model, case),
        "residuals": residuals_json(case.checks),
        "standing": _standing(model, solution),
        "certificate": _certificate(solution),
        "solver": solver_json(solution),
        "size": as_json(solution.size),
        "reductions": as_json(solution.reductions),
        "path": as_json(solution.path),
        "path_by_stiffness": as_json(solution.path_by_stiffness),
        "curve": as_json(solution.further.pushover.curve),
        "curve_stiffness": None
        if solution.further.pushover.rows is None
        else as_json(solution.further.pushover.rows.stiffness),
        "curve_end": solution.further.pushover.curve_end,
        "curve_end_error": as_json(solution.further.pushover.curve_end_error),
        "curve_last_error": as_json(solution.further.pushover.curve_last_error),
        "sensitivity": as_json(solution.further.sensitivity),
        "geometric_safety": _geometric_safety(solution),
        "assessment": as_json(case.assessment),
        "mechanism": None
        if mechanics is None
        else mechanism_json(scene.assembly, case.load_case, mechanics, dimension_of((case,))),
        "reactions": None if mechanics is None else _reactions(scene, case, mechanics),
        "ties": as_json(tie_rows(model, mechanics)),
        "time": {"total": number(solution.seconds), "solver": number(solver)},
    }


def _value(column: Column, scene: Scene) -> Any:
    """Value of a column for the case, as in JSON."""
    values, quantity = column.of(scene), column.quantity
    if quantity.dims == ("sentence",):
        return [] if values is None else [str(sentence) for sentence in values]
    if values is None:
        return None
    if quantity.dims:
        return numbers(values[0])
    if quantity.kind == "text":
        return str(values[0]) or None
    return number(values[0]) if quantity.kind == "float" else values[0].item()


def residuals_json(checks: Checks) -> dict[str, float | None]:
    """The residuals of forces and mechanism in one object."""
    return {name.split("_")[0]: number(getattr(checks, name)) for name in RESIDUALS if name != "power_balance"}


def _best_iterate(case: CaseResult) -> dict[str, Any] | None:
    best = best_iterate(case)
    if best is None:
        return None
    return {"load_factor": number(best.load_factor), "residuals": residuals_json(case.checks)}


def _standing(model: Model, solution: Solution) -> dict[str, str | None] | None:
    standing = solution.standing
    if standing is None:
        return None
    block = None if standing.block is None else model.blocks.name(standing.block)
    return {"verdict": standing.verdict.value, "block": block, "reason": standing.reason or None}


def _geometric_safety(solution: Solution) -> dict[str, Any] | None:
    found = solution.further.geometric_safety
    if found is None:
        return None
    factors = {"factor": number(found.factor), "most": number(found.most)}
    return factors | {"solves": found.solves, "verified": bool(found.verified)}


def _certificate(solution: Solution) -> str | None:
    """What proves that there is no load factor: a motion, or forces that balance the live load alone."""
    if solution.certificate is not None:
        return "motion"
    return "forces" if solution.lock is not None and solution.mechanics is None else None


def powers_json(model: Model, case: CaseResult) -> dict[str, float | None] | None:
    """Power of the live load of every load case in the mechanism behind a kinematic bound, by name.

    A mechanism u that the joints allow with associative flow bounds every live load at once. With the dead load G, the
    dissipation D and live loads L_c of the same structure, no factors x_c acting together are carried unless

        Σ x_c L_c·u ≤ D(u) − G·u.

    u is scaled so that the live load of its own case has unit power; the right side then is its kinematic bound k, and
    Σ x_c p_c ≤ k a half-space that contains the safe domain. Positions of travelling loads and settlements have none;
    None where there is no such mechanism.
    """
    associative = associative_of(case)
    if associative is None or not case.load_case.question.multiplies:
        return None
    own = power(case.load_case.live_load, associative.mechanism)
    if not own > 0.0:
        return None
    others = [one for one in model.load_cases if one.question.name == "load_factor"]
    return {one.name: number(power(one.live_load, associative.mechanism) / own) for one in others}


def _reactions(scene: Scene, case: CaseResult, mechanics: Mechanics) -> dict[str, Any]:
    """Resultants on the structure, moments about the origin: of all supports, and by ground plane and group.

    Guides are among them: what they take is a support too.
    """
    found = reactions_of(scene.model, scene.contacts, case.load_case, mechanics, by_group=True)
    total = np.sum([reaction.wrench for reaction in found], axis=0) if found else np.zeros(6)
    return {
        "total": _wrench_json(total),
        "supports": {reaction.support: _wrench_json(reaction.wrench) for reaction in found},
    }


def _wrench_json(wrench: FloatArray) -> dict[str, Any]:
    wrench = wrench + 0.0  # no -0.0
    return {"force": numbers(wrench[:3]), "moment": numbers(wrench[3:])}


def series_json(model: Model, series: Series) -> dict[str, Any]:
    """Load factor and status at every position, null where there is none; the worst, null where it is not known."""
    return {
        "name": series.name,
        "complete": series.complete,
        "positions": [_position(model, case) for case in series.cases],
        "worst": None if series.worst is None else _position(model, series.worst),
    }


def force_range_json(found: ForceRange) -> dict[str, Any]:
    """Least and greatest value of a force; a value is null where there is none, and where forces have no limit."""
    ends: dict[str, Any] = {"least": None, "greatest": None} | {end: _end(case) for end, case in found.ends.items()}
    question = next(iter(found.ends.values())).load_case.question
    assert isinstance(question, Force)  # what makes it one
    return {"name": found.name, "at": number(question.objective.at), "status": found.status.value, **ends}


def _end(case: CaseResult) -> dict[str, Any]:
    low, high = answer_bounds(case)
    return {
        "case": case.load_case.name,
        "status": case.status.value,
        "value": number(end_value(case)),
        "lower_bound": number(low),
        "upper_bound": number(high),
    }


def _block(model: Model, block: int) -> str | None:
    return model.blocks.name(int(block)) if block >= 0 else None


def _position(model: Model, case: CaseResult) -> dict[str, Any]:
    position = position_of(case)
    return {
        "case": case.load_case.name,
        "position": position.number,
        "point": numbers(position.point),
        "distance": number(position.distance),
        "block": _block(model, position.blocks[0]),
        "axles": [
            {"point": numbers(point), "distance": number(distance), "block": _block(model, block)}
            for point, distance, block in zip(position.points, position.distances, position.blocks, strict=True)
        ],
        "status": case.status.value,
        "load_factor": number(factor_of(case)),
    }
