"""JSON files of COMPAS, versions 1 and 2: every mesh and polyhedron in them, in the order of the file.

A mesh is an object with ``vertex`` and ``face``, wherever it stands: alone, in a list or mapping, as block of an
assembly (``compas_assembly``), as geometry of an element of a model (``compas_model``, ``compas_dem``). Version 1 keeps
the content of an object under ``value``, version 2 under ``data``. Elements of models are placed by their own
``transformation`` and by those of the groups above them in the model's tree. Blocks that are marked as supports are
named ``support``, others by the name that their element or mesh was given.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, starts
from mbla.errors import Notice
from mbla.model.geometry.geometry import Geometry, GeometryFileError, empty_objects, malformed, parse_json
from mbla.model.geometry.welding import own_vertices
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra
from mbla.model.wording import counted, was

SUPPORT = "support"
CLASS_NAMES = frozenset({"Mesh", "Block", "Box", "Polyhedron", "Part", "Element", "Assembly", "Graph", "Model"})
"""names that COMPAS gives by itself"""
OTHER_SHAPES = frozenset({"Box", "Sphere", "Cylinder", "Cone", "Capsule", "Torus", "Brep", "RhinoBrep", "OCCBrep"})
"""solids without vertices and faces"""
BETWEEN_BLOCKS = frozenset({"edge", "edgedata", "adjacency", "interface", "interfaces", "contacts"})
"""keys of what lies between blocks: contact surfaces may be meshes, too"""


@dataclass
class _Found:
    """Surfaces found so far with their names, meshes without faces, and solids that cannot be read."""

    surfaces: list[Polyhedra] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    empty: list[str] = field(default_factory=list)
    others: dict[str, int] = field(default_factory=dict)


@dataclass(frozen=True)
class _Context:
    """What the objects around a mesh say about it."""

    name: str = ""
    support: bool = False
    matrix: FloatArray | None = None


def read_compas_json(path: Path) -> Geometry:
    """Meshes and polyhedra of a file written by ``compas.json_dump`` or ``to_json``.

    Raises
    ------
    GeometryFileError
        for files that are no JSON, hold no mesh, or a mesh that is malformed
    """
    try:
        document = parse_json(path.read_bytes())
        found = _Found()
        _collect(document, _Context(), found)
    except RecursionError as error:
        raise GeometryFileError("geometry-file", "is not a COMPAS file: its JSON is nested too deeply") from error
    except (KeyError, IndexError, TypeError, ValueError, AttributeError, OverflowError) as error:
        reason = f"lacks {error}" if isinstance(error, KeyError) else str(error)
        raise malformed("COMPAS JSON", reason) from error
    if found.others and not found.surfaces:
        kinds = ", ".join(sorted(found.others))
        words = f"holds no mesh, but objects of type {kinds}: convert them (Mesh.from_shape, to_mesh)"
        raise GeometryFileError("geometry-without-blocks", words)
    names = tuple(found.names) if any(found.names) else ()
    return Geometry(join_polyhedra(found.surfaces), _notices(found), names)


def _notices(found: _Found) -> tuple[Notice, ...]:
    notices = [*empty_objects(found.empty)]
    if found.others:
        total = sum(found.others.values())
        words = f"{counted(total, 'object')} of type {', '.join(sorted(found.others))} {was(total)} left out: no meshes"
        notices.append(Notice("warning", "mesh-cells-left-out", words))
    supports = found.names.count(SUPPORT)
    if supports:
        words = (
            f"{counted(supports, 'block')} {was(supports)} marked as support in the file; a deck fixes them with "
            f"supports: [{{blocks: {{group: ..., member: {SUPPORT}}}}}]"
        )
        notices.append(Notice("notice", "mesh-supports-marked", words))
    return tuple(notices)


def _collect(value: Any, context: _Context, found: _Found) -> None:
    """Walk through a document in its order."""
    if isinstance(value, list):
        for each in value:
            _collect(each, context, found)
    elif isinstance(value, dict):
        _collect_object(value, context, found)


def _collect_object(entry: dict[str, Any], context: _Context, found: _Found) -> None:
    content: Any = entry
    if isinstance(entry.get("dtype"), str):
        content = entry.get("data", entry.get("value"))
    if not isinstance(content, dict):
        return
    here = _context(entry, content, context)
    kind = str(entry.get("dtype", "")).rpartition("/")[2]
    if isinstance(content.get("vertex"), dict) and isinstance(content.get("face"), dict):
        _add(_mesh(content), here, found)
    elif isinstance(content.get("vertices"), list) and isinstance(content.get("faces"), list):
        _add(_polyhedron(content), here, found)
    elif kind in ("Mesh", "Polyhedron"):
        found.empty.append(here.name)
    elif kind in OTHER_SHAPES:
        found.others[kind] = found.others.get(kind, 0) + 1
    elif isinstance(content.get("elements"), (dict, list)) and isinstance(content.get("tree"), dict):
        _collect_model(content, here, found)
    else:
        for key, each in content.items():
            if key not in BETWEEN_BLOCKS:
                _collect(each, here, found)


def _context(entry: dict[str, Any], content: dict[str, Any], above: _Context) -> _Context:
    """What an object adds to what is known of a mesh in it: the innermost name holds."""
    attributes = content.get("attributes")
    attributes = attributes if isinstance(attributes, dict) else {}
    names = (entry.get("name"), content.get("name"), attributes.get("name"))
    given = [name for name in names if isinstance(name, str) and name and name not in CLASS_NAMES]
    support = content.get("is_support") is True or attributes.get("is_support") is True
    matrix = _matrix(content.get("transformation"))
    if matrix is None or above.matrix is None:
        matrix = above.matrix if matrix is None else matrix
    else:
        matrix = above.matrix @ matrix
    return _Context(given[0] if given else above.name, above.support or support, matrix)


def _matrix(value: Any) -> FloatArray | None:
    """(4, 4) of a transformation; None where there is none."""
    if not isinstance(value, dict):
        return None
    content: Any = value.get("data", value.get("value", value))
    matrix = np.array(content["matrix"], dtype=np.float64)
    if matrix.shape != (4, 4):
        raise ValueError("a transformation has not four by four numbers")
    return matrix


def _collect_model(content: dict[str, Any], context: _Context, found: _Found) -> None:
    """Elements of a model, each placed by the elements above it in the tree."""
    elements = content["elements"]
    if isinstance(elements, list):  # earlier files list them, each with its identifier
        elements = {each.get("guid", str(row)): each for row, each in enumerate(elements)}
    parents: dict[str, str] = {}
    waiting = [(content["tree"].get("root") or {}, "")]
    while waiting:
        node, above = waiting.pop()
        element = node.get("element")
        if element and above:
            parents[element] = above
        waiting += [(child, element or above) for child in node.get("children") or []]
    for identifier, entry in elements.items():
        matrix = context.matrix
        for above in reversed(_ancestors(identifier, parents)):
            own = _matrix((elements[above].get("data") or elements[above].get("value") or {}).get("transformation"))
            matrix = own if matrix is None else matrix if own is None else matrix @ own
        _collect(entry, _Context(context.name, context.support, matrix), found)


def _ancestors(identifier: str, parents: dict[str, str]) -> list[str]:
    """Elements above one, from the nearest on."""
    found: list[str] = []
    while identifier in parents and parents[identifier] not in found:
        identifier = parents[identifier]
        found.append(identifier)
    return found


def _add(surface: Polyhedra, context: _Context, found: _Found) -> None:
    if not len(surface):
        found.empty.append(context.name)
        return
    if context.matrix is not None:
        vertices = surface.vertices @ context.matrix[:3, :3].T + context.matrix[:3, 3]
        surface = Polyhedra(vertices, surface.vertex_start, surface.loops, surface.loop_start, surface.face_start)
    found.surfaces.append(surface)
    found.names.append(SUPPORT if context.support else context.name)


def _mesh(content: dict[str, Any]) -> Polyhedra:
    """Faces over vertices by key; keys are any texts. A vertex without a coordinate has the mesh's default."""
    keys = {str(key): row for row, key in enumerate(content["vertex"])}
    default = content.get("default_vertex_attributes") or content.get("dva") or {}
    points = [
        [_coordinate(vertex.get(axis, default.get(axis)), axis, key) for axis in "xyz"]
        for key, vertex in content["vertex"].items()
    ]
    faces = [[_row(corner, keys, key) for corner in face] for key, face in content["face"].items() if face]
    return _surface(points, faces)


