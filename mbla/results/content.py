"""Results as the flat content of a result file, and back: path -> array, text or number (see ``layout``)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

import numpy as np

from mbla import __version__
from mbla.arrays import FloatArray, IntArray, starts
from mbla.contacts.contacts import Contacts
from mbla.errors import Notice
from mbla.model.model import LoadCase, Model
from mbla.results.layout import FILETYPE, VERSION
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Mechanics

Value: TypeAlias = "np.typing.NDArray[np.generic] | str | Sequence[str] | float | int | bool"
Content: TypeAlias = dict[str, Value]

CHECKED = (
    "equilibrium_residual",
    "yield_violation",
    "penetration",
    "complementarity_residual",
    "live_power",
    "power_balance",
    "static_bound",
    "kinematic_bound",
    "gap",
)
"""numbers of Checks"""
BLOCK_ARRAYS = (
    "vertices",
    "vertex_start",
    "loops",
    "loop_start",
    "face_start",
    "facet_of_face",
    "face_normals",
    "convex",
    "volumes",
    "centroids",
    "densities",
    "group_indices",
)
CONTACT_ARRAYS = (
    "bodies",
    "normals",
    "areas",
    "centroids",
    "gaps",
    "joints",
    "point_start",
    "outline",
    "points",
    "frames",
    "point_areas",
)
REPORT_FIELDS = (
    "slivers",
    "sliver_widths",
    "near_misses",
    "near_miss_gaps",
    "overlaps",
    "overlap_depths",
    "unchecked",
    "isolated",
    "fixed_contacts",
)
MECHANICS_FIELDS = ("load_factor", "contact_forces", "contact_velocities", "mechanism", "modes")
PROGRAM_FIELDS = ("program", "kind", "status", "load_factor", "change", "iterations", "seconds")
ITERATION_FIELDS = (
    "program",
    "iteration",
    "load_factor",
    "gap",
    "primal_residual",
    "dual_residual",
    "step",
    "seconds",
)


def root_attributes(results: Results) -> dict[str, str | int]:
    """Attributes of the root group."""
    return {
        "filetype": FILETYPE,
        "version": VERSION,
        "mbla_version": results.provenance.get("mbla", __version__),
        "created": results.created,
        "deck_sha256": results.deck.sha256,
        "complete": 1,
    }


def content_of(results: Results) -> Content:
    """Everything in the results by its path in the file."""
    content: Content = {
        "deck/name": results.deck.name,
        "deck/source_names": [name for name, _ in results.deck.sources],
        "deck/source_texts": [text for _, text in results.deck.sources],
        "deck/overrides": results.deck.overrides,
        **_model(results.model),
        **_contacts(results.contacts),
        **_notices("notices", results.notices),
        **_mapping("provenance/names", "provenance/values", results.provenance),
        **_mapping("provenance/setting_names", "provenance/setting_values", results.settings),
        "provenance/stage_names": list(results.time),
        "provenance/stage_seconds": np.array(list(results.time.values()), dtype=float),
        "provenance/files": results.files,
        "provenance/exit_code": results.exit_code,
    }
    for load_case in results.model.load_cases:
        content |= {f"cases/{load_case.name}/{key}": value for key, value in _loads(load_case).items()}
    for case in results.cases:
        content |= {f"cases/{case.load_case.name}/{key}": value for key, value in _case(case).items()}
    return content


def ragged(rows: Iterable[IntArray]) -> tuple[IntArray, IntArray]:
    """Offsets and flat items of a list of index arrays."""
    listed = [np.asarray(row, dtype=np.int64) for row in rows]
    flat = np.concatenate(listed) if listed else np.zeros(0, dtype=np.int64)
    return starts(np.array([len(row) for row in listed], dtype=np.int64)), flat


def _mapping(names: str, values: str, mapping: Mapping[str, str]) -> Content:
    return {names: list(mapping), values: [str(value) for value in mapping.values()]}


def _notices(group: str, notices: Sequence[Notice]) -> Content:
    return {
        f"{group}/severity": [notice.severity for notice in notices],
        f"{group}/identifier": [notice.identifier for notice in notices],
        f"{group}/message": [notice.message for notice in notices],
    }


def _model(model: Model) -> Content:
    blocks, units = model.blocks, model.units
    group_names = sorted(set(blocks.groups))
    row = {name: i for i, name in enumerate(group_names)}
    content: Content = {f"model/{name}": getattr(blocks, name) for name in BLOCK_ARRAYS}
    content |= {
        "model/title": model.title,
        "model/units": [units.length, units.force, units.mass],
        "model/load_cases": [case.name for case in model.load_cases],
        "model/group_names": group_names,
        "model/groups": np.array([row[group] for group in blocks.groups], dtype=np.int64),
        "model/weights": blocks.masses * units.standard_gravity * units.force_per_mass_acceleration,
        "model/fixed": model.fixed,
        **_joints(model),
        **_grounds(model),
        **_notices("model/notices", model.notices),
    }
    return content


def _joints(model: Model) -> Content:
    laws = model.joints.values()
    fields = ("friction", "cohesion", "tensile_strength", "compressive_strength", "dilatancy")
    numbers: Content = {
        f"model/{field}": np.array([getattr(law, field) for law in laws], dtype=float) for field in fields
    }
    return {"model/joint_names": list(model.joints), **numbers}


def _grounds(model: Model) -> Content:
    grounds = model.grounds
    start, flat = ragged(np.zeros(0, dtype=np.int64) if g.blocks is None else g.blocks for g in grounds)
    return {
        "model/ground_labels": [ground.label for ground in grounds],
        "model/ground_points": _points([ground.point for ground in grounds]),
        "model/ground_normals": _points([ground.normal for ground in grounds]),
        "model/ground_joints": [ground.joint for ground in grounds],
        "model/ground_selective": np.array([ground.blocks is not None for ground in grounds], dtype=bool),
        "model/ground_start": start,
        "model/ground_blocks": flat,
    }


def _points(rows: Sequence[FloatArray]) -> FloatArray:
    return np.array(rows, dtype=float).reshape(-1, 3)


def _contacts(contacts: Contacts) -> Content:
    report = contacts.report
    start, flat = ragged(report.unsupported)
    return {
        **{f"contacts/{name}": getattr(contacts, name) for name in CONTACT_ARRAYS},
        "contacts/joint_names": contacts.joint_names,
        **{f"contacts/report/{name}": getattr(report, name) for name in REPORT_FIELDS},
        "contacts/report/unsupported_start": start,
        "contacts/report/unsupported_blocks": flat,
        **_notices("contacts/notices", report.notices),
    }


def _loads(load_case: LoadCase) -> Content:
    return {name: getattr(load_case, name) for name in ("dead_load", "live_load", "dead_words", "live_words")}


def _case(case: CaseResult) -> Content:
    solution, checks = case.solution, case.checks
    content: Content = {
        "status": case.status.value,
        "claimed_status": solution.status.value,
        "flow_rule": solution.flow_rule,
        "reason": solution.reason,
        "seconds": solution.seconds,
        **{name: getattr(checks, name) for name in CHECKED},
        "verified": checks.verified,
        "failures": checks.failures,
        **_table("programs", PROGRAM_FIELDS, solution.programs),
        **_table("iterations", ITERATION_FIELDS, solution.iterations),
    }
    if solution.mechanics is not None:
        content |= _mechanics("", solution.mechanics)
    if solution.associative is not None and not associative_is_own(solution.flow_rule, case):
        content |= _mechanics("associative/", solution.associative)
    if solution.certificate is not None:
        content["certificate"] = solution.certificate
    return content


def associative_is_own(flow_rule: str, case: CaseResult) -> bool:
    """The associative answer is the case's own answer, so that the file need not hold it twice."""
    return flow_rule == "associative" and case.solution.associative is case.solution.mechanics


def _mechanics(prefix: str, mechanics: Mechanics) -> Content:
    return {prefix + name: getattr(mechanics, name) for name in MECHANICS_FIELDS}


def _table(group: str, fields: Sequence[str], records: Sequence[object]) -> Content:
    """Columns of a list of records; text columns as lists, the others as arrays."""
    columns: Content = {}
    for field in fields:
        column = [getattr(record, field) for record in records]
        columns[f"{group}/{field}"] = (
            [str(value) for value in column] if field in ("kind", "status") else np.array(column)
        )
    return columns
