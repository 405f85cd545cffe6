"""Every file for ParaView of a run, each only where it has a cell, and the script that shows them.

A mesh file without a single cell is refused by its readers.
"""

from __future__ import annotations

import pprint
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mbla.results.files import OutputFolder
from mbla.results.listing.verdict_words import verdict
from mbla.results.pictures.camera import axes_of, view_of_case
from mbla.results.record.columns import names_of
from mbla.results.record.scene import Scene, scene_of
from mbla.results.results import Results
from mbla.results.vtu.loads import has_loads, has_supports, write_loads_vtu, write_supports_vtu
from mbla.results.vtu.vtu import (
    collection_pvd,
    frame_times,
    has_hinges,
    has_thrust,
    write_blocks_vtu,
    write_contacts_vtu,
    write_frame_vtu,
    write_hinges_vtu,
    write_interfaces_vtu,
    write_thrust_vtu,
)


def _has_contacts(scene: Scene) -> bool:
    return len(scene.contacts) > 0


@dataclass(frozen=True)
class MeshFile:
    """A kind of file, ``STEM_CASE_kind.vtu``; ``exists`` says whether a scene has it."""

    kind: str
    exists: Callable[[Scene], bool]
    write: Callable[[Path, Scene], None]


MESH_FILES = (
    MeshFile("blocks", lambda _: True, write_blocks_vtu),
    MeshFile("contacts", _has_contacts, write_contacts_vtu),
    MeshFile("interfaces", _has_contacts, write_interfaces_vtu),
    MeshFile("thrust", has_thrust, write_thrust_vtu),
    MeshFile("hinges", has_hinges, write_hinges_vtu),
    MeshFile("loads", has_loads, write_loads_vtu),
)


def write_mesh_files(results: Results, out: OutputFolder, frames: int) -> None:
    """The files of every load case, the animations, ``STEM_supports.vtu``, and the script that shows them."""
    supports = _write_supports(results, out)
    records = {}
    for case in results.cases:
        scene = scene_of(results, case)
        stem = f"{out.stem}_{case.load_case.name}"
        files = _write_scene(scene, stem, out)
        _write_animation(scene, stem, out, frames)
        if scene.moves:
            files["animation"] = f"{stem}.pvd"
        records[case.load_case.name] = case_record(results, scene, files)
    out.write_text(f"{out.stem}_paraview.py", views_script(results, out.stem, supports, records))


def write_model_vtu(results: Results, out: OutputFolder) -> None:
    """``STEM_blocks.vtu``, ``STEM_contacts.vtu``, ``STEM_interfaces.vtu``, ``STEM_supports.vtu``, without a case."""
    _write_supports(results, out)
    _write_scene(Scene(results.model, results.contacts, None), out.stem, out)


def _write_supports(results: Results, out: OutputFolder) -> str:
    """Name of the file of supports; empty if there is none."""
    if not has_supports(results.model, results.contacts):
        return ""
    name = f"{out.stem}_supports.vtu"
    with out.writing(name) as path:
        write_supports_vtu(path, results.model, results.contacts)
    return name


def _write_scene(scene: Scene, stem: str, out: OutputFolder) -> dict[str, str]:
    """Names of the files by kind."""
    names = {file.kind: f"{stem}_{file.kind}.vtu" for file in MESH_FILES if file.exists(scene)}
    for file in MESH_FILES:
        if file.kind in names:
            with out.writing(names[file.kind]) as path:
                file.write(path, scene)
    return names


def _write_animation(scene: Scene, stem: str, out: OutputFolder, frames: int) -> None:
    times = frame_times(frames) if scene.moves else [0.0]
    names = [f"{stem}_frame_{i:03d}.vtu" for i in range(len(times))]
    for name, moment in zip(names, times, strict=True):
        with out.writing(name) as path:
            write_frame_vtu(path, scene, moment)
    out.write_text(f"{stem}.pvd", collection_pvd(names, times))


TEMPLATE = Path(__file__).with_name("standard_views.py")
PLACE = "RESULT: dict[str, Any] = {}\n"
"""line of the template that this result replaces"""


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

    Raises ValueError for a scene without a load case.
    """
    if scene.case is None:
        raise ValueError("standard views are those of a load case")
    return {
        "files": dict(files),
        "words": _words(results, scene),
        "parts": int(scene.parts.max(initial=0)),
        "slides": scene.interfaces is not None and bool(scene.interfaces.slides.any()),
        "thrust_lines": len(scene.lines),
        "look_from": axes_of(*view_of_case(scene))[0].tolist(),
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
