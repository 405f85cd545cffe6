"""The header of a PLY file in the words that meshio knows; what meshio takes for something else is refused.

Source: G. Turk, The PLY polygon file format, https://gamma.cs.unc.edu/POWERPLANT/papers/ply.pdf
"""

from __future__ import annotations

from collections.abc import Iterator

from mbla.model.geometry.geometry import GeometryFileError

SYNONYMS = {"float64": "double", "ushort": "uint16", "int16": "short"}
"""names of types that meshio does not know everywhere, and others of the same types that it does"""
TYPES = {"int", "int8", "int32", "int64", "uint", "uchar", "uint8", "uint16", "uint32", "uint64"}
TYPES |= {"float", "float32", "double"}
TYPES_OF_TEXT = TYPES | {"char", "short"}
CORNERS = "vertex_indices"
"""name of the list of a face's corners; vertex_index is in use, too, and meshio knows one"""
Properties = dict[str, list[tuple[str, list[str]]]]
"""name of each property with its type, or with ``list`` and two types, by element"""


def readable_header(header: bytes, as_text: bool) -> bytes:
    """The same without comments, line by line, names as meshio knows them.

    Raises
    ------
    GeometryFileError
        for properties that meshio does not read, or not there, with their name
    """
    lines: list[str] = []
    found: Properties = {}
    element = ""
    for line in header.decode("utf-8", errors="replace").split("\n"):
        match line.split():
            case ["comment" | "obj_info" as word, *_]:
                line = word
            case ["element", element, *_]:
                found[element] = []
            case ["property", *kinds, name] if element in found:
                kinds = [SYNONYMS.get(kind, kind) for kind in kinds]
                name = CORNERS if (element, kinds[:1], name) == ("face", ["list"], "vertex_index") else name
                found[element].append((name, kinds))
                line = " ".join(["property", *kinds, name])
        lines.append(line)
    for words in _unread(found, as_text):
        raise GeometryFileError("geometry-file", words)
    return "\n".join(lines).encode()


def _unread(found: Properties, as_text: bool) -> Iterator[str]:
    """What is not read, in words."""
    if [element for element in found if element in ("vertex", "face")] == ["face", "vertex"]:
        yield "its faces cannot be read: they stand before its vertices; export the mesh with vertices first"
    names = [name for name, _ in found.get("vertex", [])]
    if "vertex" in found and as_text and names[:3] != ["x", "y", "z"]:
        yield "its vertices cannot be read: their first properties are not x, y and z"
    if "vertex" in found and not {"x", "y", "z"} <= set(names):
        yield "its vertices cannot be read: x, y or z is not among their properties"
    for element, noun in (("vertex", "vertices"), ("face", "faces")):
        before = True
        for name, kinds in found.get(element, []):
            corners = element == "face" and before and name == CORNERS and kinds[:1] == ["list"]
            before = before and not corners
            if reason := _reason(element, kinds, corners, before, as_text):
                yield f"property {name[:100]!r} of its {noun} cannot be read: {reason}; export the mesh without it"


def _reason(element: str, kinds: list[str], corners: bool, before: bool, as_text: bool) -> str:
    """Why a property is not read; empty where it is.

    corners : it is the list of a face's corners
    before  : it stands before that
    """
    listed = kinds[:1] == ["list"]
    unknown = [kind for kind in kinds[listed:] if kind not in (TYPES_OF_TEXT if as_text else TYPES)]
    if unknown:
        return f"type {unknown[0][:100]} is not known" + ("" if as_text else " in binary files")
    if corners:
        return ""
    if listed:
        return "it is a list" + (f" other than {CORNERS}" if element == "face" else "")
    if element == "face" and not as_text:
        return f"faces of binary files may have nothing but {CORNERS}"
    return f"it stands before {CORNERS}" if element == "face" and before else ""
