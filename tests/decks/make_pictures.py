"""The pictures in decks/pictures, made by ``mbla run`` and ``mbla plot``, by ``mbla sweep`` and ``mbla sweep-plot``.

``python -m tests.decks.make_pictures`` makes them all (some decks and sweeps take minutes), with names those alone:
``python -m tests.decks.make_pictures wall_push_x``.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from mbla.cli import main
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import (
    CASES,
    FIXED_BLOCK,
    GROUPS,
    GUIDED_BLOCK,
    HINGE,
    INK,
    LIVE_LOAD,
    OPEN,
    REST,
    SLAB,
    SLIDE,
    SLOW,
    VERMILION,
    WARNING,
    Page,
    add_legend,
    add_words,
    open_page,
    rgb,
)
from mbla.sweeps.tables.sweep_json import read_sweep_table
from mbla.sweeps.tables.sweep_table import SweepTable
from tests.analytic.frictional_arch import least_friction, least_thickness, rotational_friction
from tests.decks.experiments import MEASURED, NAMES, words_of
from tests.decks.folder import DECKS
from tests.decks.sweeps import sweep_path

PICTURES = DECKS / "pictures"
README = "README.md"
"""in place of a deck: the one that the README prints"""


SMALLER = ("--size", "1200x750")
"""for pictures in space, whose files are large"""
SHADES = (0.45, 0.6, 0.75, 0.9, 1.0)
"""of colours that mean something, as the light makes them"""
IN_LEGENDS = (*GROUPS, SLOW, REST, FIXED_BLOCK, GUIDED_BLOCK, SLAB)
"""colours of blocks, in legends as they are"""
NEARLY_WHITE = 247
"""of a palette: such colours are white, as the background is"""


@dataclass(frozen=True)
class DeckPicture:
    """One file of decks/pictures, SVG if it is plane, PNG if it is in space.

    name : of the file, without its suffix
    deck : below decks/, or ``README``
    case : load case; of a travelling load its name in the deck, the worst position is drawn
    plot : options of ``mbla plot``, of pictures in space their size
    strengthened : it is of what ``mbla strengthen`` finds
    """

    name: str
    deck: str
    case: str
    plot: tuple[str, ...] = ()
    strengthened: bool = False

    @property
    def path(self) -> Path:
        """The file."""
        return PICTURES / f"{self.name}.{'png' if self.plot == SMALLER else 'svg'}"


TABLE = (
    DeckPicture("wall_push_x", README, "push_x"),
    DeckPicture("wall_push_x_forces", README, "push_x", ("--kind", "forces")),
    DeckPicture("wall_model", README, "push_x", ("--kind", "model")),
    DeckPicture("oppenheim_arch_push_x", "benchmarks/published/oppenheim_arch.yaml", "push_x"),
    DeckPicture(
        "oppenheim_arch_push_x_forces", "benchmarks/published/oppenheim_arch.yaml", "push_x", ("--kind", "forces")
    ),
    DeckPicture("settling_wall_sinks", "tutorials/settling_wall.yaml", "sinks"),
    DeckPicture("facade_of_stones_curve", "tutorials/facade_of_stones.yaml", "outwards", ("--kind", "curve")),
    DeckPicture("obj_wall_out_of_plane", "tutorials/obj_wall.yaml", "out_of_plane", SMALLER),
    DeckPicture("crossvault_along_x", "tutorials/crossvault.yaml", "along_x", SMALLER),
    DeckPicture("house_push_x", "structures/house.yaml", "push_x", SMALLER),
    DeckPicture("house_push_y", "structures/house.yaml", "push_y", SMALLER),
    DeckPicture(
        "facade_strengthened", "structures/facade_to_strengthen.yaml", "out_of_plane", SMALLER, strengthened=True
    ),
    DeckPicture("room_push_y", "structures/room.yaml", "push_y", SMALLER),
    DeckPicture("colonnade_across", "structures/colonnade.yaml", "across", SMALLER),
    DeckPicture("arch_bridge", "structures/arch_bridge.yaml", "axle", SMALLER),
    DeckPicture("filled_bridge", "structures/filled_bridge.yaml", "lorry", SMALLER),
    DeckPicture("filled_bridge_positions", "structures/filled_bridge.yaml", "lorry", ("--kind", "history")),
    DeckPicture("cross_vault_on_piers_spreading", "structures/cross_vault_on_piers.yaml", "spreading", SMALLER),
    DeckPicture("dome_on_drum_push_x", "structures/dome_on_drum.yaml", "push_x", SMALLER),
    DeckPicture("spiral_stair_one_tread", "structures/spiral_stair.yaml", "one_tread", SMALLER),
    DeckPicture("retaining_wall_surcharge", "structures/retaining_wall.yaml", "surcharge", SMALLER),
)


STUDIES = ("door_sweep", "wall_interact")
"""pictures of studies of the README's deck, in decks/sweeps/README.md"""
SAMPLE = ("points: 8,", "points: 200,")
"""the sweep of that page is small, so that it runs at once; its picture is of more points"""


