"""The object that ``--json`` prints: keys and nesting as scripts rely on them; no number but finite ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mbla import __version__
from mbla.contacts.glue import solid_sizes
from mbla.errors import Notice
from mbla.model.model import Model
from mbla.results.hdf5.content import as_told
from mbla.results.outcome import dimension_of, notices_of, standing_of, unproved_words
from mbla.results.provenance import CaseNeeds
from mbla.results.record.case_json import case_json, series_json
from mbla.results.record.json_values import as_json, number, numbers
from mbla.results.record.scene import scene_of
from mbla.results.results import Results
from mbla.results.series import series_of


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
    for key in ("cases", "series", "files", "complete", "not_done"):
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
    return record | {"needs": {case: _needs(own) for case, own in needs.items()}}


def _needs(needs: CaseNeeds) -> dict[str, Any]:
    return dict(needs.counts) | {"reductions": as_json(needs.reductions)}


def verification_json(results: Results, disagreements: Sequence[str]) -> dict[str, Any]:
    """The record of a verification: figures recomputed, where the file says otherwise, and what was not verified."""
    return results_json(results) | {
        "agrees": not disagreements,
        "disagreements": list(disagreements),
        "not_verified": [*as_told(results), *unproved_words(results.cases)],
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
