"""One equilibrium check by compas_cra: rigid-block equilibrium (RBE), or coupled rigid-block analysis (CRA).

Kao et al. 2022, doi:10.1016/j.cad.2022.103216. Neither knows a live load: the answer is whether the structure stands
under its own weight. They get the blocks and interfaces that mbla found, friction is a polyhedron of eight sides around
the cone, and every tolerance is the default of the package. These are absolute, and what ``cra_solve`` answers depends
on the unit of weight: the arch of 20 voussoirs stands with densities up to 20 and is infeasible with 142 and more. Here
it is the default density of 1. The solver is IPOPT, which the wheels of the package bring along.
"""

from __future__ import annotations

import contextlib
import io
from collections.abc import Callable
from functools import partial
from importlib import import_module
from importlib.metadata import version
from typing import Any

import numpy as np

from tests.performance.rivals.structure import Answer, Structure

TENSION = 1e-3
"""Share of the mean block weight in tension at one point above which RBE says that it does not stand."""


def compas_version() -> str:
    """Of the package; ImportError where it is not installed."""
    import_module("compas_cra.equilibrium")
    return f"compas_cra {version('compas_cra')} compas {version('compas')}"


def rbe(structure: Structure) -> Answer:
    """Contact forces with the least tension: an equilibrium exists where they have none."""
    from compas_cra.equilibrium import rbe_solve

    return _checked(structure, partial(rbe_solve, density=1.0))


def cra(structure: Structure) -> Answer:
    """Contact forces that displacements bring about: an equilibrium that arises by itself."""
    from compas_cra.equilibrium import cra_solve

    return _checked(structure, partial(cra_solve, density=1.0))


def assembly_of(structure: Structure) -> Any:
    """Blocks and interfaces as the package holds them; supports are the fixed blocks."""
    from compas.datastructures import Mesh
    from compas.geometry import Frame
    from compas_assembly.datastructures import Block
    from compas_cra.datastructures import CRA_Assembly

    blocks, contacts = structure.model.blocks, structure.contacts
    assembly = CRA_Assembly()
    for block in range(len(blocks)):
        first, last = blocks.vertex_start[block : block + 2]
        faces = range(*blocks.face_start[block : block + 2])
        loops = [blocks.loops[slice(*blocks.loop_start[face : face + 2])] - first for face in faces]
        mesh = Mesh.from_vertices_and_faces(blocks.vertices[first:last].tolist(), [loop.tolist() for loop in loops])
        assembly.add_block(mesh.copy(cls=Block), node=block)
    free = set(structure.model.free.tolist())
    assembly.set_boundary_conditions([block for block in range(len(blocks)) if block not in free])
    for i, (a, b) in enumerate(contacts.bodies.tolist()):
        points = slice(*contacts.point_start[i : i + 2])
        normal, tangent, other = contacts.frames[points][0].tolist()
        corners = contacts.points[points]
        frame = Frame(corners.mean(axis=0).tolist(), tangent, other)
        assert np.allclose(frame.zaxis, normal)
        assembly.add_to_interfaces(a, b, float(contacts.areas[i]), corners.tolist(), frame)
    return assembly


def _checked(structure: Structure, solve: Callable[..., object]) -> Answer:
    assembly = assembly_of(structure)
    model, contacts = structure.model, structure.contacts
    (friction,) = {model.joints[name].friction for name in contacts.joint_names}
    with contextlib.redirect_stdout(io.StringIO()):  # the package prints as it goes
        try:
            solve(assembly, mu=friction)
        except ValueError as failed:
            return Answer(str(failed))
    weight = float(model.blocks.volumes[model.free].mean())  # with density 1, as RBE has it; CRA has no tension
    tension = max((force["c_nn"] for force in _forces(assembly)), default=0.0) / weight
    return Answer("stands" if tension <= TENSION else f"tension of {tension:.2g} weights")


def _forces(assembly: Any) -> list[dict[str, float]]:
    edges = assembly.graph.edges()
    interfaces = [found for edge in edges for found in assembly.graph.edge_attribute(edge, "interfaces")]
    return [force for interface in interfaces for force in interface.forces]
