"""The assembly of a deck on soil whose corners are moved to where it slips, for its load cases together.

Moving ends in one of many meshes that are about as good, none of them the best: the mesh is made and moved at two
sizes, the better one is taken, and the figures of both say how far the figure hangs on the mesh.

Of the positions of a travelling load the mesh follows the worst one alone. Which one that is, larger cells tell that
are moved for each position.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly import Assembly, build_assembly
from mbla.deck import Deck
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.model import LoadCase, Model
from mbla.model.soil.plane_mesh import areas_of
from mbla.model.soil.soil_figure import SoilFigure
from mbla.model.soil.soil_mesh import SoilCorners
from mbla.questions.force import Force
from mbla.questions.travel import Travel
from mbla.soil_mesh.cells_of_model import cells_of, corners_of, with_loaded_held
from mbla.soil_mesh.moving import MovedMesh, MovingSettings, gain_of, move_corners
from mbla.soil_mesh.planar_program import find_mechanism, with_unit_live_load
from mbla.soil_mesh.scene_of_assembly import Cells, SoilScene, scene_of_assembly

LARGER = 1.5
"""size of larger cells, over that which the deck asks for"""

OF_EACH = MovingSettings(steps=12, eased_steps=6)
"""how cells are moved for each position of a travelling load"""


@dataclass(frozen=True)
class _Mesh:
    """A mesh, over the size of cells that the deck asks for."""

    assembly: Assembly
    cells: Cells
    size: float

    def figure(self, load_factor: float, *, followed: bool, shown: bool) -> SoilFigure:
        """A load factor on it."""
        return SoilFigure(self.size, len(self.cells.triangles), load_factor, followed, shown)


def with_moved_soil(deck: Deck, assembly: Assembly, load_cases: Sequence[LoadCase]) -> Assembly:
    """The assembly on moved corners, from that on the mesh as it is divided, for these load cases.

    Load cases have the figures of their planar scenes on meshes of each size. Where none of them has a scene in which
    the live load does work, the assembly stays as it is.
    """
    names = [case.name for case in load_cases]
    first = _mesh(assembly, 1.0)
    larger = None if first is None else _with_corners(deck, _at_size(assembly.model, LARGER), LARGER)
    if first is None or larger is None:
        return assembly
    each = _moved_for_each(larger, [case.name for case in load_cases if isinstance(case.question, Travel)])
    own = {name: moved.load_factor for name, moved in each.items()}
    followed = _to_follow(load_cases, own)
    areas = areas_of(larger.cells.triangles, larger.cells.points)
    if len(followed) == 1 and followed[0] in each:
        larger = _on(deck, larger, each[followed[0]].points) or larger
    meshes = [_moved(deck, first, followed, None), _moved(deck, larger, followed, areas)]
    moved = [mesh for mesh in meshes if mesh is not None]
    if not moved:
        return assembly
    factors = [_load_factors(mesh, names) for mesh in moved]
    best = _better([[each.get(name, np.inf) for name in followed] for each in factors])
    found: dict[str, tuple[SoilFigure, ...]] = {}
    for name in factors[best]:
        rows = range(len(moved)) if name in followed else [best]
        figures = [
            moved[row].figure(factors[row][name], followed=name in followed, shown=row == best)
            for row in rows
            if name in factors[row]
        ]
        if name in own and name not in followed:
            figures.append(larger.figure(own[name], followed=True, shown=False))
        found[name] = tuple(figures)
    shown = moved[best].assembly
    return shown.with_load_cases(tuple(replace(case, soil=found.get(case.name, ())) for case in shown.model.load_cases))


def _mesh(assembly: Assembly, size: float) -> _Mesh | None:
    """The mesh of an assembly; None where the planes of its soils differ."""
    cells = cells_of(assembly.model)
    return None if cells is None else _Mesh(assembly, cells, size)


def _with_corners(deck: Deck, corners: dict[str, SoilCorners], size: float) -> _Mesh | None:
    """The mesh of a deck with other corners of cells; None where these make no valid structure."""
    try:
        return _mesh(build_assembly(deck, build_model(deck, corners)), size)
    except DeckError:  # the deck itself is valid
        return None


def _at_size(model: Model, size: float) -> dict[str, SoilCorners]:
    """Corners of cells of another size, over that which the deck asks for."""
    return {soil.name: SoilCorners(size * soil.size, None, moved=False) for soil in model.soils}


def _to_follow(load_cases: Sequence[LoadCase], own: dict[str, float]) -> list[str]:
    """Names of the load cases that the mesh follows: of the positions of a travelling load the worst one."""
    travelling: dict[str, list[str]] = {}
    for case in load_cases:
        travelling.setdefault(case.deck_name if case.name in own else case.name, []).append(case.name)
    return [min(names, key=lambda name: own.get(name, np.inf)) for names in travelling.values()]


def _on(deck: Deck, mesh: _Mesh, points: FloatArray) -> _Mesh | None:
    """The mesh with other corners, (n_points, 2), of its cells; None where these make no valid structure."""
    return _with_corners(deck, corners_of(mesh.assembly.model, mesh.cells, points), mesh.size)


def _moved_for_each(mesh: _Mesh, names: Sequence[str]) -> dict[str, MovedMesh]:
    """Meshes that are moved for each load case alone, by their names."""
    found: dict[str, MovedMesh] = {}
    cases = {case.name: case for case in mesh.assembly.model.load_cases}
    for name in names:
        cells = with_loaded_held(mesh.cells, mesh.assembly.model, [cases[name]])
        scene = scene_of_assembly(mesh.assembly, cases[name], cells)
        if scene is not None:
            found[name] = move_corners([scene.scene], scene.points, scene.motions, OF_EACH)
    return found


def _moved(deck: Deck, mesh: _Mesh, names: Sequence[str], areas: FloatArray | None) -> _Mesh | None:
    """The mesh moved for load cases; None where none of these has a scene in which something moves.

    areas : (n_cells,) in the first mesh; None: it is this one
    """
    model = mesh.assembly.model
    cells = with_loaded_held(mesh.cells, model, [case for case in model.load_cases if case.name in names])
    chosen = list(_scenes(mesh, names, cells).values())
    if not chosen:
        return None
    moved = move_corners([each.scene for each in chosen], chosen[0].points, chosen[0].motions, first=areas)
    return _on(deck, mesh, moved.points) if moved.mechanisms else None


def _scenes(mesh: _Mesh, names: Sequence[str], cells: Cells) -> dict[str, SoilScene]:
    """Planar scenes of load cases by their names, those of one set of edges, in which the live load does work; none of
    forces that are sought, which have no live load of their own.
    """
    cases = {case.name: case for case in mesh.assembly.model.load_cases}
    found: dict[str, SoilScene] = {}
    for name in names:
        scene = (
            None if isinstance(cases[name].question, Force) else scene_of_assembly(mesh.assembly, cases[name], cells)
        )
        if scene is None or not scene.scene.loaded:
            continue
        first = next(iter(found.values()), scene)
        if scene.points.shape == first.points.shape and scene.motions.shape == first.motions.shape:
            found[name] = scene
    return found


def _load_factors(mesh: _Mesh, names: Sequence[str]) -> dict[str, float]:
    """Load factors of planar scenes by name of the load case; inf where nothing moves."""
    found = {}
    for name, each in _scenes(mesh, names, mesh.cells).items():
        scene, unit = with_unit_live_load(each.scene, each.points)
        mechanism = find_mechanism(scene, each.points)
        found[name] = np.inf if mechanism is None else mechanism.load_factor / unit
    return found


def _better(factors: Sequence[Sequence[float]]) -> int:
    """The mesh with the lower load factors, of several load cases the lower ones in the mean of their ratios."""
    if len(factors) < 2:
        return 0
    first, second = np.array(factors)
    if np.isneginf(second).any() or np.isneginf(first).any():
        return int(not np.isneginf(first).any())
    known = np.isfinite(first) & np.isfinite(second)
    if not known.any():
        return int(np.isfinite(second).any())
    return int(gain_of(first[known], second[known]) > 0.0)
