"""Rigid blocks in time beside the path of elastic joints: the load factor at which a structure in the plane moves on.

::

    python -m tests.performance.rigid_in_time                  all structures, half a minute each at most
    python -m tests.performance.rigid_in_time ferris --ratio 1 some, with joints of another stiffness in shear

A second opinion that shares nothing with the solver stage: of mbla only blocks, contacts and loads are taken. Blocks
are rigid and have their masses, joints have Coulomb friction without dilatancy and restitution 0. Displacements are
small: directions and levers stay, gaps add up. A step is implicit (Moreau and Jean): with velocities v (3 a block),
contact velocities u = G v (normal, tangent) and forces P = (N, T) at the ends of the interfaces,

    M (v − v₀)/h = F + Gᵀ P,   N = (−k g)₊, g = g₀ + h u_N,   T nearest to T₀ − k_t h u_T within ±μN

by Newton's method on the law itself, without smoothing; a step that is not solved is made in two halves. g is the gap:
a joint that has opened by some width closes by as much before it presses again. Joints that are rigid altogether (N, g
≥ 0, N g = 0) select nothing: at rest each admissible P fits them, and what is found hangs on how P is looked for. So k
is large, ``STIFF`` times what the mass of a block is worth over a step, and in proportion to areas.

The live load rises by shares of the dead load. After each rise steps follow until nothing moves any more, or until the
structure has not come to rest; then it goes back to the last state at rest and rises by a fifth. Moments of inertia are
those of bounding rectangles: they change how it moves, not when.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from mbla.arrays import FloatArray, IntArray
from mbla.assembly import build_assembly
from mbla.contacts import Contacts
from mbla.deck import read_deck
from mbla.model import Model, build_model
from mbla.model.model import select_cases
from tests.decks.folder import DECKS
from tests.performance.recording import PROJECT, record

STRUCTURES = (
    ("benchmarks/published/ferris_wall_1", "push_x"),
    ("benchmarks/published/ferris_wall_3", "push_x"),
    ("benchmarks/published/ferris_wall_5", "push_x"),
    ("benchmarks/closed_forms/wall_10x10", "in_plane"),
    ("benchmarks/closed_forms/wall_20x20", "in_plane"),
    ("tutorials/lintels_and_arches", "in_plane"),
    ("structures/colonnade", "along"),
)
"""decks and load cases in the plane of x and z"""

STIFF, RATIO = 1e4, 0.4
"""k over mean mass over the square of a step, mean of all points, and k_t over k"""
AT_REST, BALANCED, FLAT = 1e-6, 1e-9, 1e-6
"""velocities, over those of a fall of one step, that are none, unbalanced force over the greatest load; out of plane"""
DIRECTIONS, HALVINGS, STEPS = 40, 8, 200
"""of Newton's method, halvings of a step, and steps in which a structure comes to rest"""
RISE, FINER, FINEST = 0.02, 5.0, 4e-4
"""share of the dead load by which the live load rises, over what it is divided where the structure moves on, and share
of the load factor that is the last of them"""


@dataclass(frozen=True)
class Assembly:
    """Rigid blocks in the plane; ``G`` (2 n_points, 3 n_blocks) with rows normal, tangent of each point in turn.

    mass       : (3 n_blocks,)
    friction   : (n_points,)
    stiffness  : (n_points, 2) k and k_t
    dead, live : (3 n_blocks,) forces along x and z, moments from x to z
    """

    G: sp.csr_matrix
    mass: FloatArray
    friction: FloatArray
    stiffness: FloatArray
    dead: FloatArray
    live: FloatArray


@dataclass(frozen=True)
class State:
    """Velocities (3 n_blocks,), gaps with negative ones as joints are pressed, and shear (n_points,), after a step."""

    velocities: FloatArray
    gaps: FloatArray
    shear: FloatArray


