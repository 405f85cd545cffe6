"""From an assembly with cells of soil and a load case to a planar scene, and the displacements of its points.

Interfaces are seen along the direction across the plane: an edge from one end to the other of their contact points,
with the strengths of their joint law times area over length. Weight, and whatever else accelerates the mass of cells,
is a density, so that it moves with the corners; other loads on cells act on them as they are. Crushing is that of two
points an interface; ties, load cells and interfaces across the direction, as to spandrel walls, are left out, as the
load factor of the moved mesh is that of the structure that is built on it again.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from scipy.linalg import null_space, orth
from scipy.spatial import KDTree

from mbla.arrays import BoolArray, FloatArray, IntArray, summed
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.model.applied_load import AppliedLoad
from mbla.model.model import LoadCase
from mbla.model.soil.plane_mesh import areas_of
from mbla.soil_mesh.outline import corner_motions, outline_of
from mbla.soil_mesh.planar_scene import NOTHING, PlanarScene
from mbla.soil_mesh.strips import strip_loads

ACROSS = 1e-4
"""cosine of the angle between the normal of an interface and the direction across, or the plane, up to which it is seen
edge-on, or lies in the plane"""

SAME = 1e-5
"""distance over the size of cells up to which a contact point is a corner of theirs"""


@dataclass(frozen=True)
class Cells:
    """Cells of soil: prisms on the triangles of a plane.

    points    : (n_points, 2) coordinates along the first two axes
    triangles : (n_cells, 3) points, counter-clockwise from the first axis to the second
    blocks    : (n_cells,) the block of each
    axes      : (3, 3) unit vectors, two of the plane and one across
    held      : (n_points,) points that stay
    """

    points: FloatArray
    triangles: IntArray
    blocks: IntArray
    axes: FloatArray
    held: BoolArray


@dataclass(frozen=True)
class SoilScene:
    """A planar scene, its points, the first of which are those of the cells, and their displacements.

    motions : (2 n_points, n_unknowns)
    """

    scene: PlanarScene
    points: FloatArray
    motions: sp.csr_array


@dataclass(frozen=True)
class _Edges:
    """Interfaces as edges (n, 2) of points (n_points, 2): assembly's bodies on their sides (n, 2), lengths (n,)."""

    points: FloatArray
    edges: IntArray
    bodies: IntArray
    lengths: FloatArray


def scene_of_assembly(assembly: Assembly, load_case: LoadCase, cells: Cells) -> SoilScene | None:
    """The planar scene of a load case; None where an interface is seen at an angle, so that there is none."""
    bodies = assembly.of(load_case)
    contacts = bodies.contacts
    across = np.abs(contacts.normals[: contacts.n_surfaces] @ cells.axes[2])
    if ((across > ACROSS) & (across < 1.0 - ACROSS)).any():
        return None
    seen = np.flatnonzero(across <= ACROSS)
    own = bodies.label[cells.blocks]
    others = np.setdiff1d(bodies.model.free, own)
    order = np.concatenate([own, others])
    edges = _edges(bodies, cells, own, seen)
    row = np.full(len(bodies.model.blocks) + len(bodies.model.grounds), NOTHING)
    row[order] = np.arange(len(order))
    laws = [bodies.model.joints[name] for name in contacts.joint_names]
    law, width = contacts.joints[seen], contacts.areas[seen] / edges.lengths

    def per_length(values: list[float]) -> FloatArray:
        return np.asarray(np.array(values, dtype=np.float64)[law] * width)

    loads, densities = _loads(bodies, load_case, cells, order)
    scene = PlanarScene(
        triangles=cells.triangles,
        edges=edges.edges,
        sides=row[edges.bodies],
        friction=np.array([each.friction for each in laws])[law],
        cohesion=per_length([each.cohesion for each in laws]),
        tensile_strength=per_length([each.tensile_strength for each in laws]),
        compressive_strength=per_length([each.compressive_strength for each in laws]),
        centres=bodies.model.blocks.centroids[order] @ cells.axes[:2].T,
        ways=_ways(bodies, cells.axes, order),
        dead=loads[0],
        live=loads[1],
        dead_density=densities[0],
        live_density=densities[1],
    )
    scene = _with_strips(scene, load_case, cells, edges.points)
    return SoilScene(scene, edges.points, _motions(edges, cells, own, law))


