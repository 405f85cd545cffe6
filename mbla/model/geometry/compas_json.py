"""JSON files of COMPAS, versions 1 and 2: every mesh and polyhedron in them, in the order of the file.

A mesh is an object with ``vertex`` and ``face``, wherever it stands: alone, in a list or mapping, as block of an
assembly (``compas_assembly``), as geometry of an element of a model (``compas_model``, ``compas_dem``). Version 1 keeps
the content of an object under ``value``, version 2 under ``data``. Elements of models are placed by their own
``transformation`` and by those of the groups above them in the model's tree. Blocks that are marked as supports are
named ``support``, others by the name that their element or mesh was given.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Notice
from mbla.model.geometry.geometry import Geometry, GeometryFileError, empty_objects, parse_json, well_formed
from mbla.model.solids.polyhedra import polyhedra_from_lists
from mbla.model.wording import with_count

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

    points: list[FloatArray] = field(default_factory=list)
    faces: list[list[list[int]]] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    empty: list[str] = field(default_factory=list)
    others: Counter[str] = field(default_factory=Counter)


@dataclass(frozen=True)
class _Context:
    """What the objects around a mesh say about it; matrix (4, 4)."""

    name: str = ""
    support: bool = False
    matrix: FloatArray = field(default_factory=lambda: np.eye(4))


def read_compas_json(path: Path) -> Geometry:
    """Meshes and polyhedra of a file written by ``compas.json_dump`` or ``to_json``.

    Raises GeometryFileError for files that are no JSON, hold no mesh, or a mesh that is malformed.
    """
    found = _Found()
    with well_formed("COMPAS JSON"):
        _collect(parse_json(path.read_bytes()), _Context(), found)
    kinds = ", ".join(sorted(found.others))
    if kinds and not found.names:
        words = f"holds no mesh, but objects of type {kinds}: convert them (Mesh.from_shape, to_mesh)"
        raise GeometryFileError("geometry-without-blocks", words)
    notices = [*empty_objects(found.empty)]
    if total := found.others.total():
        words = with_count(total, "object", f"left out, of type {kinds}: no meshes")
        notices.append(Notice("warning", "mesh-cells-left-out", words))
    if supports := found.names.count(SUPPORT):
        words = f"marked as support; a deck fixes them with supports: [{{blocks: {{group: ..., member: {SUPPORT}}}}}]"
        notices.append(Notice("notice", "mesh-supports-marked", with_count(supports, "block", words)))
    surfaces = polyhedra_from_lists(found.points, found.faces)
    return Geometry(surfaces, tuple(notices), tuple(found.names) if any(found.names) else ())


def _collect(value: Any, context: _Context, found: _Found) -> None:
    """Walk through a document in its order."""
    if isinstance(value, list):
        for each in value:
            _collect(each, context, found)
    if not isinstance(value, dict):
        return
    content: Any = value
    if isinstance(value.get("dtype"), str):
        content = value.get("data", value.get("value"))
    if not isinstance(content, dict):
        return
    here = _context(value, content, context)
    kind = str(value.get("dtype", "")).rpartition("/")[2]
    if isinstance(content.get("vertex"), dict) and isinstance(content.get("face"), dict):
        default = content.get("default_vertex_attributes") or content.get("dva") or {}
        points = {str(key): default | vertex for key, vertex in content["vertex"].items()}
        _add(points, content["face"], here, found)
    elif isinstance(content.get("vertices"), list) and isinstance(content.get("faces"), list):
        points = {str(row): dict(zip("xyz", each, strict=True)) for row, each in enumerate(content["vertices"])}
        _add(points, {str(row): face for row, face in enumerate(content["faces"])}, here, found)
    elif kind in ("Mesh", "Polyhedron"):
        found.empty.append(here.name)
    elif kind in OTHER_SHAPES:
        found.others[kind] += 1
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
    names = (entry.get("name"), content.get("name"), attributes.get("name"), above.name)
    name = next((name for name in names if isinstance(name, str) and name and name not in CLASS_NAMES), "")
    support = above.support or content.get("is_support") is True or attributes.get("is_support") is True
    return _Context(name, support, above.matrix @ _matrix(content))


def _matrix(content: dict[str, Any]) -> FloatArray:
    """(4, 4) of the transformation of an object, the identity where it has none."""
    value = content.get("transformation")
    if not isinstance(value, dict):
        return np.eye(4)
    data: Any = value.get("data", value.get("value", value))
    matrix = np.array(data["matrix"], dtype=np.float64)
    if matrix.shape != (4, 4):
        raise ValueError("a transformation has not four by four numbers")
    return matrix


def _collect_model(content: dict[str, Any], context: _Context, found: _Found) -> None:
    """Elements of a model in their order, each placed by the elements above it in the tree."""
    elements = content["elements"]
    if isinstance(elements, list):  # earlier files list them, each with its identifier
        elements = {each.get("guid", str(row)): each for row, each in enumerate(elements)}
    placed: dict[str, FloatArray] = {}
    waiting = [(content["tree"].get("root") or {}, context.matrix)]
    while waiting:
        node, above = waiting.pop()
        if element := node.get("element"):
            placed[element] = above
            above = above @ _matrix(elements[element].get("data") or elements[element].get("value") or {})
        waiting += [(child, above) for child in node.get("children") or []]
    for identifier, entry in elements.items():
        _collect(entry, replace(context, matrix=placed.get(identifier, context.matrix)), found)


def _add(points: dict[str, dict[str, Any]], faces: dict[str, list[Any]], context: _Context, found: _Found) -> None:
    """A mesh of vertices by key, which are any texts, and faces of their keys."""
    rows = {key: row for row, key in enumerate(points)}
    places = [[_coordinate(vertex.get(axis), axis, key) for axis in "xyz"] for key, vertex in points.items()]
    loops = [[_row(corner, rows, key) for corner in face] for key, face in faces.items() if face]
    if not loops:
        found.empty.append(context.name)
        return
    if min(len(loop) for loop in loops) < 3:
        raise ValueError("a face has fewer than three corners")
    found.points.append(np.array(places) @ context.matrix[:3, :3].T + context.matrix[:3, 3])
    found.faces.append(loops)
    found.names.append(SUPPORT if context.support else context.name)


def _coordinate(value: Any, axis: str, key: str) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ValueError(f"vertex {key[:40]} has {'no' if value is None else 'no number as'} {axis}")
    return float(value)


def _row(corner: Any, rows: dict[str, int], face: str) -> int:
    if str(corner) not in rows:
        raise ValueError(f"face {face[:40]} names vertex {str(corner)[:40]}, which does not exist")
    return rows[str(corner)]
