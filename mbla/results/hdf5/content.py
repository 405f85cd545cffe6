"""Results as the flat content of a result file, and back: path -> array, text or number (see ``layout``)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields

import numpy as np

from mbla import __version__
from mbla.arrays import FloatArray, IntArray, starts
from mbla.contacts.contacts import Contacts
from mbla.deck.selectors import POSITIONS
from mbla.errors import Notice
from mbla.model.model import LoadCase, Model
from mbla.model.solids.blocks import BlockLabels
from mbla.results.hdf5.case_content import Content, case_content
from mbla.results.hdf5.layout import FILETYPE, VERSION, fields_of
from mbla.results.hdf5.load_fields import RECORD_NAMES
from mbla.results.results import Results

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
    "added_masses",
    "added_mass_points",
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
SETTLEMENT_FIELDS = ("blocks", "motions", "turns", "words", "reference", "unit")
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
    "open_interfaces",
    "glued",
    "held",
)


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
        "provenance/stage_seconds": np.array(list(results.time.values()), dtype=float),
        "provenance/files": results.files,
        "provenance/exit_code": results.exit_code,
        **({} if results.complete else {"provenance/not_done": results.not_done}),
    }
    for load_case in results.model.load_cases:
        content |= {f"cases/{load_case.name}/{key}": value for key, value in _loads(load_case).items()}
    for case in results.cases:
        found = case_content(results.model, results.contacts, case)
        content |= {f"cases/{case.load_case.name}/{key}": value for key, value in found.items()}
    return content


def as_told(results: Results) -> tuple[str, ...]:
    """Kinds of statements in the results that the run alone can tell, so that nobody can verify them."""
    content = content_of(results)
    cases = [case.name for case in results.model.load_cases]
    placed = fields_of(cases)
    held = ((field, content[path]) for path, field in placed if path in content)
    kinds = (field.told_of(value) for field, value in held if np.size(np.asarray(value)))
    return tuple(dict.fromkeys(kind for kind in kinds if kind))


def _side_files(files: Sequence[tuple[str, bytes]]) -> Content:
    contents = [np.frombuffer(content, dtype=np.uint8) for _, content in files]
    return {
        "deck/file_names": [name for name, _ in files],
        "deck/file_start": starts(np.array([len(content) for content in contents], dtype=np.int64)),
        "deck/file_bytes": np.concatenate([np.zeros(0, dtype=np.uint8), *contents]),
    }


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


def _labels(labels: BlockLabels) -> Content:
    names = sorted(set(labels.members))
    row = {name: i for i, name in enumerate(names)}
    return {
        "model/member_names": names,
        "model/members": np.array([row[member] for member in labels.members], dtype=np.int64),
        "model/position_names": list(POSITIONS),
        "model/positions": labels.positions,
    }


def _model(model: Model) -> Content:
    blocks, units = model.blocks, model.units
    group_names = sorted(set(blocks.groups))
    row = {name: i for i, name in enumerate(group_names)}
    content: Content = {f"model/{name}": getattr(blocks, name) for name in BLOCK_ARRAYS}
    content |= {
        "model/title": model.title,
        **_labels(blocks.labels),
        "model/units": [units.length, units.force, units.mass],
        "model/load_cases": [case.name for case in model.load_cases],
        "model/group_names": group_names,
        "model/groups": np.array([row[group] for group in blocks.groups], dtype=np.int64),
        "model/weights": blocks.masses * units.standard_gravity * units.force_per_mass_acceleration,
        "model/fixed": model.fixed,
        **_joints(model),
        **_grounds(model),
        **_guides(model),
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
    report, label = contacts.report, contacts.solid_of_block
    start, flat = ragged(report.unsupported)
    return {
        **{f"contacts/{name}": getattr(contacts, name) for name in CONTACT_ARRAYS},
        "contacts/joint_names": contacts.joint_names,
        **({} if label is None else {"contacts/solid_of_block": label}),
        **{f"contacts/report/{name}": getattr(report, name) for name in REPORT_FIELDS},
        "contacts/report/unsupported_start": start,
        "contacts/report/unsupported_blocks": flat,
        **_notices("contacts/notices", report.notices),
    }


def _guides(model: Model) -> Content:
    """Blocks that move in given ways only; nothing where there are none."""
    guides = model.guides
    if not len(guides):
        return {}
    return {
        "model/guided_blocks": guides.blocks,
        "model/guided_bodies": guides.bodies,
        "model/guide_motions": guides.motions,
        "model/guide_words": guides.words,
    }


def _loads(load_case: LoadCase) -> Content:
    content: Content = {
        name: getattr(load_case, name) for name in ("dead_load", "live_load", "dead_words", "live_words")
    }
    for name in ("travel", "tilt"):
        part = getattr(load_case, name)
        if part is not None:
            content |= {f"{name}/{field.name}": getattr(part, field.name) for field in fields(part)}
    for path, of_record in RECORD_NAMES.items():
        if of_record in content:
            content[path] = content.pop(of_record)
    settlement = load_case.settlement
    if settlement is not None:
        content |= {f"settlement/{name}": getattr(settlement, name) for name in SETTLEMENT_FIELDS}
    return content