def deck_path(picture: DeckPicture, folder: Path) -> Path:
    """The deck of a picture; that of the README is written to the folder."""
    if picture.deck != README:
        return DECKS / picture.deck
    path = folder / "wall.yaml"
    path.write_text(readme_block("`wall.yaml`:"), encoding="utf-8")
    return path


def readme_block(start: str, page: Path = DECKS.parent / README) -> str:
    """The first code block of a page after a piece of text."""
    text = page.read_text(encoding="utf-8")
    return text.split(start, 1)[1].split("```", 2)[1].split("\n", 1)[1]


def make_picture(picture: DeckPicture, folder: Path) -> Path:
    """Solve the deck, once for all of its pictures in that folder, and draw one; the path written."""
    deck = deck_path(picture, folder)
    out = folder / f"{deck.stem}.out"
    result = out / f"{deck.stem}{'_strengthened' if picture.strengthened else ''}.h5"
    if not result.exists():
        command = "strengthen" if picture.strengthened else "run"
        status = main([command, str(deck), "-o", str(out), "--set", "output.vtu=false", "-q"])
        assert status in (0, 4, 5), f"{deck}: mbla run ended with {status}"
    assert main(["plot", str(result), "--case", picture.case, "-o", str(picture.path), *picture.plot]) == 0
    return with_palette(picture.path)


