"""The diagram in words for a terminal: a line for each point, the extremes, what the bounds say together."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from mbla.results.listing.answers import status_name
from mbla.results.listing.text import counted, number, percent, sentence, table
from mbla.solution.solution import Status
from mbla.sweeps.design.directions import horizontal
from mbla.sweeps.interaction.domain import Domain, Extreme, Point, everywhere, extremes
from mbla.sweeps.interaction.question import DIRECTION, TWO_LOADS, Question
from mbla.sweeps.studies import NOT_SOLVED

if TYPE_CHECKING:
    from mbla.sweeps.interaction.study import Interaction

MOST_ANGLES = 4
"""angles that are named of one extreme"""
ASSOCIATIVE = "associative"


def study_lines(study: Interaction) -> list[str]:
    """Everything that the terminal shows."""
    lines = study.heading_lines
    for text in study.question.words:
        lines += sentence(text)
    lines += ["", *point_table(study), ""]
    for text in conclusions(study):
        lines += sentence(text)
    return lines


def point_table(study: Interaction) -> list[str]:
    """A line for each point; a column only where some point has something to say in it."""
    both = study.question.kind == TWO_LOADS
    head = ["angle" if both else "azimuth", "load factor"]
    head += list(study.question.axes) if both else []
    head += [*([] if study.about.flow_rule == ASSOCIATIVE else [ASSOCIATIVE]), "static bound", "kinem. bound"]
    words = [(mark_words(point), point.mechanism) for point in study.points]
    own = [name for column, name in ((1, "mechanism"), (0, "status")) if any(row[column] for row in words)]
    rows = []
    for point, (mark, mechanism) in zip(study.points, words, strict=True):
        row = [f"{point.angle:.6g}", number(point.load_factor)]
        row += [number(value) for value in point.at(point.load_factor)] if both else []
        row += [] if study.about.flow_rule == ASSOCIATIVE else [number(point.associative)]
        row += [number(point.static_bound), number(point.kinematic_bound)]
        rows.append([*row, *({"mechanism": mechanism, "status": mark}[name] for name in own)])
    return table([*head, *own], rows, left=0)


def mark_words(point: Point) -> str:
    """What is not plain of a point: capitals where it has no verified answer, as a run says it."""
    if not point.status:
        return "NOT SOLVED" if point.reason == NOT_SOLVED else "FAILED"
    name = status_name(Status(point.status))
    if not point.answered:
        return name.upper() if point.status != Status.SOLVED else "NOT VERIFIED"
    if point.status == Status.SOLVED:
        return "stands only by self-stress" if math.isnan(point.load_factor) else ""
    return name


def conclusions(study: Interaction) -> list[str]:
    """Extremes, the safe domain, points without an answer; a sentence each."""
    ends = extremes(study.points)
    if study.question.kind == TWO_LOADS:
        words = _alone_words(study)
    else:
        words = [] if ends is None else _extreme_words(study, *ends)
    words += domain_words(study)
    return [*words, *_unanswered(study.points), *_without_factor(study.points)]


def domain_words(study: Interaction) -> list[str]:
    """What the bounds of all points say of the domain of associative flow."""
    domain = study.domain
    if domain is None:
        if study.question.pair:
            return []
        return ["no safe domain is drawn: with vertical parts the loads do not lie in one plane through the dead load"]
    if domain.crossings:
        return [_crossing_words(domain)]
    text = "the safe domain of associative flow is convex, and so are the points within their bounds"
    if not math.isnan(domain.gap):
        text += (
            f"; between the hull of the safe points and the half-planes of {counted(len(domain.planes), 'mechanism')} "
            f"{percent(max(domain.gap, 0.0))} % of its area stay open"
        )
    least = everywhere(domain, closed=study.question.closed)
    words = [text]
    if least is not None:
        words.append(f"at angles between the points too, associative flow carries at least {number(least)}")
    if study.about.flow_rule != ASSOCIATIVE:
        words.append(f"load factors by {study.about.flow_rule} flow lie inside of it; their curve need not be convex")
    return words


def _crossing_words(domain: Domain) -> str:
    worst = domain.crossings[0]
    return (
        f"ERROR OF VERIFICATION: the safe domain of associative flow is convex, yet what is proved safe at "
        f"{worst.safe:.6g} degrees lies beyond the kinematic bound of {worst.angle:.6g} degrees by {worst.share:.1e} "
        f"of it ({counted(len(domain.crossings), 'crossing')}): a bound is wrong; please report it with the deck"
    )


def _extreme_words(study: Interaction, least: Extreme, greatest: Extreme) -> list[str]:
    known = sum(point.has_factor for point in study.points)
    which = "" if known == len(study.points) else f" of {counted(known, 'verified point')}"
    if len(least.angles) == known and known > 1:
        return [f"load factor {number(least.load_factor)} at every point{which}"]
    return [
        f"least load factor{which}: {number(least.load_factor)} at {angle_words(study.question, least.angles)}",
        f"greatest: {number(greatest.load_factor)} at {angle_words(study.question, greatest.angles)}",
    ]


def _alone_words(study: Interaction) -> list[str]:
    """Each of two loads by itself, where there is a point of it; the least factor over their shares says nothing."""
    words = []
    for point in study.points:
        x, y = horizontal(point.angle, 1.0)
        if point.has_factor and 0.0 in (x, y):
            name = study.question.short[int(x == 0.0)]
            words.append(f"{name} alone{', the other way' if x + y < 0.0 else ''}: {number(point.load_factor)}")
    return ["; ".join(words)] if words else []


def angle_words(question: Question, angles: Sequence[float]) -> str:
    """``azimuth 0, 90, 180 and 270 degrees``; some of many."""
    shown = [f"{angle:.6g}" for angle in angles[:MOST_ANGLES]]
    more = len(angles) - len(shown)
    last = f"{more} more" if more else shown.pop() if len(shown) > 1 else ""
    listed = ", ".join(shown) + (f" and {last}" if last else "")
    return f"{'azimuth ' if question.kind == DIRECTION else ''}{listed} degrees"


def _unanswered(points: Sequence[Point]) -> list[str]:
    """Points without a verified answer, those of one reason together."""
    reasons: dict[str, list[float]] = {}
    for point in points:
        if not point.answered:
            reasons.setdefault(point.reason or mark_words(point).lower(), []).append(point.angle)
    return [
        f"no verified answer at {', '.join(f'{angle:.6g}' for angle in angles)} degrees: {reason}"
        for reason, angles in reasons.items()
    ]


def _without_factor(points: Sequence[Point]) -> list[str]:
    """Points of which it is verified that they have no load factor."""
    found: dict[str, list[float]] = {}
    for point in points:
        if point.answered and not point.has_factor:
            found.setdefault(mark_words(point), []).append(point.angle)
    return [f"{mark} at {', '.join(f'{angle:.6g}' for angle in angles)} degrees" for mark, angles in found.items()]
