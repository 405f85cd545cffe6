"""Results as the flat content of a result file: path -> array, text or number, as the record describes them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from mbla import __version__
from mbla.arrays import FloatArray, IntArray, starts
from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import ContactReport, Contacts
from mbla.deck.sections.selectors import POSITIONS
from mbla.errors import Message, Notice
from mbla.model.model import Joint, LoadCase, Model, Pushing
from mbla.model.solids.blocks import Blocks
from mbla.model.ties.ties import Ties
from mbla.program.reductions import ProgramSize
from mbla.questions.force import Objective
from mbla.questions.reaction import Settlement
from mbla.questions.tilt import Tilt
from mbla.questions.travel import TravelPosition
from mbla.results.assessment import Figure
from mbla.results.collapse.collapse import collapse_of
from mbla.results.hdf5.layout import FILETYPE, VERSION, Content, fields_of
from mbla.results.record.columns import names_of, numbers_of
from mbla.results.record.quantity import ANSWERS, stored
from mbla.results.results import CaseResult, Results
from mbla.solution.further.further import Further
from mbla.solution.further.geometric_safety.geometric_safety import GeometricSafety
from mbla.solution.further.sensitivity.slopes import Slope
from mbla.solution.pushover.pushed import CurveRow
from mbla.solution.pushover.pushover import Pushover
from mbla.solution.pushover.record import PushedRows
from mbla.solution.solution import (
    Checks,
    IterationRecord,
    Mechanics,
    ModelSize,
    PathByStiffness,
    PathPoint,
    ProgramRecord,
    ReductionStep,
    Solution,
    StandingResult,
)
from mbla.solution.verification.verify import residual_of

RECORD_NAMES = {
    "travel/points": "travel/load_points",
    "travel/blocks": "travel/carrying_blocks",
    "tilt/axis": "tilt/turning_axis",
    "pushover/direction": "pushover/control_direction",
    "objective/direction": "objective/measured_along",
    "objective/end": "objective/which_end",
}
"""fields of a load case that have other names in the file: netCDF takes a dataset of the name of a dimension for the
coordinate of that"""
HISTORY: dict[str, type] = {
    "programs": ProgramRecord,
    "iterations": IterationRecord,
    "path": PathPoint,
    "path_by_stiffness": PathByStiffness,
}
"""lists of records in a solution, each a group with a dataset a column"""
MOTIONS = ("torsion_motions", "crushing_motions")
"""motions of interfaces, in the order in which they are stacked"""


def root_attributes(results: Results) -> dict[str, str | int]:
    """Attributes of the root group."""
    return {
        "filetype": FILETYPE,
        "version": VERSION,
        "mbla_version": results.provenance.get("mbla", __version__),
        "created": results.created,
        "deck_sha256": results.deck.sha256,
        "complete": int(results.complete),
    }


def content_of(results: Results) -> Content:
    """Everything in the results by its path in the file."""
    content: Content = {
        "deck/name": results.deck.name,
        "deck/source_names": [name for name, _ in results.deck.sources],
        "deck/source_texts": [text for _, text in results.deck.sources],
        **_side_files(results.deck.files),
        "deck/overrides": results.deck.overrides,
        **_model(results.model),
        **_contacts(results.contacts),
        **_notices("notices", results.notices),
        **_mapping("provenance/names", "provenance/values", results.provenance),
        **_mapping("provenance/setting_names", "provenance/setting_values", results.settings),
        "provenance/stage_names": list(results.time),
        "provenance/stage_seconds": list(results.time.values()),
        "provenance/files": results.files,
        "provenance/exit_code": results.exit_code,
    }
    if not results.complete:
        content["provenance/not_done"] = results.not_done
    for load_case in results.model.load_cases:
        content |= _below(f"cases/{load_case.name}", _loads(load_case))
    for case in results.cases:
        content |= _below(f"cases/{case.load_case.name}", case_content(results.assembly, case))
    return content


def unverified_kinds(results: Results) -> tuple[str, ...]:
    """Kinds of statements in the results that the run alone can make, so that they cannot be verified."""
    content = content_of(results)
    placed = fields_of([case.name for case in results.model.load_cases])
    kinds = (
        each.unproved(content[path]) for path, each in placed if path in content and np.size(np.asarray(content[path]))
    )
    return tuple(dict.fromkeys(kind for kind in kinds if kind))


def _below(place: str, content: Content) -> Content:
    return {f"{place}/{name}": value for name, value in content.items()}


def _held(owner: object, kind: type, place: str) -> Content:
    """Fields of a dataclass under the names of the record, those that are there."""
    values = {name: getattr(owner, name) for name in stored(kind, place)}
    return {name: value for name, value in values.items() if value is not None}


# --- what was analysed --------------------------------------------------------------------------------------------


def _side_files(files: Sequence[tuple[str, bytes]]) -> Content:
    contents = [np.frombuffer(content, dtype=np.uint8) for _, content in files]
    return {
        "deck/file_names": [name for name, _ in files],
        "deck/file_start": starts(np.array([len(content) for content in contents], dtype=np.int64)),
        "deck/file_bytes": np.concatenate([np.zeros(0, dtype=np.uint8), *contents]),
    }


def _ragged(rows: Iterable[IntArray]) -> tuple[IntArray, IntArray]:
    """Offsets and flat items of a list of index arrays."""
    listed = [np.asarray(row, dtype=np.int64) for row in rows]
    flat = np.concatenate([np.zeros(0, dtype=np.int64), *listed])
    return starts(np.array([len(row) for row in listed], dtype=np.int64)), flat


def _mapping(names: str, values: str, mapping: Mapping[str, str]) -> Content:
    return {names: list(mapping), values: [str(value) for value in mapping.values()]}


def _notices(group: str, notices: Sequence[Notice]) -> Content:
    return {f"{group}/{name}": [getattr(notice, name) for notice in notices] for name in stored(Notice, "notices")}


def _model(model: Model) -> Content:
    blocks, units, labels = model.blocks, model.units, model.blocks.labels
    start, flat = _ragged(np.zeros(0, dtype=np.int64) if g.blocks is None else g.blocks for g in model.grounds)
    content: Content = {
        **_held(blocks, Blocks, "model"),
        "title": model.title,
        "units": [units.length, units.force, units.mass],
        "load_cases": [case.name for case in model.load_cases],
        "group_names": names_of(blocks.groups),
        "groups": numbers_of(blocks.groups),
        "member_names": names_of(labels.members),
        "members": numbers_of(labels.members),
        "position_names": list(POSITIONS),
        "positions": labels.positions,
        "weights": model.weights,
        "fixed": model.fixed,
        "joint_names": list(model.joints),
        **{name: [getattr(law, name) for law in model.joints.values()] for name in stored(Joint, "model")},
        "ground_labels": [ground.label for ground in model.grounds],
        "ground_points": _points([ground.point for ground in model.grounds]),
        "ground_normals": _points([ground.normal for ground in model.grounds]),
        "ground_joints": [ground.joint for ground in model.grounds],
        "ground_selective": [ground.blocks is not None for ground in model.grounds],
        "ground_start": start,
        "ground_blocks": flat,
    }
    if any(ground.outline is not None for ground in model.grounds):
        outlines = [np.zeros((0, 3)) if ground.outline is None else ground.outline for ground in model.grounds]
        ends = starts(np.array([len(outline) for outline in outlines], dtype=np.int64))
        content |= {"ground_outline_start": ends, "ground_outlines": np.concatenate(outlines)}
    guides = model.guides
    if len(guides):
        content |= {"guided_blocks": guides.blocks, "guided_bodies": guides.bodies}
        content |= {"guide_motions": guides.motions, "guide_words": guides.words}
    if model.fill is not None:
        fill = model.fill
        content |= {"fill_masses": fill.masses, "fill_points": fill.points, "fill_words": fill.words}
    if len(model.ties):
        content |= {f"tie_{name}": getattr(model.ties, name) for name in Ties.__dataclass_fields__}
    return _below("model", content) | _notices("model/notices", model.notices)


def _points(rows: Sequence[FloatArray]) -> FloatArray:
    return np.array(rows, dtype=float).reshape(-1, 3)


def _contacts(contacts: Contacts) -> Content:
    report = contacts.report
    start, flat = _ragged(report.unsupported)
    return {
        **_below("contacts", _held(contacts, Contacts, "contacts")),
        **_below("contacts/report", _held(report, ContactReport, "contacts/report")),
        "contacts/report/unsupported_start": start,
        "contacts/report/unsupported_blocks": flat,
        **_notices("contacts/notices", report.notices),
    }


PARTS_OF_LOADS: dict[str, Any] = {
    "travel": TravelPosition,
    "tilt": Tilt,
    "settlement": Settlement,
    "objective": Objective,
    "pushover": Pushing,
}
"""What a load case may have besides its loads, by the name of its field and group."""


def _loads(load_case: LoadCase) -> Content:
    content = _held(load_case, LoadCase, "cases/*")
    content |= {"dead_words": load_case.dead_words, "live_words": load_case.live_words}
    for name, kind in PARTS_OF_LOADS.items():
        part = getattr(load_case, name)
        if part is not None:
            content |= _below(name, {field: getattr(part, field) for field in kind.__dataclass_fields__})
    if load_case.assessment is not None:
        content["assessment/asked"] = load_case.assessment.model_dump_json(exclude_none=True)
    return {RECORD_NAMES.get(path, path): value for path, value in content.items()}


# --- what was found for a load case -------------------------------------------------------------------------------


def case_content(assembly: Assembly, case: CaseResult) -> Content:
    """Everything of one load case but its loads, by the path below it."""
    solution, checks = case.solution, case.checks
    content: Content = {
        **_held(solution, Solution, "cases/*"),
        "status": case.status.value,
        "claimed_status": solution.status.value,
        **_held(checks, Checks, "cases/*"),
        **_messages("remarks", solution.remarks),
        **_messages("failures", checks.failures),
    }
    for group, kind in HISTORY.items():
        content |= _columns(group, kind, getattr(solution, group))
    if case.assessment is not None:
        content |= _columns("assessment", Figure, case.assessment.figures)
    question = case.load_case.question
    if question.group == "reaction" and solution.mechanics is not None:
        content["reaction"] = question.value(solution.mechanics.load_factor)
    for part, (group, _) in ANSWERS.items():
        mechanics: Mechanics | None = getattr(solution, part)
        if mechanics is not None and not (part == "associative" and associative_is_own(case)):
            residual = residual_of(assembly, case.load_case, solution, part)
            own = _answer(mechanics) | {"residual": residual}
            content |= {f"{group}/{name}".lstrip("/"): value for name, value in own.items()}
    return content | _collapse(assembly, case) | _of_solution(solution) | _further(solution.further)


def _further(further: Further) -> Content:
    """What was asked besides, as far as it was found."""
    content: Content = {}
    pushover, safety = further.pushover, further.geometric_safety
    if pushover.rows is not None:
        content |= _held(pushover, Pushover, "cases/*") | _columns("curve", CurveRow, pushover.curve)
        content |= _below("pushed", _pushed(pushover.rows))
    if further.sensitivity:
        content |= _columns("sensitivity", Slope, further.sensitivity)
    if safety is not None:
        content |= _below("geometric_safety", _held(safety, GeometricSafety, "cases/*/geometric_safety"))
    return content


def _pushed(rows: PushedRows) -> Content:
    """Poses, contact points, forces and history of a pushover."""
    points = rows.points
    return {
        "shift": rows.shifts,
        "rotation": rows.turns,
        "fallen": rows.fallen,
        "stiffness": rows.stiffness,
        "point_start": rows.point_start,
        "bodies": points.bodies,
        "host": points.host,
        "arms": points.arms,
        "frames": points.frames,
        "law": points.laws,
        "areas": points.areas,
        "at_zero": points.history,
        "contact_forces": points.forces,
    }


def _messages(group: str, messages: Sequence[Message]) -> Content:
    identifiers = [message.identifier for message in messages]
    return {f"{group}/identifier": identifiers, f"{group}/message": [message.words for message in messages]}


def _columns(group: str, kind: type, records: Sequence[object]) -> Content:
    """A list of records, a dataset a column."""
    names = stored(kind, f"cases/*/{group}")
    return {f"{group}/{name}": [getattr(record, name) for record in records] for name in names}


def _answer(mechanics: Mechanics) -> Content:
    """Forces and velocities of an answer."""
    content = _held(mechanics, Mechanics, "cases/*")
    return content | _motions("", mechanics.interface_motions)


def _motions(prefix: str, motions: FloatArray | None) -> Content:
    return {} if motions is None else {f"{prefix}{name}": motions[:, row] for row, name in enumerate(MOTIONS)}


def _collapse(assembly: Assembly, case: CaseResult) -> Content:
    """What follows from the mechanism, for readers of the file."""
    mechanics = case.solution.mechanics
    if mechanics is None:
        return {}
    collapse = collapse_of(assembly, case.load_case, mechanics)
    motion = collapse.interfaces
    return {
        "parts": collapse.parts,
        "interfaces/modes": motion.modes,
        "interfaces/translations": motion.translation,
        "interfaces/rotations": motion.rotation,
        "interfaces/hinge_points": motion.hinge_points,
        "interfaces/hinge_directions": motion.hinge_directions,
        "interfaces/work": collapse.work.dissipated,
    }


def associative_is_own(case: CaseResult) -> bool:
    """The associative answer is the case's own answer, so that the file need not hold it twice."""
    solution = case.solution
    return solution.flow_rule == "associative" and solution.associative is solution.mechanics


def _of_solution(solution: Solution) -> Content:
    """What a solution has in groups of its own."""
    content = _motions("certificate_", solution.certificate_motions)
    if solution.level_lock is not None:
        content["level/lock"] = solution.level_lock
    if solution.reductions:
        content |= _columns("reductions", ReductionStep, solution.reductions)
        for when in ("before", "after"):
            for name in ProgramSize.__dataclass_fields__:
                sizes = [getattr(getattr(step, when), name) for step in solution.reductions]
                content[f"reductions/{name}_{when}"] = sizes
    if solution.size is not None:
        content |= _below("size", _held(solution.size, ModelSize, "cases/*/size"))
    standing = solution.standing
    if standing is not None:
        content |= _below("standing", _held(standing, StandingResult, "cases/*/standing"))
        content["standing/falls"] = [] if standing.block is None else [standing.block]
        if standing.forces is not None:
            content["standing/contact_forces"] = standing.forces
    return content
