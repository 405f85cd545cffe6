"""``STEM_paraview.py``: the standard views as a script for ParaView, with what this result is written into it."""

from __future__ import annotations

import pprint
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from mbla.model.model import Model
from mbla.results.listing.verdict_words import verdict
from mbla.results.pictures.geometry import front_axis
from mbla.results.record.blocks import names_of
from mbla.results.record.scene import Scene
from mbla.results.results import Results

TEMPLATE = Path(__file__).with_name("standard_views.py")
PLACE = "RESULT: dict[str, Any] = {}\n"
"""line of the template that this result replaces"""
LOOK_FROM = {0: [1.0, 0.0, 0.0], 1: [0.0, -1.0, 0.0], None: [0.9, -1.6, 0.85]}
"""where to look from, by the axis along which to look"""


def views_script(results: Results, stem: str, supports: str, cases: Mapping[str, Mapping[str, Any]]) -> str:
    """Text of the script.

    supports : name of the file of supports, empty for none
    cases    : what ``case_record`` says of each load case
    """
    vertices = results.model.blocks.vertices
    record = {
        "stem": stem,
        "size": float(np.linalg.norm(np.ptp(vertices, axis=0))),
        "groups": names_of(results.model.blocks.groups),
        "supports": supports,
        "cases": dict(cases),
    }
    template = TEMPLATE.read_text(encoding="utf-8")
    head, rest = template.split(PLACE)
    return f"{head}RESULT: dict[str, Any] = {pprint.pformat(record, width=110, sort_dicts=False)}\n{rest}"


def case_record(results: Results, scene: Scene, files: Mapping[str, str]) -> dict[str, Any]:
    """What the script must know of a load case.

    files : names of its files by kind; ``animation`` where it moves
    """
    if scene.case is None:
        raise ValueError("standard views are those of a load case")
    moved = np.vstack([scene.model.blocks.vertices, scene.model.blocks.vertices + scene.displacements])
    return {
        "low": moved.min(axis=0).tolist(),
        "high": moved.max(axis=0).tolist(),
        "files": dict(files),
        "words": _words(results, scene),
        "parts": int(scene.parts.max(initial=0)),
        "slides": scene.interfaces is not None and bool(scene.interfaces.slides.any()),
        "thrust_lines": len(scene.lines),
        "look_from": look_from(scene.model, scene),
    }


def _words(results: Results, scene: Scene) -> list[str]:
    """Title, outcome, and what forces and motion are where they are no result."""
    case = scene.case
    if case is None:
        return []
    lines = [results.model.title or results.deck.name, f"load case {case.load_case.name}: {verdict(scene.model, case)}"]
    if scene.mechanics is None and case.solution.lock is not None:
        lines.append("Forces: those that balance the live load alone.")
    elif scene.mechanics is None and case.solution.certificate is not None:
        lines.append("Motion: one under which the dead load does work that no joint resists.")
    elif scene.mechanics is not None and scene.figures != "result":
        lines.append("Forces and motion are NO RESULT: the best that was reached.")
    return lines


def look_from(model: Model, scene: Scene) -> list[float]:
    """Direction towards the viewer: along the thin axis of what is thin and moves across it, else slanted."""
    travel = np.abs(scene.displacements).max(axis=0, initial=0.0)
    return LOOK_FROM[front_axis(np.ptp(model.blocks.vertices, axis=0), travel)]