def assembly_of(model: Model, contacts: Contacts, case: str, ratio: float = RATIO) -> Assembly:
    """Blocks of a deck that lies in the plane of x and z, and their joints without strengths.

    Raises ValueError where joints bear more than friction, blocks are glued, or forces or joints leave the plane.
    """
    load_case, blocks, free = select_cases(model, [case])[0], model.blocks, np.flatnonzero(~model.fixed)
    laws = {(joint.cohesion, joint.tensile_strength, joint.compressive_strength) for joint in model.joints.values()}
    others = contacts.solid_of_block is not None or len(model.ties) or len(model.guides)
    across = np.any(np.abs(contacts.normals[:, 1]) > FLAT) or np.any(load_case.live_load[free, 1])
    if laws != {(0.0, 0.0, np.inf)} or others or across:
        raise ValueError("blocks and forces are to lie in the plane of x and z, and joints to have friction alone")
    rows = np.full(len(blocks) + len(model.grounds), -1)
    rows[free] = np.arange(len(free))
    G, areas = _compatibility(model, contacts, rows), np.repeat(0.5 * contacts.areas, 2)
    friction = np.repeat([model.joints[contacts.joint_names[law]].friction for law in contacts.joints], 2)
    corners = [blocks.vertices[blocks.vertex_start[b] : blocks.vertex_start[b + 1]] for b in free]
    sides = np.array([np.ptp(each, axis=0) for each in corners])[:, [0, 2]]
    masses = (blocks.densities * blocks.volumes)[free]
    mass = np.column_stack([masses, masses, masses * (sides**2).sum(axis=1) / 12.0]).ravel()
    stiffness = STIFF * masses.mean() * areas / areas.mean()
    loads = (load_case.dead_load[free], load_case.live_load[free])
    dead, live = (np.column_stack([load[:, 0], load[:, 2], -load[:, 4]]).ravel() for load in loads)
    return Assembly(G, mass, friction, np.column_stack([stiffness, ratio * stiffness]), dead, live)


def _compatibility(model: Model, contacts: Contacts, rows: IntArray) -> sp.csr_matrix:
    """G, from the two ends of each interface in turn."""
    entries: list[tuple[int, int, float]] = []
    for number, (bodies, normal) in enumerate(zip(contacts.bodies, contacts.normals, strict=True)):
        n = normal[[0, 2]] / np.hypot(normal[0], normal[2])
        t = np.array([-n[1], n[0]])
        points = contacts.points[contacts.point_start[number] : contacts.point_start[number + 1]][:, [0, 2]]
        for side, end in enumerate((points[np.argmin(points @ t)], points[np.argmax(points @ t)])):
            for body, sign in zip(bodies, (-1.0, 1.0), strict=True):
                if rows[body] >= 0:
                    arm = end - model.blocks.centroids[body][[0, 2]]
                    for axis, (x, z) in enumerate((n, t)):
                        row, motion = 4 * number + 2 * side + axis, (x, z, arm[0] * z - arm[1] * x)
                        entries += [(row, 3 * rows[body] + k, sign * value) for k, value in enumerate(motion)]
    i, j, values = map(np.array, zip(*entries, strict=True))
    return sp.csr_matrix((values, (i.astype(int), j.astype(int))), shape=(4 * len(contacts), 3 * int(rows.max() + 1)))


