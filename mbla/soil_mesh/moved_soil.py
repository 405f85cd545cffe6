"""The assembly of a deck on soil whose corners are moved to where it slips, for its load cases together.

Moving ends in one of many meshes that are about as good, none of them the best: the mesh is made and moved at two
sizes, the better one is taken, and the figures of both say how far the figure hangs on the mesh.

Of the positions of a travelling load the mesh follows the one with the least load factor, and where another one has it
on the moved mesh, that one, too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.assembly import Assembly, build_assembly
from mbla.deck import Deck
from mbla.model import build_model
from mbla.model.model import LoadCase, Model
from mbla.model.soil.soil_figure import SoilFigure
from mbla.model.soil.soil_mesh import SoilCorners
from mbla.questions.travel import Travel
from mbla.soil_mesh.cells_of_model import cells_of, corners_of
from mbla.soil_mesh.moving import gain_of, move_corners
from mbla.soil_mesh.planar_program import find_mechanism, with_unit_live_load
from mbla.soil_mesh.scene_of_assembly import Cells, SoilScene, scene_of_assembly

SIZES = (1.0, 1.5)
"""of cells, over that which the deck asks for"""

ROUNDS = 3
"""greatest number of times that the model is built again on moved corners and moved on"""

SAME = 1e-3
"""difference of load factors, over their size, of a mesh as it was moved and of the model built on it: loads on soil
were spread on other cells"""


@dataclass(frozen=True)
class _Candidate:
    """A mesh that was moved.

    load_factors : of planar scenes by name of the load case
    followed     : names of those that the corners were moved for
    """

    assembly: Assembly
    size: float
    load_factors: dict[str, float]
    followed: list[str]


def with_moved_soil(deck: Deck, assembly: Assembly, load_cases: Sequence[LoadCase]) -> Assembly:
    """The assembly on moved corners, from that on the mesh as it is divided, for these load cases.

    Load cases have the figures of their planar scenes on meshes of each size. Where none of them has a scene in which
    the live load does work, the assembly stays as it is.
    """
    candidates = []
    for size in SIZES:
        candidate = _moved(deck, assembly if size == 1.0 else _at_size(deck, assembly, size), size, load_cases)
        if candidate is not None:
            candidates.append(candidate)
    if not candidates:
        return assembly
    best = _better(candidates)
    model = best.assembly.model
    found = {case.name: tuple(_figure(each, case.name, best) for each in candidates) for case in load_cases}
    cases = tuple(
        replace(case, soil=tuple(figure for figure in found.get(case.name, ()) if figure is not None))
        for case in model.load_cases
    )
    return best.assembly.with_load_cases(cases)


def _figure(candidate: _Candidate, name: str, best: _Candidate) -> SoilFigure | None:
    """What a mesh gives for a load case; None where that has no planar scene."""
    factor = candidate.load_factors.get(name)
    if factor is None:
        return None
    cells = _n_cells(candidate.assembly.model)
    return SoilFigure(candidate.size, cells, factor, name in candidate.followed, candidate is best)


def _n_cells(model: Model) -> int:
    return sum(len(soil.triangles) for soil in model.soils)


def _better(candidates: Sequence[_Candidate]) -> _Candidate:
    """The one with the lower load factors, of several the lower ones in the mean of their ratios."""
    best = candidates[0]
    for other in candidates[1:]:
        common = [name for name in best.load_factors if name in other.load_factors]
        pairs = np.array([(best.load_factors[name], other.load_factors[name]) for name in common])
        pairs = pairs[np.isfinite(pairs).all(axis=1)] if np.isfinite(pairs).all(axis=1).any() else pairs
        if len(pairs) and (np.isneginf(pairs[:, 1]).any() or gain_of(pairs[:, 0], pairs[:, 1]) > 0.0):
            best = other
    return best


def _at_size(deck: Deck, assembly: Assembly, size: float) -> Assembly:
    """The assembly on cells of another size, over that which the deck asks for."""
    corners = {soil.name: SoilCorners(size * soil.size, None, moved=False) for soil in assembly.model.soils}
    return build_assembly(deck, build_model(deck, corners))


def _moved(deck: Deck, assembly: Assembly, size: float, load_cases: Sequence[LoadCase]) -> _Candidate | None:
    """A mesh moved for the load cases of a deck; None where none of these has a scene."""
    followed: list[str] = []
    factors: dict[str, float] = {}
    for _ in range(ROUNDS):
        cells = cells_of(assembly.model)
        scenes = {} if cells is None else _scenes(assembly, _again(assembly.model, load_cases), cells)
        before, factors = factors, _load_factors(scenes)
        wanted = _to_follow(load_cases, factors, followed)
        if not wanted:
            return None
        stays = [abs(factors[name] - before[name]) <= SAME * abs(before[name]) for name in wanted if name in before]
        if wanted == followed and all(stays):
            break
        followed = wanted
        chosen = [scenes[name] for name in followed]
        moved = move_corners([each.scene for each in chosen], chosen[0].points, chosen[0].motions)
        if not moved.mechanisms:
            return None
        assert cells is not None
        assembly = build_assembly(deck, build_model(deck, corners_of(assembly.model, cells, moved.points)))
        factors = dict(zip(followed, (each.load_factor for each in moved.mechanisms), strict=True))
    cells = cells_of(assembly.model)
    assert cells is not None
    scenes = _scenes(assembly, _again(assembly.model, load_cases), cells)
    return _Candidate(assembly, size, _load_factors(scenes), followed)


def _again(model: Model, load_cases: Sequence[LoadCase]) -> list[LoadCase]:
    """The same load cases of a model that was built again."""
    own = {case.name: case for case in model.load_cases}
    return [own[case.name] for case in load_cases]


def _scenes(assembly: Assembly, load_cases: Sequence[LoadCase], cells: Cells) -> dict[str, SoilScene]:
    """Planar scenes of load cases by their names, those of one mesh."""
    found: dict[str, SoilScene] = {}
    for case in load_cases:
        scene = scene_of_assembly(assembly, case, cells)
        if scene is None:
            continue
        first = next(iter(found.values()), scene)
        if scene.points.shape == first.points.shape and scene.motions.shape == first.motions.shape:
            found[case.name] = scene
    return found


def _load_factors(scenes: dict[str, SoilScene]) -> dict[str, float]:
    """Of planar scenes; inf where nothing moves."""
    found = {}
    for name, each in scenes.items():
        scene, unit = with_unit_live_load(each.scene, each.points)
        mechanism = find_mechanism(scene, each.points)
        found[name] = np.inf if mechanism is None else mechanism.load_factor / unit
    return found


def _to_follow(load_cases: Sequence[LoadCase], factors: dict[str, float], followed: list[str]) -> list[str]:
    """Names of the load cases that the mesh is to follow: all, of the positions of a travelling load the worst ones."""
    wanted = list(followed)
    travelling: dict[str, list[str]] = {}
    for case in load_cases:
        if case.name not in factors:
            continue
        if isinstance(case.question, Travel):
            travelling.setdefault(case.deck_name, []).append(case.name)
        elif case.name not in wanted:
            wanted.append(case.name)
    for names in travelling.values():
        worst = min(names, key=lambda name: factors[name])
        if worst not in wanted:
            wanted.append(worst)
    return wanted
