"""``mbla interact``: a sweep over an angle, its diagram and what the points prove together."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from mbla.deck import Deck
from mbla.process.run_options import RunOptions
from mbla.results.listing.text import number, percent, sentence, table
from mbla.results.pictures.diagrams import dress, open_diagrams
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, GHOST, INK, SKY
from mbla.results.record.json_values import as_json
from mbla.results.record.objects import Key
from mbla.sweeps.answers import Answer
from mbla.sweeps.command import Finished, Prepared, Report, run_sweep
from mbla.sweeps.engine.child import PointRunner
from mbla.sweeps.engine.engine import EngineOptions
from mbla.sweeps.interaction.domain import Domain, RayPoints, corners_of, domain_of, points_of
from mbla.sweeps.interaction.question import DIRECTION, TWO_LOADS, InteractionQuestion, question_of
from mbla.sweeps.pictures.sheet import count_words, draw_marks, mark_handles
from mbla.sweeps.plan import Task
from mbla.sweeps.studies import heading_lines, prepared_study, study_options, study_plan
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable
from mbla.sweeps.tables.write_tables import StudyResult

RESULTS = (
    *("status", "verified", "load_factor", "associative_load_factor", "static_bound", "kinematic_bound"),
    *("standing.verdict", "mechanism.class"),
)
"""columns, in addition to the powers of a pair of loads"""
AZIMUTH = SweepColumn("azimuth", "degree", "azimuth of the live load", "float", "azimuth", "azimuth")
ANGLE = SweepColumn("angle", "degree", "of two loads: A times cosine, B times sine", "float", "parameter", "angle")
GRAVEST_FIRST = (1, 6, 7, 3, 4)
"""exit codes of points that have no verified answer"""
CONTRADICTION, NO_FACTOR = 4, 5
SAME = 1e-5
"""relative difference up to which load factors are one: to which a solved one may be uncertain"""
MOST_ANGLES = 4
"""angles that are named of one extreme"""


def interact(deck: Deck, run: RunOptions, options: Any, report: Report | None) -> Finished:
    """Solve the points of a diagram and write its files; ``options`` as of ``question_of``, and ``jobs``.

    Raises DeckError, UsageError: the deck is not valid, or cannot be asked this; nothing is written then. Raises
    FileError: files are in the way or cannot be written.
    """
    chosen = study_options(deck, run, "_".join(("interact", *(options.loads or ()))), EngineOptions(options.jobs))
    assert chosen.folder is not None
    question = question_of(deck, options, lambda: factor_ratio(deck, run, options.loads))
    return run_sweep(prepared_diagram(deck, run, question, chosen.folder), chosen, report)


def prepared_diagram(deck: Deck, run: RunOptions, question: InteractionQuestion, folder: Path) -> Prepared:
    """The sweep over the angle of a question."""
    results = (*RESULTS, *(f"powers.{name}" for name in question.pair))
    plan = study_plan(deck, (*run.overrides, *question.fixed), (question.case,), results, folder)
    column = AZIMUTH if question.kind == DIRECTION else ANGLE
    return prepared_study(deck, "interact", plan, column, question.settings, partial(study_result_of, deck, question))


def factor_ratio(deck: Deck, run: RunOptions, pair: Sequence[str]) -> float:
    """Load factor of the second load alone over that of the first; 1 where either has none."""
    results = PointRunner(study_plan(deck, run.overrides, pair, ("load_factor",), Path())).run(Task("", 0, {})).results
    first, second = (results.get(f"{name}.load_factor") or 0.0 for name in pair)
    usable = isinstance(first, float) and isinstance(second, float) and min(first, second) > 0
    return second / first if usable else 1.0  # type: ignore[operator]


def study_result_of(deck: Deck, question: InteractionQuestion, table: SweepTable) -> StudyResult:
    """What follows from the points."""
    points = points_of(table, question)
    domain = domain_of(points, question)
    words = [question.words, *_factor_words(question, points), *_domain_words(question, points, domain)]
    factors = []
    for axis, name, places in zip(question.axes, question.names, points.places.T, strict=True):
        factors.append((SweepColumn(f"factor_{name}", "", f"{axis} at collapse", "float", "result"), places))
    lines = [*heading_lines(deck), *sentence(question.words), "", *_point_table(question, points, table), ""]
    for text in (*words[1:], *_reasons(question, table)):
        lines += sentence(text)
    rule = deck.analysis.flow_rule.replace("_", "-")
    return StudyResult(
        columns=factors,
        record={"interaction": _record(question, points, domain, words)},
        pictures={"interact": partial(draw_diagram, [deck.title, *words[:2]], rule, question, points, domain)},
        lines=lines,
        exit_code=_exit_code(table, points, domain),
    )


def _exit_code(table: SweepTable, points: RayPoints, domain: Domain | None) -> int:
    """The worst of points without a verified answer, 4 where bounds contradict each other, 5 without any load factor.

    A direction in which the load never brings collapse is an answer, as a position of a travelling load is.
    """
    codes = set(table["exit_code"][table["state"] == "failed"].tolist())
    if codes:
        return next((code for code in GRAVEST_FIRST if code in codes), max(codes))
    if domain is not None and domain.crossed:
        return CONTRADICTION
    return 0 if points.factors.good.any() else NO_FACTOR


def _extremes(question: InteractionQuestion, points: RayPoints) -> dict[str, dict[str, Any]]:
    """The least and the greatest of the verified load factors, with their angles."""
    if not points.factors.good.any():
        return {}
    ends = {"least": float(np.nanmin(points.known)), "greatest": float(np.nanmax(points.known))}
    near = {word: np.abs(points.known - end) <= SAME * abs(end) for word, end in ends.items()}
    angles = {word: np.array(question.angles)[own].tolist() for word, own in near.items()}
    return {word: {"load_factor": end, "angles": angles[word]} for word, end in ends.items()}


# --- words ------------------------------------------------------------------------------------------------------------


def _point_table(question: InteractionQuestion, points: RayPoints, results: SweepTable) -> list[str]:
    """A line for each point; in capitals where it has no verified answer, which may be that there is no factor."""
    unsure = np.isin(points.factors.answer, (Answer.UNVERIFIED, Answer.FAILED, Answer.NOT_RUN)).tolist()
    rows = zip(results["status"].tolist(), results["state"].tolist(), unsure, strict=True)
    status = [str.upper(text or state) if doubt else text or state for text, state, doubt in rows]
    both = question.kind == TWO_LOADS
    figures = {"load factor": points.known, **(dict(zip(question.axes, points.places.T, strict=True)) if both else {})}
    figures |= {"static bound": points.static, "kinem. bound": points.kinematic}
    columns: dict[str, Sequence[str]] = {
        "angle" if both else "azimuth": [f"{angle:.6g}" for angle in question.angles],
        **{name: [number(value) for value in values.tolist()] for name, values in figures.items()},
        "mechanism": [text or "" for text in results["mechanism.class"].tolist()],
        "status": [text.replace("_", " ") for text in status],
    }
    return table(list(columns), list(zip(*columns.values(), strict=True)), left=0)


def _factor_words(question: InteractionQuestion, points: RayPoints) -> list[str]:
    """The extremes; of two loads each by itself, as the least factor over their shares says nothing."""
    if question.kind == TWO_LOADS:
        alone = [
            f"{name} alone: {number(float(points.known[row]))}"
            for axis, name in enumerate(question.names)
            for row in np.flatnonzero((points.ways[:, axis] == 1.0) & points.factors.good)
        ]
        return ["; ".join(alone)] if alone else []
    ends = _extremes(question, points)
    return [
        f"{word} load factor: {number(end['load_factor'])} at {_angles(end['angles'])}" for word, end in ends.items()
    ]


def _angles(angles: Sequence[float]) -> str:
    """``0, 90, 180, 270 degrees``; some of many."""
    more = f" and {len(angles) - MOST_ANGLES} more" if len(angles) > MOST_ANGLES else ""
    return f"{', '.join(f'{angle:.6g}' for angle in angles[:MOST_ANGLES])}{more} degrees"


def _domain_words(question: InteractionQuestion, points: RayPoints, domain: Domain | None) -> list[str]:
    """What follows from the bounds of all points for the domain of associative flow."""
    if not question.pair:
        return ["no safe domain is drawn: with vertical parts the loads do not lie in one plane through the dead load"]
    if domain is None:
        return []
    if domain.crossed:
        return [
            "ERROR OF VERIFICATION: the safe domain of associative flow is convex, yet a point that is proved safe "
            f"lies beyond the bound of a mechanism by {domain.crossed:.1e} of it: please report it with the deck"
        ]
    words = [
        "the safe domain of associative flow is convex, and so are the points within their bounds; "
        + _gap_words(question, points, domain)
    ]
    if domain.everywhere is not None:
        words.append(f"at angles between the points too, associative flow carries at least {number(domain.everywhere)}")
    return words


def _gap_words(question: InteractionQuestion, points: RayPoints, domain: Domain) -> str:
    """What safe points and mechanisms leave open between them, or why that is no share of an area."""
    if not np.isnan(domain.gap):
        return f"what those leave open between safe points and mechanisms is {percent(domain.gap)} % of its area"
    free = [question.angles[row] for row in np.flatnonzero(points.factors.of(Answer.UNBOUNDED))]
    if free:
        return f"it is unbounded at {_angles(free)}, so that it has no area of which a share could be left open"
    if domain.cut_off:
        return "the mechanisms found do not bound it on all sides, so that what they leave open is no share of an area"
    return "it has no area of which a share could be left open"


def _reasons(question: InteractionQuestion, results: SweepTable) -> list[str]:
    """Why points have no load factor, those of one reason together."""
    found: dict[str, list[float]] = {}
    for angle, reason in zip(question.angles, results["reason"].tolist(), strict=True):
        if reason:
            found.setdefault(reason, []).append(angle)
    return [f"at {_angles(angles)}: {reason}" for reason, angles in found.items()]


# --- record -----------------------------------------------------------------------------------------------------------


def _record(
    question: InteractionQuestion, points: RayPoints, domain: Domain | None, words: Sequence[str]
) -> dict[str, Any]:
    ends = _extremes(question, points)
    proved = None if domain is None else {
        "inner": corners_of(domain.inner) + 0.0,
        "outer": corners_of(domain.outer) + 0.0,
        "cut_off": domain.cut_off,
        "gap": domain.gap,
        "crossed": domain.crossed,
        "least_everywhere": domain.everywhere,
    }  # fmt: skip
    record = {
        "kind": question.kind,
        "case": question.case if question.kind == DIRECTION else None,
        "loads": list(question.pair) if question.kind == TWO_LOADS else None,
        "axes": question.axes,
        "closed": question.closed,
        "least": ends.get("least"),
        "greatest": ends.get("greatest"),
        "domain": proved,
        "words": words,
    }
    return dict(as_json(record))


INTERACT_RECORD: tuple[Key, ...] = tuple(
    Key(f"interaction.{path}", kind, words)
    for path, kind, words in (
        ("kind", "string", "`direction` or `two_loads`"),
        ("case", "string?", "load case whose live load is turned; null for two loads"),
        ("loads", "list?", "names of the two load cases; null for directions"),
        ("axes", "list", "what the two axes of the diagram are, in words"),
        ("closed", "boolean", "the angles go all around"),
        ("least", "object?", "least verified load factor, `load_factor`, and its `angles` in degrees"),
        ("greatest", "object?", "greatest verified load factor, `load_factor`, and its `angles` in degrees"),
        ("domain", "object?", "what the bounds of associative flow prove together; null where no point has bounds"),
        ("domain.inner", "list", "corners of the convex hull of safe points, factors along the axes"),
        ("domain.outer", "list", "corners of what the half-planes of all mechanisms leave"),
        ("domain.cut_off", "boolean", "the outer polygon ends at an edge that no mechanism draws"),
        ("domain.gap", "number?", "area between the polygons over that of the outer one; null where it is not bounded"),
        ("domain.crossed", "number", "relative distance of a safe point beyond a bound, which must not be; else 0"),
        ("domain.least_everywhere", "number?", "load factor carried at every angle, also between the points"),
        ("words", "list", "what was asked and what follows, in sentences"),
    )
)


# --- picture ----------------------------------------------------------------------------------------------------------

SIZE = (1200, 1240)
"""pixels: a square diagram, words above and a legend below"""
ROOM = 1.12
"""edge of the diagram over the farthest point"""


def draw_diagram(
    title: Sequence[str], rule: str, question: InteractionQuestion, points: RayPoints, domain: Domain | None, path: Path
) -> None:
    """Load factors in the plane of the two factors, joined where neighbours have one, and the proved polygons.

    What has no verified load factor is marked: at what it has, at the origin where it does not stand, else at the edge.
    Nothing is called safe on bounds that contradict each other.

    Raises UsageError where the extra for pictures is not installed, FileError where the file cannot be written.
    """
    mark = "ERROR OF VERIFICATION: bounds contradict each other" if domain is not None and domain.crossed else ""
    rays = [points.ways * values[:, None] for values in (points.factors.values, points.static, points.kinematic)]
    places = np.nan_to_num(np.vstack([np.zeros(2), *rays]))
    reach = ROOM * np.abs(places).max(axis=0)
    reach = np.where(reach > 1e-9 * reach.max(), reach, reach.max() or 1.0)
    reach = np.full(2, reach.max()) if question.kind == DIRECTION else reach
    low = np.where(places.min(axis=0) > -1e-9 * reach, -0.02 * reach, -reach)
    with open_diagrams(path, PictureOptions(size=SIZE), [*title, count_words(points.factors)], mark) as sheet:
        page, axes = sheet.page, sheet.frames(1)[0, 0]
        dress(page, axes, *question.axes)
        axes.set(xlim=(low[0], reach[0]), ylim=(low[1], reach[1]))
        axes.set_aspect("equal" if question.kind == DIRECTION else "auto")
        axes.axhline(0.0, color=GHOST, zorder=1)
        axes.axvline(0.0, color=GHOST, zorder=1)
        handles = []
        if domain is not None and domain.inner.area and not domain.crossed:
            axes.fill(*corners_of(domain.inner).T, facecolor=SKY, alpha=0.35, edgecolor="none", zorder=2)
            handles.append(page.box("safe by static bounds (associative flow)", facecolor=SKY, alpha=0.35))
        if domain is not None and domain.outer.area:
            axes.plot(*domain.outer.exterior.xy, color=BLUE, linestyle="--", zorder=3)
            handles.append(page.line("bound by mechanisms (associative flow)", color=BLUE, linestyle="--"))
        style = {"color": INK, "marker": "o", "markersize": 5.0 * page.scale}
        axes.plot(*(np.vstack([points.places, points.places[: question.closed]])).T, zorder=4, **style)
        handles.append(page.line(f"load factor, {rule} flow", **style))
        values = points.factors.values[:, None]
        at_edge = points.ways / (np.abs(points.ways) / reach).max(axis=1)[:, None]
        marked = np.where(np.isfinite(values), points.ways * values, at_edge)
        marked[points.factors.of(Answer.NO_EQUILIBRIUM)] = 0.0
        draw_marks(page, axes, marked[:, 0], marked[:, 1], points.factors.answer)
        sheet.add_legend([*handles, *mark_handles(page, points.factors.answer)])