def _coordinate(value: Any, axis: str, key: str) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ValueError(f"vertex {key[:40]} has {'no' if value is None else 'no number as'} {axis}")
    return float(value)


def _row(corner: Any, rows: dict[str, int], face: str) -> int:
    if str(corner) not in rows:
        raise ValueError(f"face {face[:40]} names vertex {str(corner)[:40]}, which does not exist")
    return rows[str(corner)]


def _polyhedron(content: dict[str, Any]) -> Polyhedra:
    """Lists of vertices and faces, as a mesh."""
    vertices = {str(row): dict(zip("xyz", point, strict=True)) for row, point in enumerate(content["vertices"])}
    return _mesh({"vertex": vertices, "face": {str(row): face for row, face in enumerate(content["faces"])}})


def _surface(points: list[list[float]], faces: list[list[int]]) -> Polyhedra:
    counts = np.array([len(face) for face in faces], dtype=np.int64)
    if counts.size and counts.min() < 3:
        raise ValueError("a face has fewer than three corners")
    corners = np.fromiter(chain.from_iterable(faces), dtype=np.int64, count=int(counts.sum()))
    coordinates = np.array(points, dtype=np.float64).reshape(-1, 3)
    return own_vertices(coordinates, corners, starts(counts), np.zeros(len(faces), dtype=np.int64))
