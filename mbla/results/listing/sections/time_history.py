"""A structure in time, as sections: what it was moved by, what it did, energies with their balance, what it took."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.model.model import LoadCase, Model
from mbla.model.motion.time_history import BaseMotion, TimeHistory
from mbla.results.history_damage import HistoryDamage, history_damage
from mbla.results.history_figures import HistoryFigures, drift_of, history_figures
from mbla.results.listing.answers import case_status_words, status_name
from mbla.results.listing.blocks import MOST_ROWS, Block, Fact, apart, facts, paragraphs, table_of
from mbla.results.listing.history_verdict import peak_words
from mbla.results.listing.text import counted, full_sentence, number, small
from mbla.results.results import CaseResult
from mbla.solution.time_history.history import PointSpectra, RecordedHistories, TimeHistoryResult

ENERGIES = {
    "kinetic": "motion, relative to the base",
    "potential": "gained by the dead load",
    "contacts": "across joints: impacts, dashpots, stored",
    "friction": "along joints: sliding, stored",
    "ties": "ties",
    "base": "work of the base",
    "forces": "work of forces and turning loads",
    "numerical": "numerical: turns, changes of the step",
}
"""of a step, by the names in its rows: what was taken, then what was given"""
ACCELERATIONS = "Accelerations at an impact depend on the step and on how stiff joints are; displacements hardly do."
SEEN = 1e-6
"""of the greatest spectral acceleration, from which another is told"""
ROUNDING = 1e-9
"""of the largest energy, up to which one is zero; of times, up to which they are the same"""
GOES_ON = 0.01
"""of the peak velocity of the base after its motion, from which it is told"""


def history_sections(assembly: Assembly, case: CaseResult) -> dict[str, list[Block]]:
    """By the titles of the sections; nothing of a load case without."""
    found, asked, load_case = case.solution.further.time_history, case.load_case.time_history, case.load_case
    if asked is None:
        return {}
    model, figures = assembly.model.of_case(load_case), history_figures(found)
    if figures is None:
        return {"Time history": facts([Fact("status", status_name(case.status)), *_base(model, asked)])}
    return {
        "Time history": [
            *facts([Fact("status", case_status_words(case).lower()), *_base(model, asked)]),
            *facts([*_figures(assembly, case, figures), *_damage(model, history_damage(model, found))]),
            *apart(_points(model, asked, found.histories)),
            *apart(_spectra(model, asked, found.spectra)),
            *paragraphs(ACCELERATIONS if asked.points and found.histories is not None else ""),
            *apart(_joints(assembly, load_case, found)),
        ],
        "Energies": _energies(model, found, figures),
        "Steps": facts(_steps(model, asked, found, figures), caption="What it took, and what figures depend on"),
    }


def _base(model: Model, asked: TimeHistory) -> list[Fact]:
    """What moves the structure."""
    rows = [Fact("base moves by", motion.words, (_peaks_of(model, asked, motion),)) for motion in asked.motions]
    rows += [Fact("force", force.words) for force in asked.forces]
    return rows or [Fact("base moves by", "nothing: it is let go")]


def _peaks_of(model: Model, asked: TimeHistory, motion: BaseMotion) -> str:
    """Of the whole motion, whether less of it is followed, and how fast the base goes on after it."""
    length, gravity = model.units.length, model.units.standard_gravity
    end = float(motion.signal.times[-1])
    left = abs(float(motion.signal.integral(end)))
    then = ""
    if asked.duration < end * (1.0 - ROUNDING):
        then = f": of all of it, which is cut at {asked.duration:.4g} s"
    elif asked.duration > end * (1.0 + ROUNDING) and left > GOES_ON * motion.peak_velocity:
        then = f"; after it the base goes on at {left:.3g} {length}/s"
    return (
        f"at most {motion.peak_acceleration / gravity:.3g} g, {motion.peak_velocity:.3g} {length}/s, "
        f"{motion.peak_displacement:.3g} {length}{then}"
    )


def _figures(assembly: Assembly, case: CaseResult, figures: HistoryFigures) -> list[Fact]:
    """Peak, what stays, what falls, what joints do at most."""
    model, found = assembly.model.of_case(case.load_case), case.solution.further.time_history
    length, name = model.units.length, model.blocks.name
    peak = f"{peak_words(model, figures)} at {figures.peak_time:.4g} s, {name(figures.peak_block)}"
    drift = drift_of(assembly, case.load_case, figures)
    rows = [Fact("ends", f"at {figures.lasted:.4g} s: {found.end}"), Fact("peak displacement", peak)]
    if not np.isnan(drift):
        rows.append(Fact("drift", f"{100.0 * drift:.3g} % of its height above the lowest support"))
    stays = f"{figures.residual:.3g} {length}, {name(figures.residual_block)}"
    stays += f" (+- {figures.residual_uncertainty:.1g})"
    if figures.falls < 0:
        rows.append(Fact("residual displacement", stays))
    else:
        fallen = f"{name(figures.falls)} at {figures.fall_time:.4g} s; {counted(figures.fallen, 'block')} in all"
        rows.append(Fact("first to fall", fallen))
    for what, value, interface in (
        ("largest opening", figures.opening, figures.opening_interface),
        ("largest slip", figures.slip, figures.slip_interface),
    ):
        if interface >= 0:
            where = f", {_pair(assembly, interface)}" if value > 0.0 else ""
            rows.append(Fact(what, f"{value:.3g} {length}{where}"))
    return rows


def _damage(model: Model, damage: HistoryDamage) -> list[Fact]:
    """Ties that broke and yielded, and the joint that crushed most."""
    names, rows = model.ties.names, []
    if damage.broken:
        rows.append(Fact("ties that broke", _few([f"{names[tie]}, at about {at:.4g} s" for tie, at in damage.broken])))
    if damage.yielded:
        rows.append(Fact("ties that yielded", _few([names[tie] for tie in damage.yielded])))
    if not np.isnan(damage.crushing):
        a, b = damage.bodies
        where = f", {model.body_name(a)} and {model.body_name(b)}" if damage.crushing > 0.0 else ""
        rows.append(Fact("greatest crushing of a joint", f"{damage.crushing:.3g} {model.units.length}{where}"))
    return rows


def _few(told: list[str]) -> str:
    """The first of many."""
    rest = len(told) - MOST_ROWS
    return "; ".join(told[:MOST_ROWS]) + (f"; {rest} more" if rest > 0 else "")


def _pair(assembly: Assembly, interface: int) -> str:
    """``wall[3] and wall[7]``."""
    a, b = assembly.contacts.bodies[interface].tolist()
    return f"{assembly.model.body_name(a)} and {assembly.model.body_name(b)}"


def _points(model: Model, asked: TimeHistory, found: RecordedHistories | None) -> list[Block]:
    """Peaks of the points that the deck names, relative and absolute."""
    if found is None or not asked.points:
        return []
    length, gravity = model.units.length, model.units.standard_gravity
    rows = []
    for row, point in enumerate(asked.points[:MOST_ROWS]):
        moved = np.linalg.norm(found.displacements[:, row], axis=1)
        speed = np.linalg.norm(found.velocities[:, row], axis=1).max()
        pushed = np.linalg.norm(found.accelerations[:, row], axis=1).max() / gravity
        at, last = int(moved.argmax()), float(moved[-1])
        ways = [f"{value:.3g}" for value in np.abs(found.displacements[:, row]).max(axis=0)]
        figures = [f"{moved[at]:.3g}", f"{found.times[at]:.4g}", *ways, f"{speed:.3g}", f"{pushed:.3g}", f"{last:.3g}"]
        rows.append([point.name, model.blocks.name(point.block), *figures])
    head = ["point", "block", f"peak [{length}]", "at [s]", "x", "y", "z", f"speed [{length}/s]"]
    head += ["absolute acceleration [g]", "at the end"]
    caption = "Peaks of points, displacement and speed relative to the base"
    return table_of(head, rows, left=2, caption=caption, total=len(asked.points))


def _spectra(model: Model, asked: TimeHistory, found: PointSpectra | None) -> list[Block]:
    """Greatest spectral acceleration along each axis, and its period: of the base, and of points."""
    if found is None:
        return []
    names = ["base", *(point.name for point in asked.points[:MOST_ROWS])]
    values = np.concatenate([found.base[None], found.points[:MOST_ROWS]]) / model.units.standard_gravity
    largest, rows = float(values.max()), []
    for name, of_one in zip(names, values, strict=True):
        at = of_one.argmax(axis=0)
        cells = [
            f"{of_one[row, axis]:.3g} at {found.periods[row]:.3g} s" if of_one[row, axis] > SEEN * largest else "0"
            for axis, row in enumerate(at.tolist())
        ]
        rows.append([name, *cells])
    head = ["point", *(f"along {axis} [g]" for axis in "xyz")]
    caption = f"Peaks of response spectra, {100.0 * found.damping:g} % damping, periods "
    caption += f"from {found.periods[0]:.3g} to {found.periods[-1]:.3g} s"
    return table_of(head, rows, caption=caption, total=1 + len(asked.points))


def _joints(assembly: Assembly, case: LoadCase, found: TimeHistoryResult) -> list[Block]:
    """Greatest opening and slip by joint law, and where."""
    contacts, peaks = assembly.contacts, found.peaks
    if peaks is None or not len(contacts):
        return []
    length, opened, slipped = assembly.model.units.length, list[list[str]](), list[list[str]]()
    for law, name in enumerate(contacts.joint_names):
        own = np.flatnonzero(contacts.joints == law)
        if not len(own):
            continue
        opens, slips = (int(own[values[own].argmax()]) for values in (peaks.openings, peaks.slips))
        opened.append([name, str(len(own)), f"{peaks.openings[opens]:.3g}", _pair(assembly, opens)])
        slipped.append([name, str(len(own)), f"{peaks.slips[slips]:.3g}", _pair(assembly, slips)])
    tables = []
    for what, rows in (("opening", opened), ("slip", slipped)):
        head = ["joint law", "interfaces", f"{what} [{length}]", "between"]
        tables += table_of(head, rows[:MOST_ROWS], caption=f"Greatest {what} by joint law", total=len(rows))
    return tables


def _energies(model: Model, found: TimeHistoryResult, figures: HistoryFigures) -> list[Block]:
    """At most and at the end, with their balance."""
    rows = found.rows
    assert rows is not None  # there are figures
    every = {words: getattr(rows, name) for name, words in ENERGIES.items()}
    least = ROUNDING * max(float(np.abs(values).max()) for values in every.values())
    shown = {words: values for words, values in every.items() if np.abs(values).max() > least}
    cells = [[words, *_most_and_last(values, least)] for words, values in shown.items()]
    unit = f"{model.units.force} {model.units.length}"
    says = (
        f"They balance to {small(figures.balance)} of the largest: motion, dead load, joints and ties take what base "
    )
    says += "and forces give."
    stored = f"At the end joints store {float(rows.elastic[-1]):.3g} {unit} of it."
    head = ["energy", f"largest [{unit}]", "at the end"]
    return [*table_of(head, cells, caption="Energies since rest"), *paragraphs(says, stored)]


def _most_and_last(values: FloatArray, least: float) -> tuple[str, str]:
    """The value farthest from zero and the last one; what is less than rounding of the largest is zero."""
    both = float(values[int(np.abs(values).argmax())]), float(values[-1])
    most, last = (f"{value:.4g}" if abs(value) > least else "0" for value in both)
    return most, last


def _steps(model: Model, asked: TimeHistory, found: TimeHistoryResult, figures: HistoryFigures) -> list[Fact]:
    """What it took, and what figures depend on."""
    units, steps = model.units, max(figures.steps, 1)
    across, along = found.stiffness
    made = f"{figures.steps} of {asked.step:g} s; {figures.halved} halved, {figures.small_steps} small ones in all"
    missed = f"{figures.missed} ({100.0 * figures.missed / steps:.2g} %)" if figures.missed else "none"
    rows = [
        Fact("steps", made),
        Fact("steps that did not converge", missed),
        Fact("factorisations", f"{figures.factorisations}, {figures.factorisations / steps:.3g} a step"),
        Fact("searches for contacts", str(found.searches)),
        Fact("time", f"{number(round(found.seconds, 2))} s"),
        Fact("stiffness of joints", f"{across:.3g} {units.force}/{units.length}3 across, {along:.3g} along (mean)"),
        Fact("give under the dead load", f"{found.sag:.2g} {units.length}"),
    ]
    if not np.isnan(found.period):
        damping = f"{asked.damping:.3g} asked, {found.damping:.3g} with that of the step"
        if asked.contact_damping > 0.0:
            damping += f"; dashpots of contact points (contact_damping: {asked.contact_damping:g}) come on top"
        rows += [Fact("first period", f"{found.period:.4g} s"), Fact("damping at it", damping)]
    half = found.half
    if half is None:
        why = "the run ended before it" if asked.check else "check: true does it, and says how far figures differ"
        rows.append(Fact("with half of the step", f"not followed: {why}"))
    else:
        says = f"peak {half.peak:.3g} {units.length} at {half.time:.4g} s ({100.0 * figures.half_step:.2g} % off), "
        says += f"residual {half.residual:.2g} {units.length}"
        rows.append(Fact("with half of the step", says, () if half.end is found.end else (full_sentence(half.end),)))
    return rows