def with_palette(path: Path) -> Path:
    """A picture in space with a palette: its commonest colours, and those that mean something in light and shade."""
    if path.suffix == ".png":
        meaning = (HINGE, SLIDE, OPEN, LIVE_LOAD, WARNING, *CASES)
        shades = [255, 255, 255]
        shades += [round(255 * light * part) for name in meaning for light in SHADES for part in rgb(name)]
        shades += [round(255 * part) for name in IN_LEGENDS for part in rgb(name)]
        with Image.open(path) as image:
            picture = image.convert("RGB")
        common = np.array(picture.quantize(256 - len(shades) // 3).getpalette(), dtype=np.uint8).reshape(-1, 3)
        common[common.min(axis=1) > NEARLY_WHITE] = 255
        palette = Image.new("P", (1, 1))
        palette.putpalette([*shades, *common.ravel().tolist()][:768])
        picture.quantize(palette=palette, dither=Image.Dither.NONE).save(path, optimize=True)
    return path


def make_study(name: str, folder: Path) -> Path:
    """Solve a study of the README's deck and draw it; the path written."""
    target = PICTURES / f"{name}.svg"
    deck = deck_path(TABLE[0], folder)
    if name == "wall_interact":
        assert main(["interact", str(deck), "--directions", "72", "-o", str(folder / "interact"), "-q"]) == 0
        return (folder / "interact" / "interact.svg").replace(target)
    sweep, out = folder / "door.yaml", folder / "door.out"
    text = readme_block("`door.yaml`, next to", DECKS / "sweeps" / README)
    assert text.count(SAMPLE[0]) == 1
    sweep.write_text(text.replace(*SAMPLE), encoding="utf-8")
    assert main(["sweep", str(sweep), "-q"]) == 0
    assert main(["sweep-plot", str(out), "--kind", "distribution", "-o", str(target), *SMALLER]) == 0
    return target


# --- experiments ----------------------------------------------------------------------------------------------------

EXPERIMENTS = "experiments"
"""name of the picture of what was measured against what is computed"""
OFF = 0.15
"""share of what was measured by which the shaded band is off"""
LOADS = (12.0, 350.0)
TICKS = (20, 50, 100, 200)
"""ends and ticks of both axes, kN"""


def make_experiments(folder: Path) -> Path:
    """Solve the decks of the experiments and draw computed over measured loads; the path written."""
    target = PICTURES / f"{EXPERIMENTS}.svg"
    with open_page(target, PictureOptions(size=(800, 820))) as page:
        band = f"band: {OFF:.0%} off what was measured"
        above = add_words(page, ["Load at collapse, kN; of walls with their vertical load", band])
        axes = page.figure.add_axes((0.1, 0.12, 0.87, 0.87 - above))
        ends = np.array(LOADS)
        axes.fill_between(ends, (1 - OFF) * ends, (1 + OFF) * ends, color="#E4E4E4", linewidth=0)
        axes.plot(ends, ends, color=INK, linewidth=1.0)
        marks = [_measured(axes, deck, folder, *style) for deck, style in zip(MEASURED, STYLES, strict=True)]
        axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends, aspect="equal")
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_ticks(TICKS, [str(tick) for tick in TICKS])
            axis.set_ticks([], minor=True)
        axes.set_xlabel("measured, each test", fontsize=0.9 * page.letter, color=INK)
        axes.set_ylabel("computed", fontsize=0.9 * page.letter, color=INK)
        axes.tick_params(labelsize=0.85 * page.letter, colors=INK)
        add_legend(page, marks)
    return target


STYLES = (("o", CASES[0], (9, -15)), ("s", VERMILION, (12, -2)), ("D", CASES[2], (0, 0)), ("v", CASES[3], (0, 0)))
"""marker and colour of each deck, and where its words begin"""


def _measured(axes: Any, deck: str, folder: Path, marker: str, colour: str, words_at: tuple[int, int]) -> Any:
    """Every test of a deck at the load that is computed, of walls with the vertical one; the mark of the legend."""
    path, out = DECKS / "benchmarks" / "experiments" / f"{deck}.yaml", folder / deck
    assert main(["run", str(path), "-o", str(out), "--set", "output.vtu=false", "-q"]) == 0
    computed = {case.load_case.name: case.solution.mechanics for case in read_results_hdf5(out / f"{deck}.h5").cases}
    for case, tests in MEASURED[deck].items():
        mechanics = computed[case]
        assert mechanics is not None
        (mark,) = axes.plot(
            tests, [mechanics.load_factor] * len(tests), marker, color=colour, markersize=8, label=NAMES[deck]
        )
        if (words := words_of(case)).isdigit():
            last = (max(tests), mechanics.load_factor)
            axes.annotate(f"{words} kN", last, words_at, textcoords="offset points", color=INK)
    return mark


# --- sweeps ---------------------------------------------------------------------------------------------------------

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


SWEEPS = (
    SweepPicture("arch_friction_thickness", None),
    SweepPicture("house_directions", ("--kind", "curve")),
    SweepPicture("wall_opening", ("--kind", "curve", "--result", "in_plane.load_factor", "--by", "width")),
    SweepPicture("rubble_wall", ("--kind", "distribution")),
    SweepPicture("dome_workmanship", ("--kind", "distribution")),
    SweepPicture("prestwood", ("--kind", "curve")),
    SweepPicture("block_records", ("--kind", "fragility")),
)


def make_sweep_picture(picture: SweepPicture, folder: Path) -> Path:
    """Solve the sweep and draw it; the path written."""
    out = folder / picture.sweep
    status = main(["sweep", str(sweep_path(picture.sweep)), "-o", str(out), "-q"])
    assert status == 0, f"{picture.sweep}: mbla sweep ended with {status}"
    target = PICTURES / f"sweep_{picture.sweep}.png"
    if picture.plot is None:
        draw_arch_map(target, read_sweep_table(out))
    else:
        size = "x".join(str(side) for side in SIZE)
        assert main(["sweep-plot", str(out), "-o", str(target), "--size", size, *picture.plot]) == 0
    return with_palette(target)


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


def make_pictures(names: list[str]) -> None:
    """The pictures of those names, all without any."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        makers: dict[str, Callable[[], object]] = {each.name: partial(make_picture, each, folder) for each in TABLE}
        makers |= {study: partial(make_study, study, folder) for study in STUDIES}
        makers[EXPERIMENTS] = partial(make_experiments, folder)
        makers |= {f"sweep_{each.sweep}": partial(make_sweep_picture, each, folder) for each in SWEEPS}
        unknown = sorted(set(names) - set(makers))
        if unknown:
            raise SystemExit(f"no picture {', '.join(unknown)}; there are {', '.join(makers)}")
        for chosen in names or makers:
            makers[chosen]()


if __name__ == "__main__":
    make_pictures(sys.argv[1:])
