"""What is remarked on meshes of soil whose corners were moved."""

from __future__ import annotations

import numpy as np

from mbla.errors import Message
from mbla.model.model import LoadCase
from mbla.model.soil.soil_figure import SoilFigure, scatter_of
from mbla.questions.load_factor import LoadFactor

SCATTER = 0.05
"""of two meshes that were moved, over the lower load factor: known limit loads are missed by as much at most but in a
few cases (tests/performance/soil_mesh.md)"""


def soil_mesh_remarks(load_case: LoadCase) -> tuple[Message, ...]:
    """The load factors of a load case on two meshes, and a warning where they are far apart.

    Of other questions the plane problem has another figure: it is not told.
    """
    figures = load_case.soil
    if not figures:
        return ()
    if not isinstance(load_case.question, LoadFactor) or load_case.question.group != "load_factor":
        return (Message("soil-mesh", "corners of cells were moved to where soil slips"),)
    told = ", ".join(_words(figure) for figure in figures)
    words = (
        "on cells whose corners were moved to where soil slips, the plane problem has load factors of "
        f"{told}; upper ones for soil"
    )
    remarks = [Message("soil-mesh", words)]
    if not any(figure.followed for figure in figures if figure.shown):
        words = "the corners of soil shown were moved for other load cases: its load factor on them is not a sharp one"
        remarks.append(Message("soil-mesh-of-others", words))
    scatter = scatter_of([figure for figure in figures if figure.followed])
    if scatter > SCATTER:
        words = f"load factors on two meshes of soil are {100 * scatter:.0f} % apart: take smaller cells"
        remarks.append(Message("soil-mesh-scatters", words))
    return tuple(remarks)


def _words(figure: SoilFigure) -> str:
    """``198.1 with 361 cells``, and whether the results are those on them."""
    value = "unlimited" if np.isposinf(figure.load_factor) else f"{figure.load_factor:.4g}"
    if np.isneginf(figure.load_factor):
        value = "none, as it falls under its dead load alone,"
    return f"{value} with {figure.cells} cells{', whose results these are,' if figure.shown else ''}"
