"""Every file for ParaView of a run: which there are, and that each is written only where it has a cell.

A mesh file without a single cell is refused by its readers.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from mbla.results.files import OutputFolder
from mbla.results.record.scene import Scene, scene_of
from mbla.results.results import Results
from mbla.results.vtu.lines import has_hinges, has_thrust, write_hinges_vtu, write_thrust_vtu
from mbla.results.vtu.loads import has_loads, write_loads_vtu
from mbla.results.vtu.script import case_record, views_script
from mbla.results.vtu.supports import has_supports, write_supports_vtu
from mbla.results.vtu.vtu import (
    collection_pvd,
    frame_times,
    write_blocks_vtu,
    write_contacts_vtu,
    write_frame_vtu,
    write_interfaces_vtu,
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
