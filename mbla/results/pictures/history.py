"""How a load factor was found: iterations of the cone programs with their residuals, and the path of joints."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.listing.sections.pushover import curve_words
from mbla.results.listing.text import number
from mbla.results.pictures.diagrams import dress, open_diagrams
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, GHOST, GREEN, INK, ORANGE, PURPLE, VERMILION, WARNING, Page
from mbla.results.pictures.scene import PictureScene
from mbla.results.results import CaseResult
from mbla.solution.thresholds import SOLVED_RESIDUAL

LINES = (
    ("gap", "gap", VERMILION, "-", "o"),
    ("primal_residual", "primal residual", GREEN, "--", "s"),
    ("dual_residual", "dual residual", PURPLE, ":", "^"),
)
"""residuals of an iteration: field, name, colour, line, marker"""


def draw_history(path: Path, scene: PictureScene, options: PictureOptions) -> None:
    """Write the iteration history of a case, and the path of elastic joints where one was followed.

    Raises as ``open_diagrams`` does.
    """
    solution = scene.case.solution
    count = 2 * bool(solution.iterations) + bool(solution.path)
    words = scene.words_of("history")[:2]
    words += ["no iterations to draw: the case was decided without a cone program"] * (not count)
    with open_diagrams(path, options, words, scene.mark_of("history")) as sheet:
        frames = sheet.frames(max(count, 1), columns=1)[:, 0]
        if solution.iterations:
            _draw_iterations(sheet.page, frames[0], frames[1], scene)
        if solution.path:
            _draw_path(sheet.page, frames[-1], scene)
        if not count:
            frames[0].set_axis_off()


def _draw_iterations(page: Page, factors: Any, residuals: Any, scene: PictureScene) -> None:
    """Load factor above, residuals below, over the iterations of all programs in their order."""
    dress(page, factors, "", "load factor")
    dress(page, residuals, "iteration", "relative residual")
    records = scene.case.solution.iterations
    place = np.arange(1, len(records) + 1)
    style = {"linewidth": 1.6 * page.scale, "markersize": 4 * page.scale}
    program = np.array([record.program for record in records])
    values = _of_finite([record.load_factor for record in records])
    values[np.isin(program, _without_load_factor(scene))] = np.nan
    for number_of in np.unique(program):
        own = program == number_of
        factors.plot(place[own], values[own], color=BLUE, marker=".", **style)
        for field, name, colour, line, marker in LINES:
            row = np.array([getattr(record, field) for record in records])[own]
            label = name if number_of == program[0] else None
            shown = np.where(np.isfinite(row) & (row > 0), row, np.nan)  # nothing has no logarithm
            residuals.plot(place[own], shown, line, color=colour, marker=marker, label=label, **style)
    mechanics = scene.mechanics
    _keep_to_the_middle(factors, values, np.nan if mechanics is None else mechanics.load_factor)
    residuals.set_yscale("log")
    residuals.legend(fontsize=page.small, framealpha=0.9, loc="upper right", ncols=3)
    _part_programs(page, (factors, residuals), program)
    if mechanics is not None:
        colour = INK if scene.is_result else WARNING
        label = f"{'load factor' if scene.is_result else 'not a result:'} {number(mechanics.load_factor)}"
        factors.axhline(mechanics.load_factor, color=colour, linewidth=page.scale, linestyle="--", label=label)
        factors.legend(fontsize=page.small, frameon=False, loc="best", labelcolor=colour)


def _of_finite(values: list[float]) -> FloatArray:
    array = np.array(values, dtype=float)
    return np.where(np.isfinite(array), array, np.nan)


def _without_load_factor(scene: PictureScene) -> list[int]:
    """Programs that look for something else, as a range of forces; what their iterations hold is no load factor."""
    return [record.program for record in scene.case.solution.programs if not np.isfinite(record.load_factor)]


def _keep_to_the_middle(axes: Any, values: FloatArray, answer: float) -> None:
    """First iterates are far off: show what lies around the last half of the values, and the answer, nan for none."""
    known = values[np.isfinite(values)]
    if not len(known):
        return
    late = np.append(known[len(known) // 2 :], [answer] * bool(np.isfinite(answer)))
    known = np.append(known, late)
    low, high = late.min(), late.max()
    room = max(2.0 * (high - low), 0.1 * max(abs(low), abs(high)), 1e-300)
    axes.set_ylim(max(low - room, known.min() - 0.05 * room), min(high + room, known.max() + 0.05 * room))


def _part_programs(page: Page, frames: tuple[Any, Any], program: Any) -> None:
    """A line where one program follows another."""
    for axes in frames:
        axes.set_xlim(0.5, len(program) + 0.5)
        for start in np.flatnonzero(np.diff(program)):
            axes.axvline(start + 1.5, color=GHOST, linewidth=0.8 * page.scale, zorder=0)


def _draw_path(page: Page, axes: Any, scene: PictureScene) -> None:
    """Load factor over the displacement of the path of elastic joints, from where joints slip; points open, sliding."""
    path = scene.case.solution.path
    steps = [point.displacement for point in path]
    style = {"linewidth": 1.8 * page.scale, "markersize": 3 * page.scale}
    dress(page, axes, "displacement of the path over the elastic one", "load factor")
    factors = [point.load_factor if point.balanced else np.nan for point in path]
    axes.plot(steps, factors, color=BLUE, marker="o", label="load factor", **style)
    slips = next((point for point in path if point.slide), None)
    if slips is not None:
        words = f"joints begin to slip: {number(slips.load_factor)}"
        axes.axvline(slips.displacement, color=GHOST, linewidth=page.scale, label=words, zorder=0)
    count = axes.twinx()
    count.plot(steps, [point.open for point in path], color=PURPLE, linestyle="--", label="open", **style)
    count.plot(steps, [point.slide for point in path], color=ORANGE, linestyle=":", label="sliding", **style)
    count.spines["top"].set_visible(False)
    count.tick_params(labelsize=page.small, colors=INK)
    count.set_ylabel("contact points", fontsize=page.small, color=INK)
    handles = [*axes.get_lines(), *count.get_lines()]
    axes.legend(handles=handles, fontsize=page.small, frameon=False, loc="lower right")


def _no_curve(case: CaseResult) -> str:
    """Why there is no capacity curve."""
    has = "no pushover" if case.load_case.has_load_factor else "modes of vibration alone"
    return f"no curve to draw: the load case has {has}"


def draw_curve(path: Path, scene: PictureScene, options: PictureOptions) -> None:
    """Write the capacity curve of a pushover, load factor over displacement; raises as ``open_diagrams`` does."""
    curve, words = scene.case.solution.further.pushover.curve, scene.words_of("curve")[:2]
    words.append(curve_words(scene.model, scene.case) or _no_curve(scene.case))
    sure = np.array([not row.step or row.residual <= SOLVED_RESIDUAL for row in curve])  # the first is the case's own
    mark = "" if sure.all() else f"NOT VERIFIED: {int((~sure).sum())} of {len(sure)} steps, hollow"
    with open_diagrams(path, options, words, mark) as sheet:
        page, axes = sheet.page, sheet.frames(1)[0, 0]
        if not curve:
            axes.set_axis_off()
            return
        units, question = scene.model.units, scene.case.load_case.question
        dress(page, axes, f"displacement of the {question.control} [{units.length}]", question.head(units))
        moved = np.array([row.displacement for row in curve])
        values = np.array([row.answer for row in curve])
        look = {"color": BLUE, "linestyle": "none", "marker": "o", "markersize": 3.5 * page.scale}
        axes.plot(moved, values, color=BLUE, linewidth=1.8 * page.scale)
        axes.plot(moved[sure], values[sure], **look)
        axes.plot(moved[~sure], values[~sure], markerfacecolor="white", **look)
        for row in np.flatnonzero([row.jumps for row in curve]).tolist():
            axes.plot(moved[row - 1 : row + 1], values[row - 1 : row + 1], color=ORANGE, linewidth=1.8 * page.scale)
        for row in np.flatnonzero([row.new_mechanism for row in curve]).tolist():
            axes.axvline(moved[row], color=GHOST, linewidth=0.8 * page.scale, zorder=0)
        axes.set_xlim(left=min(0.0, float(moved.min())))
        axes.set_ylim(bottom=min(0.0, float(values.min())))
