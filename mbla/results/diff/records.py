"""A comparison as the object that ``mbla diff --json`` prints."""

from __future__ import annotations

import math
from typing import Any

from mbla.results.diff.cases import CaseComparison, Figure
from mbla.results.diff.comparison import Comparison
from mbla.results.diff.motion import ModeComparison
from mbla.results.record.json_record import notice_json
from mbla.results.record.json_values import number, numbers


def comparison_json(comparison: Comparison, names: tuple[str, str]) -> dict[str, Any]:
    """Everything that was compared; pairs are of A and of B, figures in the units of A."""
    model = comparison.model
    return {
        "files": list(names),
        "decks": list(comparison.names),
        "created": list(comparison.created),
        "differing": comparison.differing,
        "deck_diff": list(comparison.deck),
        "overrides": [list(overrides) for overrides in comparison.overrides],
        "settings": {name: [old, new] for name, old, new in comparison.settings},
        "provenance": {name: [old, new] for name, old, new in comparison.provenance},
        "model": {
            "totals": [_figure(figure) for figure in model.totals],
            "units": list(model.units),
            "matched_by": model.by,
            "matched_shares": numbers(model.shares),
            "comparable": model.comparable,
            "moved": list(model.moved),
            "changed": list(model.changed),
            "only": [list(names) for names in model.only],
            "fixed_in_one": list(model.supports),
            "joints": list(model.joints),
        },
        "cases": [_case(case) for case in comparison.cases],
        "only": [list(names) for names in comparison.only],
        "warnings_gone": [notice_json(notice) for notice in comparison.gone],
        "warnings_new": [notice_json(notice) for notice in comparison.new],
    }


def _figure(figure: Figure) -> dict[str, Any]:
    return {
        "name": figure.name,
        "unit": figure.unit or None,
        "values": numbers([figure.first, figure.second]),
        "difference": number(figure.difference),
        "tolerance": number(figure.tolerance),
        "same": figure.same,
    }


def _case(case: CaseComparison) -> dict[str, Any]:
    return {
        "name": case.name,
        "differs": case.differs,
        "status": [status.value for status in case.statuses],
        "flow_rule": list(case.rules),
        "answers": [_figure(figure) for figure in case.answers],
        "figures": [_figure(figure) for figure in case.figures],
        "mechanism": {
            "angle": number(case.angle),
            "cosine": None if case.angle is None else math.cos(math.radians(case.angle)),
            "compared": case.angle_of,
        },
        "modes": None if case.modes is None else _modes(case.modes),
        "reactions": [{"support": change.support, "change": numbers(change.change)} for change in case.reactions],
        "load": number(case.load),
        "time": numbers(case.seconds),
    }


def _modes(modes: ModeComparison) -> dict[str, Any]:
    return {
        "contact_points": [
            {"modes": [first, second], "count": count} for (first, second), count in modes.points.items()
        ],
        "compared": {"contact_points": modes.compared[0], "interfaces": modes.compared[1]},
        "only": list(modes.only),
        "interfaces": [
            {"bodies": change.bodies, "centroid": numbers(change.centroid), "modes": list(change.modes)}
            for change in modes.interfaces
        ],
    }
