"""Masonry on the arches of a bridge: spandrels, backing between them, parapets."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Finding
from mbla.model.blocks.arches.spandrels import (
    Course,
    CoursedMasonry,
    Outline,
    bed_levels,
    bond_of_course,
    build_outline,
    course_pieces,
    coursed,
)
from mbla.model.blocks.bridges.arches import BridgeFrame, part_through
from mbla.model.blocks.generated import ItemPart, ItemRefused
from mbla.model.solids.polyhedra import prisms

if TYPE_CHECKING:
    from mbla.model.blocks.bridge import BridgeItem


def masonry(item: BridgeItem, frame: BridgeFrame) -> list[ItemPart]:
    """Spandrels, backing and parapets of a bridge that has spandrels."""
    assert item.unit is not None  # rules of the deck
    assert item.cover is not None
    outline = _outline(frame)
    crowns = np.array([section.line(-1)[:, 1].max() for section in frame.sections])
    top = float(crowns.max()) + item.cover
    if not np.isfinite(top + frame.right - frame.left):
        return []  # coordinates beyond what a double holds: the voussoirs are refused
    laid = CoursedMasonry(*item.unit, extent=min(top, frame.right - frame.left))
    shelves = np.array([springer[:, 1].max() for springer in frame.springers if springer is not None])
    beds = bed_levels(outline, top, crowns, shelves, laid)
    polygons, course, unit = coursed(outline, beds, (frame.left, frame.right), laid)
    if not polygons:
        message = "is too large for what lies above the arches: take a smaller unit, or more cover"
        raise ItemRefused(Finding("out-of-bounds", message, "unit"))
    rows = _in_place(item, polygons, {"course": course, "unit": unit})
    if item.parapets is not None:
        rows.append(_parapets(item, frame, laid, top, len(beds) - 1))
    return rows


def _outline(frame: BridgeFrame) -> Outline:
    """The extrados of all arches, level to the ends of the bridge."""
    chains = [section.line(-1) for section in frame.sections]
    left, right = [[frame.left, chains[0][0, 1]]], [[frame.right, chains[-1][-1, 1]]]
    return build_outline([np.array(left), *chains, np.array(right)])


def _in_place(item: BridgeItem, polygons: list[FloatArray], labels: dict[str, IntArray]) -> list[ItemPart]:
    """Through the full width; or a wall along each face, and backing between them in the lowest courses."""
    if item.spandrel_thickness is None:
        return [part_through("spandrel", polygons, (0.0, item.width), labels)]
    near, far = item.spandrel_thickness, item.width - item.spandrel_thickness
    rows = [_along_both_faces(item, "spandrel", polygons, labels, item.spandrel_thickness)]
    filled = np.flatnonzero(labels["course"] < (item.backing or 0))
    if len(filled) and near < far:
        chosen = {name: values[filled] for name, values in labels.items()}
        rows.append(part_through("backing", [polygons[i] for i in filled.tolist()], (near, far), chosen))
    return rows


def _along_both_faces(
    item: BridgeItem, member: str, polygons: list[FloatArray], labels: dict[str, IntArray], thickness: float
) -> ItemPart:
    count = len(polygons)
    across = np.repeat([[0.0, thickness], [item.width - thickness, item.width]], count, axis=0)
    both = {name: np.tile(values, 2) for name, values in labels.items()} | {"leaf": np.repeat([0, 1], count)}
    return ItemPart(prisms(polygons * 2, across), member=member, labels=both)


def _parapets(item: BridgeItem, frame: BridgeFrame, laid: CoursedMasonry, top: float, course: int) -> ItemPart:
    """One course on both faces, in bond with the course under it."""
    assert item.parapets is not None
    height = item.parapets.height
    if top + height == top:
        message = f"is too small for {top:g}, the height of the spandrels: make it larger"
        raise ItemRefused(Finding("out-of-bounds", message, "parapets", "height"))
    laid = replace(laid, extent=min(laid.extent, height))
    bond = bond_of_course(frame.left, frame.right, course % 2 == 1, laid.length)
    outline = Outline(np.array([[frame.left, top], [frame.right, top]]))
    polygons, _ = course_pieces(outline, Course(top, top + height, bond), laid)
    labels = {"course": np.full(len(polygons), course), "unit": np.arange(len(polygons))}
    return _along_both_faces(item, "parapet", polygons, labels, item.parapets.thickness)