def stepped(assembly: Assembly, state: State, factor: float, h: float = 1.0) -> State:
    """After an implicit step, or what it takes of shorter ones; the last of them as it is."""
    G, mass = assembly.G, assembly.mass
    loads = assembly.dead + factor * assembly.live
    v, size = state.velocities, float(np.abs(assembly.dead).max())

    def at(v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        forces, slopes = law(assembly, state, h * (G @ v).reshape(-1, 2))
        return mass * (v - state.velocities) / h - loads - G.T @ forces.ravel(), forces, slopes

    unbalanced, forces, slopes = at(v)
    for _ in range(DIRECTIONS):
        if np.abs(unbalanced).max() < BALANCED * size:
            break
        blocks = sp.bsr_matrix((h * slopes, np.arange(len(slopes)), np.arange(len(slopes) + 1)))
        matrix = sp.diags(mass / h) + G.T @ blocks @ G
        direction, length = splu(matrix.tocsc()).solve(-unbalanced), 1.0
        tried = at(v + direction)
        while np.linalg.norm(tried[0]) > np.linalg.norm(unbalanced) and length > 0.05:
            length *= 0.5
            tried = at(v + length * direction)
        v, (unbalanced, forces, slopes) = v + length * direction, tried
    else:
        if h > 0.5**HALVINGS:
            return stepped(assembly, stepped(assembly, state, factor, 0.5 * h), factor, 0.5 * h)
    return State(v, state.gaps + h * (G @ v)[::2], forces[:, 1])


def law(assembly: Assembly, state: State, moved: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Forces after displacements of the contacts, (n_points, 2), and minus their derivatives, (n_points, 2, 2)."""
    k, k_t = assembly.stiffness.T
    pressing, trial = -k * (state.gaps + moved[:, 0]), state.shear - k_t * moved[:, 1]
    normal = np.maximum(pressing, 0.0)
    most = assembly.friction * normal
    slips = np.abs(trial) > most
    slopes = np.zeros((len(k), 2, 2))
    slopes[:, 0, 0] = np.where(pressing > 0.0, k, 0.0)
    slopes[:, 1, 1] = np.where(slips, 0.0, k_t)
    slopes[:, 1, 0] = np.where(slips, np.sign(trial) * assembly.friction * slopes[:, 0, 0], 0.0)
    return np.column_stack([normal, np.clip(trial, -most, most)]), slopes


def at_rest(assembly: Assembly, state: State, factor: float) -> State | None:
    """The state in which nothing moves any more under a load; None where it does not come to rest."""
    fall = float(np.median(np.abs(assembly.dead[1::3]) / assembly.mass[1::3]))
    for _ in range(STEPS):
        state = stepped(assembly, state, factor)
        if float(np.abs(assembly.G @ state.velocities).max()) < AT_REST * fall:
            return replace(state, velocities=np.zeros_like(state.velocities))
    return None


def start_of_motion(assembly: Assembly) -> tuple[float, float]:
    """Load factors at which it came to rest, the greatest, and at which it did not; nan where it does not stand."""
    nothing = np.zeros(len(assembly.friction))
    state = at_rest(assembly, State(np.zeros(len(assembly.mass)), nothing, nothing), 0.0)
    if state is None:
        return np.nan, 0.0
    unit = float(np.abs(assembly.dead).sum() / np.abs(assembly.live).sum())
    borne, rise, moves = 0.0, RISE * unit, np.inf
    while rise > FINEST * borne:
        after = at_rest(assembly, state, borne + rise)
        if after is None:
            moves, rise = borne + rise, rise / FINER
        else:
            state, borne = after, borne + rise
    return borne, moves


def by_path(path: Path, case: str, ratio: float) -> tuple[float, float]:
    """Load factors of the path and of associative flow, from the command."""
    settings = ("analysis.flow_rule=non_associative", "analysis.search=0", f"analysis.path.ratio={ratio:g}")
    words = [sys.executable, "-m", "mbla", "run", str(path), "--case", case, "--json", "-q"]
    words += [f"--set={setting}" for setting in settings]
    with TemporaryDirectory() as folder:
        child = subprocess.run(
            [*words, "-o", f"{folder}/out"], cwd=PROJECT, capture_output=True, text=True, check=False
        )
    found = json.loads(child.stdout)["cases"][0]
    return float(found["load_factor"]), float(found["associative_load_factor"])


def measure(name: str, case: str, ratio: float) -> None:
    """One structure, both ways, as a row."""
    path = DECKS / f"{name}.yaml"
    deck, started = read_deck(path, ()), time.process_time()
    model = build_model(deck)
    rests, moves = start_of_motion(assembly_of(model, build_assembly(deck, model).contacts, case, ratio))
    seconds = time.process_time() - started
    of_path, associative = by_path(path, case, ratio)
    off = 0.0 if rests <= of_path <= moves else min(abs(of_path - rests), abs(of_path - moves)) / of_path
    row = {"structure": name, "case": case, "ratio": f"{ratio:g}", "rests": f"{rests:.6g}", "moves": f"{moves:.6g}"}
    row |= {"path": f"{of_path:.6g}", "associative": f"{associative:.6g}", "off": f"{off:.1e}"}
    record("rigid_in_time", row | {"seconds": f"{seconds:.3g}"})


def main() -> None:
    """As the first lines say."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("structure", nargs="?", default="", help="part of a deck's name; else all")
    parser.add_argument("--ratio", type=float, default=RATIO, help="stiffness in shear over that of pressure")
    options = parser.parse_args()
    for name, case in STRUCTURES:
        if options.structure in name:
            measure(name, case, options.ratio)


if __name__ == "__main__":
    main()
