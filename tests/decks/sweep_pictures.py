"""The pictures of decks/sweeps/README.md, made by ``mbla sweep`` and ``mbla sweep-plot``.

``python -m tests.decks.sweep_pictures FOLDER`` makes them all, with names behind it those alone. The sweeps go to
FOLDER, where finished points are not solved again.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mbla.cli import main
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import INK, VERMILION, Page, add_legend, add_words, open_page
from mbla.sweeps.tables.read_table import read_sweep_table
from mbla.sweeps.tables.sweep_table import SweepTable
from tests.analytic.frictional_arch import least_friction, least_thickness, rotational_friction
from tests.decks.make_pictures import PICTURES
from tests.decks.sweeps import sweep_path

SIZE = (1100, 720)
PUBLISHED = {0.31: 0.199653, 0.35: 0.152920, 0.38: 0.122192, 0.395832: 0.107426}
"""Cocchetti and Rizzi 2020, those of their tables that lie on the map"""


@dataclass(frozen=True)
class SweepPicture:
    """One file of decks/pictures, named after its sweep.

    plot : options of ``mbla sweep-plot``; None for the map of the arch, which has the theory drawn over it
    """

    sweep: str
    plot: tuple[str, ...] | None


TABLE = (
    SweepPicture("arch_friction_thickness", None),
    SweepPicture("house_directions", ("--kind", "polar")),
    SweepPicture("wall_opening", ("--kind", "curve", "--result", "in_plane.load_factor", "--by", "width")),
    SweepPicture("rubble_wall", ("--kind", "distribution")),
    SweepPicture("dome_workmanship", ("--kind", "scatter")),
)


def make_picture(picture: SweepPicture, folder: Path) -> Path:
    """Solve what is missing of the sweep and draw it; the path written."""
    out = folder / picture.sweep
    resume = ("--resume",) if (out / "journal.csv").exists() else ()
    status = main(["sweep", str(sweep_path(picture.sweep)), "-o", str(out), "-q", *resume])
    assert status == 0, f"{picture.sweep}: mbla sweep ended with {status}"
    target = PICTURES / f"sweep_{picture.sweep}.png"
    if picture.plot is None:
        draw_arch_map(target, read_sweep_table(out))
    else:
        size = "x".join(str(side) for side in SIZE)
        assert main(["sweep-plot", str(out), "-o", str(target), "--size", size, *picture.plot]) == 0
    return target


def draw_arch_map(path: Path, table: SweepTable) -> None:
    """Cells that stand in the colour of their load factor, others white; the theory and its published points."""
    words = [table.title, "load factor of a horizontal push; white: does not stand"]
    with open_page(path, PictureOptions(size=SIZE)) as page:
        above = add_words(page, words)
        axes = page.figure.add_axes((0.09, 0.17, 0.80, 0.80 - above))
        axes.set_facecolor("white")
        mesh = _cells(axes, table)
        _theory(page, axes)
        axes.set_xlabel("friction coefficient", fontsize=0.9 * page.letter, color=INK)
        axes.set_ylabel("thickness over mean radius", fontsize=0.9 * page.letter, color=INK)
        axes.tick_params(labelsize=0.85 * page.letter, colors=INK)
        bar = page.figure.colorbar(mesh, cax=page.figure.add_axes((0.91, 0.17, 0.015, 0.80 - above)))
        bar.ax.tick_params(labelsize=0.8 * page.letter)


def _cells(axes: Any, table: SweepTable) -> Any:
    """Each cell around its point, with a thin edge, so that those that do not stand are seen too."""
    frictions, thicknesses = (np.unique(np.asarray(table[name], dtype=float)) for name in ("mu", "t"))
    solved = np.array([status == "solved" for status in table["status"]])
    factors = np.where(solved, np.asarray(table["load_factor"], dtype=float), np.nan)
    cells = np.ma.masked_invalid(factors.reshape(len(frictions), len(thicknesses)).T)
    edges = [np.concatenate([side - np.diff(side[:2]) / 2, side[-1:] + np.diff(side[:2]) / 2])
             for side in (frictions, thicknesses)]  # fmt: skip
    return axes.pcolormesh(*edges, cells, cmap="viridis", edgecolors="#BBBBBB", linewidth=0.15)


def _theory(page: Page, axes: Any) -> None:
    """Level from the right, rising between the two frictions, upright at the lower one."""
    frictions = np.linspace(least_friction(), rotational_friction(), 80)
    curve = [least_thickness(mu + 1e-12) for mu in frictions]
    x = np.concatenate([[frictions[0]], frictions, [0.455]])
    y = np.concatenate([[0.2425], curve, [curve[-1]]])
    (line,) = axes.plot(x, y, color=VERMILION, linewidth=2.2, label="theory, joints everywhere")
    ring: dict[str, Any] = {"markersize": 8, "markerfacecolor": "white", "markeredgewidth": 2, "linestyle": "none"}
    ends = list(PUBLISHED), list(PUBLISHED.values())
    (points,) = axes.plot(*ends, marker="o", color=VERMILION, label="Cocchetti and Rizzi 2020, tables", **ring)
    add_legend(page, [line, points])


def make_pictures(folder: Path, names: list[str]) -> None:
    """The pictures of those sweeps, all without any."""
    unknown = sorted(set(names) - {picture.sweep for picture in TABLE})
    if unknown:
        raise SystemExit(f"no sweep {', '.join(unknown)}; there are {', '.join(each.sweep for each in TABLE)}")
    for picture in TABLE:
        if not names or picture.sweep in names:
            make_picture(picture, folder)


if __name__ == "__main__":
    make_pictures(Path(sys.argv[1]), sys.argv[2:])