def _edges(bodies: RigidBodies, cells: Cells, own: IntArray, seen: IntArray) -> _Edges:
    """Interfaces that are seen edge-on, (n,), from end to end, the body that the normal points to on the left."""
    contacts, plane = bodies.contacts, cells.axes[:2].T
    n = contacts.n_surfaces
    normals = contacts.normals[:n] @ plane
    along = np.column_stack([normals[:, 1], -normals[:, 0]])
    along = along / np.maximum(np.linalg.norm(along, axis=1), ACROSS)[:, None]
    places = contacts.points @ plane
    interface = contacts.interface_of_point
    surfaces = np.flatnonzero(interface < n)
    at = np.full(len(places), np.inf)
    at[surfaces] = (places[surfaces] * along[interface[surfaces]]).sum(axis=1)
    order = np.lexsort((at, interface))
    ends = np.stack([order[contacts.point_start[:n]], order[contacts.point_start[1 : n + 1] - 1]], axis=1)
    ends = ends[seen]
    lengths = at[ends[:, 1]] - at[ends[:, 0]]
    bodies_of = contacts.bodies[seen, ::-1]
    named = np.arange(2 * len(seen)).reshape(-1, 2) + len(cells.points)
    corner = _corners_at(places[ends], cells)
    beside = np.asarray(np.isin(bodies_of, own).any(axis=1))[:, None] & (corner >= 0)
    points = np.vstack([cells.points, places[ends].reshape(-1, 2)])
    return _Edges(points, np.where(beside, corner, named), bodies_of, lengths)


def _corners_at(places: FloatArray, cells: Cells) -> IntArray:
    """Corner of the cells at each place, (..., 2); -1 where there is none."""
    away, nearest = KDTree(cells.points).query(places)
    size = float(np.sqrt(areas_of(cells.triangles, cells.points).mean()))
    return np.where(away <= SAME * size, nearest, -1)


def _motions(edges: _Edges, cells: Cells, own: IntArray, law: IntArray) -> sp.csr_array:
    """Displacements of the points: edges of the outline are told apart by bodies and joint laws beyond them."""
    outline, n = outline_of(cells.triangles), len(cells.points)
    row = {tuple(pair): number for number, pair in enumerate(np.sort(outline, axis=1).tolist())}
    beyond: list[set[tuple[int, int]]] = [set() for _ in outline]
    held = np.ones(len(edges.points), dtype=bool)
    held[:n] = cells.held
    is_cell = np.asarray(np.isin(edges.bodies, own))
    for number in np.flatnonzero(is_cell.sum(axis=1) == 1).tolist():
        edge = edges.edges[number]
        there = row.get((int(edge.min()), int(edge.max())))
        if there is None:
            held[edge] = True
        else:
            beyond[there].add((int(edges.bodies[number][~is_cell[number]][0]), int(law[number])))
    kinds = {kind: number for number, kind in enumerate(dict.fromkeys(map(frozenset, beyond)))}
    return corner_motions(edges.points, outline, np.array([kinds[frozenset(each)] for each in beyond]), held)


def _loads(
    bodies: RigidBodies, load_case: LoadCase, cells: Cells, order: IntArray
) -> tuple[tuple[FloatArray, ...], tuple[FloatArray, ...]]:
    """Dead and live loads in the plane, (n_bodies, 3), and of them the densities on cells, (n_cells, 2)."""
    on_bodies, areas, n = bodies.load_case(load_case), areas_of(cells.triangles, cells.points), len(cells.blocks)
    across = np.cross(cells.axes[0], cells.axes[1])
    loads, densities = [], []
    for total, single in ((on_bodies.dead_load, load_case.dead), (on_bodies.live_load, load_case.live)):
        forces = total[order]
        planar = np.column_stack([forces[:, :3] @ cells.axes[:2].T, forces[:, 3:] @ across])
        density = _mass_forces(single, len(bodies.arms))[cells.blocks] @ cells.axes[:2].T / areas[:, None]
        planar[:n, :2] -= areas[:, None] * density
        loads.append(planar)
        densities.append(density)
    return tuple(loads), tuple(densities)


