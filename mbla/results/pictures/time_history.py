"""A structure in time over time: displacements, acceleration of the base, energies, and response spectra."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.motion.signal import Signal
from mbla.model.motion.spectrum import DAMPING, response_spectrum
from mbla.model.motion.time_history import TimeHistory
from mbla.results.pictures.diagrams import Diagrams, dress, open_diagrams, tint
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLACK, BLUE, GHOST, GREEN, ORANGE, PURPLE, SKY, VERMILION, Page
from mbla.results.pictures.scene import PictureScene
from mbla.solution.time_history.history import TimeHistoryResult

ENERGIES = (
    ("base", "work of the base", BLACK, "-"),
    ("forces", "work of forces", BLACK, ":"),
    ("kinetic", "motion", BLUE, "-"),
    ("potential", "dead load", GREEN, "-"),
    ("contacts", "across joints", PURPLE, "--"),
    ("friction", "along joints", VERMILION, "--"),
    ("ties", "ties", ORANGE, "--"),
)
"""in the rows of steps: name, words, colour, line"""
SEEN = 1e-3
"""of the largest energy, from which another is drawn"""
TICKS = [part * 10.0**power for power in range(-6, 4) for part in (1.0, 2.0, 5.0)]
"""of spectra"""
MOST_LINES = 8
"""points that are drawn"""


def draw_time_history(path: Path, scene: PictureScene, options: PictureOptions) -> None:
    """Write the diagrams of a structure in time; raises as ``open_diagrams`` does."""
    found, asked = scene.case.solution.further.time_history, scene.case.load_case.time_history
    words = scene.words_of("curve")[:2]
    drawn = found.rows is not None and asked is not None
    words += [] if drawn else ["nothing to draw: the structure was not followed in time"]
    with open_diagrams(path, options, words, scene.mark_of("curve")) as sheet:
        frames = sheet.frames(4 if drawn else 1, columns=2 if drawn else 1)
        if not drawn or asked is None:
            frames[0, 0].set_axis_off()
            return
        _displacements(sheet, frames[0, 0], scene, asked, found)
        _accelerations(sheet, frames[1, 0], scene, asked)
        _energies(sheet, frames[0, 1], scene, found)
        _spectra(sheet, frames[1, 1], scene, asked, found)


def _line(page: Page, colour: Any, style: str = "-") -> dict[str, Any]:
    return {"color": colour, "linestyle": style, "linewidth": 1.4 * page.scale}


def _legend(page: Page, axes: Any) -> None:
    if axes.get_lines():
        place = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "borderaxespad": 0.2, "columnspacing": 1.2}
        axes.legend(fontsize=page.small, frameon=False, ncols=4, handlelength=1.6, **place)


def _displacements(
    sheet: Diagrams, axes: Any, scene: PictureScene, asked: TimeHistory, found: TimeHistoryResult
) -> None:
    """Of the points that the deck names, and of the block of the peak, along the axis that each moves most."""
    page, length = sheet.page, scene.model.units.length
    dress(page, axes, "time [s]", f"displacement relative to the base [{length}]")
    lines = list(_moved(scene, asked, found))
    for number, (name, times, moved) in enumerate(lines):
        axis = _most(moved)
        look = _line(page, BLUE if len(lines) == 1 else tint(page, number, len(lines)))
        axes.plot(times, moved[:, axis], label=f"{name}, {'xyz'[axis]}", **look)
    axes.axhline(0.0, color=GHOST, linewidth=0.8 * page.scale, zorder=0)
    if found.peaks is not None and found.peaks.first_to_fall >= 0:
        block = found.peaks.first_to_fall
        label = f"{scene.model.blocks.name(block)} falls"
        axes.axvline(float(found.peaks.falling[block]), color=VERMILION, linewidth=page.scale, label=label)
    _legend(page, axes)


def _moved(
    scene: PictureScene, asked: TimeHistory, found: TimeHistoryResult
) -> Iterator[tuple[str, FloatArray, FloatArray]]:
    """Name, times and displacements (m, 3) of what is drawn."""
    if found.histories is not None:
        for row, point in enumerate(asked.points[:MOST_LINES]):
            yield point.name, found.histories.times, found.histories.displacements[:, row]
    if found.frames is not None and found.peaks is not None:
        block, frames = found.peaks.block, found.frames
        if block not in [point.block for point in asked.points[:MOST_LINES]]:
            yield scene.model.blocks.name(block), frames.times, frames.shifts[:, block] - frames.shifts[0, block]


def _accelerations(sheet: Diagrams, axes: Any, scene: PictureScene, asked: TimeHistory) -> None:
    """Of the base, along each direction of a record or pulse; forces over time where nothing else drives it."""
    page, gravity = sheet.page, scene.model.units.standard_gravity
    if not asked.motions:
        dress(page, axes, "time [s]", f"force [{scene.model.units.force}]")
        for number, force in enumerate(asked.forces):
            look = _line(page, tint(page, number, len(asked.forces)))
            axes.plot(force.signal.times, force.signal.values, label=force.words[:40], **look)
        _legend(page, axes)
        return
    dress(page, axes, "time [s]", "acceleration of the base [g]")
    lengths = scene.case.solution.further.time_history.rows
    last = asked.duration if lengths is None else float(lengths.times[-1])
    for number, motion in enumerate(asked.motions):
        times, values = _until(motion.signal, last)
        look = _line(page, BLUE if len(asked.motions) == 1 else tint(page, number, len(asked.motions)))
        axes.plot(times, values / gravity, label=_along(motion.direction), **{**look, "linewidth": page.scale})
    axes.set_xlim(0.0, last)
    axes.axhline(0.0, color=GHOST, linewidth=0.8 * page.scale, zorder=0)
    _legend(page, axes)


def _until(signal: Signal, last: float) -> tuple[FloatArray, FloatArray]:
    """Samples to an instant, from the begin on and beyond the end, where it is nothing."""
    times = np.concatenate([[0.0], np.repeat(signal.times[:1], 1), signal.times, signal.times[-1:], [last]])
    values = np.concatenate([[0.0, 0.0], signal.values, [0.0, 0.0]])
    kept = times <= last
    return times[kept], values[kept]


def _along(direction: FloatArray) -> str:
    """``along x``; of another direction its components."""
    axis = int(np.abs(direction).argmax())
    if abs(abs(direction[axis]) - 1.0) < 1e-9:
        return f"along {'-' if direction[axis] < 0.0 else ''}{'xyz'[axis]}"
    return f"along ({', '.join(f'{part:.3g}' for part in direction)})"


def _energies(sheet: Diagrams, axes: Any, scene: PictureScene, found: TimeHistoryResult) -> None:
    """Those that are notable beside the largest."""
    page, units, rows = sheet.page, scene.model.units, found.rows
    assert rows is not None  # asked for where there are
    dress(page, axes, "time [s]", f"energy since rest [{units.force} {units.length}]")
    largest = max(float(np.abs(getattr(rows, name)).max()) for name, *_ in ENERGIES)
    for name, words, colour, style in ENERGIES:
        values = getattr(rows, name)
        if np.abs(values).max() > SEEN * largest:
            axes.plot(rows.times, values, label=words, **_line(page, colour, style))
    _legend(page, axes)


def _spectra(sheet: Diagrams, axes: Any, scene: PictureScene, asked: TimeHistory, found: TimeHistoryResult) -> None:
    """Of the base, and of points along the axes that the base moves along most; without motion, of their own most."""
    page, gravity = sheet.page, scene.model.units.standard_gravity
    dress(page, axes, "period [s]", f"spectral acceleration, {100.0 * DAMPING:g} % damping [g]")
    for number, motion in enumerate(asked.motions):
        spectrum = response_spectrum(motion.signal)
        look = _line(page, BLACK if len(asked.motions) == 1 else tint(page, number, len(asked.motions)))
        label = f"base {_along(motion.direction)}"
        axes.plot(spectrum.periods, spectrum.pseudo_acceleration / gravity, label=label, **look)
    if (spectra := found.spectra) is not None:
        along = sorted({int(np.abs(motion.direction).argmax()) for motion in asked.motions})
        lines = [(row, axis) for row in range(len(asked.points)) for axis in along or [_most(spectra.points[row])]]
        for number, (row, axis) in enumerate(lines[:MOST_LINES]):
            look = _line(page, SKY if len(lines) == 1 else tint(page, number, len(lines)), "--")
            label = f"{asked.points[row].name} along {'xyz'[axis]}"
            axes.plot(spectra.periods, spectra.points[row, :, axis] / gravity, label=label, **look)
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis, limits in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        axis.set_ticks([tick for tick in TICKS if limits[0] <= tick <= limits[1]])
        axis.set_ticks([], minor=True)
        axis.set_major_formatter("{x:g}")
    _legend(page, axes)


def _most(values: FloatArray) -> int:
    """The axis along which values (n, 3) are greatest."""
    return int(np.abs(values).max(axis=0).argmax())
