"""Every file for ParaView of a run, each only where it has a cell, and the script that shows them.

A mesh file without a single cell is refused by its readers.
"""

from __future__ import annotations

import pprint
from collections.abc import Callable, Mapping
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, evenly
from mbla.results.collapse.motion import end_motion, pushed_motions
from mbla.results.files import OutputFolder
from mbla.results.listing.verdict_words import verdict
from mbla.results.pictures.camera import axes_of, view_of_case
from mbla.results.quantities.blocks import names_of
from mbla.results.record.scene import Scene, scene_of
from mbla.results.results import Results
from mbla.results.vtu.history import HistoryStates
from mbla.results.vtu.loads import loads_mesh, supports_mesh
from mbla.results.vtu.meshes import (
    Mesh,
    blocks_mesh,
    contacts_mesh,
    frame_mesh,
    hinges_mesh,
    interfaces_mesh,
    modes_after_mesh,
    modes_mesh,
    thrust_mesh,
)
from mbla.results.vtu.ties import ties_mesh

MOST_STEPS = 101
"""of a pushover, or states in time, that have files, evenly chosen"""
MESHES: dict[str, Callable[[Scene], Mesh | None]] = {
    "blocks": blocks_mesh,
    "contacts": contacts_mesh,
    "interfaces": interfaces_mesh,
    "thrust": thrust_mesh,
    "hinges": hinges_mesh,
    "loads": loads_mesh,
    "ties": ties_mesh,
    "modes": modes_mesh,
    "modes_after": modes_after_mesh,
}
"""by what the name of the file ends in, ``STEM_CASE_kind.vtu``; None where a scene has none"""


def write_mesh_files(results: Results, out: OutputFolder, frames: int) -> None:
    """The files of every load case, the animations, ``STEM_supports.vtu``, and the script that shows them."""
    supports = _write_supports(results, out)
    records = {}
    for case in results.cases:
        scene = scene_of(results, case)
        stem = f"{out.stem}_{case.load_case.name}"
        files = _write_scene(scene, stem, out)
        if _write_animation(scene, stem, out, frames):
            files["pushed"] = f"{stem}_pushed.pvd"
        if _write_history(scene, f"{stem}_history", out):
            files["history"] = f"{stem}_history.pvd"
        if scene.moves:
            files["animation"] = f"{stem}.pvd"
        records[case.load_case.name] = case_record(results, scene, files)
    out.write_text(f"{out.stem}_paraview.py", views_script(results, out.stem, supports, records))


def write_model_vtu(results: Results, out: OutputFolder) -> None:
    """``STEM_blocks.vtu``, ``STEM_contacts.vtu``, ``STEM_interfaces.vtu``, ``STEM_supports.vtu``, without a case."""
    _write_supports(results, out)
    _write_scene(Scene(results.assembly, None), out.stem, out)


def _write(mesh: Mesh | None, name: str, out: OutputFolder) -> str:
    """Name of the file; empty where there is no mesh."""
    if mesh is None:
        return ""
    with out.writing(name) as path:
        mesh.write(path)
    return name


def _write_supports(results: Results, out: OutputFolder) -> str:
    return _write(supports_mesh(results.model, results.contacts), f"{out.stem}_supports.vtu", out)


def _write_scene(scene: Scene, stem: str, out: OutputFolder) -> dict[str, str]:
    """Names of the files by kind."""
    names = {kind: _write(mesh_of(scene), f"{stem}_{kind}.vtu", out) for kind, mesh_of in MESHES.items()}
    return {kind: name for kind, name in names.items() if name}


def _write_animation(scene: Scene, stem: str, out: OutputFolder, frames: int) -> bool:
    """The mechanism as drawn, and the steps of a pushover where they are; whether there are such."""
    times = np.linspace(0.0, 1.0, frames).tolist() if scene.moves else [0.0]
    _write_frames(scene, f"{stem}_frame", stem, {time: time * scene.motion for time in times}, out)
    pushed = [] if scene.case is None else pushed_motions(scene.case)
    if pushed:
        steps = evenly(len(pushed), MOST_STEPS)
        name = f"{stem}_pushed"
        _write_frames(scene, name, name, {float(step): pushed[step] for step in steps}, out)
    return bool(pushed)


def _write_history(scene: Scene, stem: str, out: OutputFolder) -> bool:
    """States of a structure in time and where it ends, and its contact forces at states; whether there are such."""
    history = None if scene.case is None else scene.case.solution.further.time_history
    if history is None or (found := history.frames) is None:
        return False
    kinds: dict[str, Callable[[HistoryStates, int], Mesh | None]]
    kinds = {stem: HistoryStates.blocks, f"{stem}_forces": HistoryStates.forces}
    states, shown = HistoryStates.of(scene, found), evenly(len(found), MOST_STEPS)
    for name, mesh_of in kinds.items():
        files = {f"{name}_{i:03d}.vtu": state for i, state in enumerate(shown)}
        written = {
            file: float(found.times[state])
            for file, state in files.items()
            if _write(mesh_of(states, state), file, out)
        }
        if name == stem and (end := end_motion(history)) is not None:
            file = f"{name}_{len(shown):03d}.vtu"
            _write(states.end(end[1]), file, out)
            written[file] = end[0]
        out.write_text(f"{name}.pvd", collection_pvd(written))
    return True


def _write_frames(
    scene: Scene, name: str, collection: str, motions: Mapping[float, FloatArray], out: OutputFolder
) -> None:
    """A file for each motion, (n_blocks, 6) by its time, and the collection that plays them."""
    files = {f"{name}_{i:03d}.vtu": time for i, time in enumerate(motions)}
    for file, motion in zip(files, motions.values(), strict=True):
        _write(frame_mesh(scene, motion), file, out)
    out.write_text(f"{collection}.pvd", collection_pvd(files))


def collection_pvd(files: Mapping[str, float]) -> str:
    """The text of a PVD file that plays frames, names with their times."""
    lines = [
        f'    <DataSet timestep="{time:.6g}" group="" part="0" file="{escape(file)}"/>' for file, time in files.items()
    ]
    return (
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n  <Collection>\n'
        + "".join(f"{line}\n" for line in lines)
        + "  </Collection>\n</VTKFile>\n"
    )


TEMPLATE = Path(__file__).with_name("standard_views.py")
PLACE = "RESULT: dict[str, Any] = {}\n"
"""line of the template that this result replaces"""


def views_script(results: Results, stem: str, supports: str, cases: Mapping[str, Mapping[str, Any]]) -> str:
    """Text of the script.

    supports : name of the file of supports, empty for none
    cases    : what ``case_record`` gives for each load case
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
        lines.append("Forces and motion are NO RESULT: those of the best iterate.")
    return lines