def _with_strips(scene: PlanarScene, load_case: LoadCase, cells: Cells, points: FloatArray) -> PlanarScene:
    """The scene with what axles stand on as strips, in the place of what cells carry of them."""
    dead, live = (_strips(each, cells) for each in (load_case.dead, load_case.live))
    if not len(dead) + len(live):
        return scene
    outline = outline_of(cells.triangles)[:, ::-1]
    own = points[outline]
    steps = own[:, 1] - own[:, 0]
    reach = SAME * float(np.sqrt(areas_of(cells.triangles, cells.points).mean()))
    strips = np.concatenate([dead, live])
    off = own[..., 1, None] - (strips[:, 4] + strips[:, 5] * (own[..., 0, None] - strips[:, 0]))
    on_top = (steps[:, 0] > reach) & (np.abs(off) <= reach).all(axis=1).any(axis=1)
    corners = np.sort(cells.triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2)
    cell_of = {tuple(pair): row // 3 for row, pair in enumerate(corners.tolist())}
    tops = outline[on_top]
    under = np.array([cell_of[tuple(sorted(pair))] for pair in tops.tolist()], dtype=np.int64)
    scene = replace(scene, tops=tops, under=under, dead_strips=dead[:, :4], live_strips=live[:, :4])
    return replace(
        scene,
        dead=scene.dead - strip_loads(scene, points, scene.dead_strips),
        live=scene.live - strip_loads(scene, points, scene.live_strips),
    )


def _strips(loads: tuple[AppliedLoad, ...], cells: Cells) -> FloatArray:
    """Patches that loads press on as strips, (n, 6), with their height where they begin and their slope."""
    found = [np.empty((0, 6))]
    for patches in (each for load in loads for each in (load.patches, load.on_cells)):
        if patches.spreads or not np.isin(patches.blocks, cells.blocks).any():
            continue
        places = patches.corners @ cells.axes[:2].T
        forces = patches.forces @ cells.axes[:2].T
        rows, first, last = np.arange(len(places)), places[..., 0].argmin(axis=1), places[..., 0].argmax(axis=1)
        begin, end = places[rows, first], places[rows, last]
        lengths = end[:, :1] - begin[:, :1]
        long = lengths[:, 0] > 0.0
        strips = np.hstack([begin[:, :1], end[:, :1], forces / lengths, begin[:, 1:], (end - begin)[:, 1:] / lengths])
        found.append(_joined(strips[long]))
    return np.concatenate(found)


def _joined(strips: FloatArray) -> FloatArray:
    """Strips, (n, 6), those that go on as one: what presses evenly on a cell and on the next is one strip."""
    joined: list[FloatArray] = []
    for strip in strips[np.argsort(strips[:, 0])]:
        last = joined[-1] if joined else None
        size = strip[1] - strip[0]
        if last is not None and abs(last[1] - strip[0]) <= SAME * size:
            height = last[4] + last[5] * (strip[0] - last[0])
            even = np.abs(last[2:4] - strip[2:4]).max() <= SAME * np.abs(strip[2:4]).max()
            if even and abs(height - strip[4]) <= SAME * size and abs(last[5] - strip[5]) <= SAME:
                last[1] = strip[1]
                continue
        joined.append(strip.copy())
    return np.reshape(joined, (-1, 6))


def _mass_forces(loads: tuple[AppliedLoad, ...], n_blocks: int) -> FloatArray:
    """Forces of accelerations, and of the lift of water, on blocks, (n_blocks, 3)."""
    total = np.zeros((n_blocks, 3))
    for load in loads:
        if load.on_masses or load.of_water:
            total += summed(load.blocks, load.wrenches[:, :3], n_blocks)
    return total


def _ways(bodies: RigidBodies, axes: FloatArray, order: IntArray) -> sp.csr_array:
    """Motions in the plane that guides leave to the bodies, (3 n, n_ways)."""
    guides = bodies.model.guides
    row = np.full(len(bodies.model.blocks), -1)
    row[order] = np.arange(len(order))
    free = np.setdiff1d(np.flatnonzero(~bodies.model.fixed[order]), row[guides.blocks])
    columns = (3 * free[:, None] + np.arange(3)).ravel()
    parts = [sp.csc_array(sp.eye_array(3 * len(order), format="csc")[:, columns])]
    basis = np.zeros((6, 3))
    basis[:3, :2], basis[3:, 2] = axes[:2].T, np.cross(axes[0], axes[1])
    for guided in range(guides.n_bodies):
        members = np.flatnonzero(guides.bodies == guided)
        allowed = guides.motions[members].reshape(-1, guides.motions.shape[2])
        planar = np.kron(np.eye(len(members)), basis)
        common = null_space(np.hstack([allowed, -planar]))[allowed.shape[1] :]
        motions = orth(common) if common.size else common
        places = (3 * row[guides.blocks[members]][:, None] + np.arange(3)).ravel()
        whole = np.zeros((3 * len(order), motions.shape[1]))
        whole[places] = motions
        parts.append(sp.csc_array(whole))
    return sp.csr_array(sp.hstack(parts))
