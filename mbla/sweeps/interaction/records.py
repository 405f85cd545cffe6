"""The diagram as an object of JSON and as CSV; no number but finite ones, None or an empty cell where there is none."""

from __future__ import annotations

import csv
import io
from typing import Any

from mbla.arrays import FloatArray
from mbla.results.records.numbers import number
from mbla.sweeps.interaction.domain import Domain
from mbla.sweeps.interaction.extremes import Extreme, everywhere, extremes
from mbla.sweeps.interaction.point import Point
from mbla.sweeps.interaction.question import DIRECTION, TWO_LOADS
from mbla.sweeps.interaction.study import Study
from mbla.sweeps.interaction.words import conclusions


def study_json(study: Study, files: tuple[str, ...] = ()) -> dict[str, Any]:
    """The record that ``--json`` prints and ``STEM_interact.json`` holds."""
    ends, question = extremes(study.points), study.question
    return {
        "mbla": study.provenance["mbla"],
        "deck": study.deck,
        "title": study.title,
        "created": study.created,
        "exit_code": study.exit_code,
        "set": list(study.overrides),
        "flow_rule": study.flow_rule,
        "kind": question.kind,
        "case": question.case if question.kind == DIRECTION else None,
        "loads": list(question.pair) if question.kind == TWO_LOADS else None,
        "azimuth": _azimuth(study),
        "axes": list(question.axes),
        "closed": question.closed,
        "units": {"length": study.units.length, "force": study.units.force, "mass": study.units.mass},
        "points": [_point_json(study, point) for point in study.points],
        "least": None if ends is None else _extreme_json(ends[0]),
        "greatest": None if ends is None else _extreme_json(ends[1]),
        "domain": None if study.domain is None else _domain_json(study, study.domain),
        "words": [*question.words, *conclusions(study)],
        "provenance": study.provenance,
        "time": study.seconds,
        "files": list(files),
    }


def _azimuth(study: Study) -> str | None:
    if study.question.kind != DIRECTION:
        return None
    return "from +x towards +y" if study.question.absolute else "turned from the deck's directions"


def _point_json(study: Study, point: Point) -> dict[str, Any]:
    pair = study.question.pair
    return {
        "angle": point.angle,
        "status": point.status or None,
        "verified": point.answered,
        "exit_code": point.exit_code,
        "load_factor": number(point.load_factor),
        "factors": [number(value) for value in point.at(point.load_factor)],
        "associative_load_factor": number(point.associative),
        "static_bound": number(point.static_bound),
        "kinematic_bound": number(point.kinematic_bound),
        "half_plane": [point.powers[name] for name in pair] if pair and all(n in point.powers for n in pair) else None,
        "mechanism": point.mechanism or None,
        "reason": point.reason or None,
        "time": number(point.seconds),
    }


def _extreme_json(extreme: Extreme) -> dict[str, Any]:
    return {"load_factor": extreme.load_factor, "angles": list(extreme.angles)}


def _domain_json(study: Study, domain: Domain) -> dict[str, Any]:
    return {
        "flow_rule": "associative",
        "inner": _corners(domain.inner),
        "outer": _corners(domain.outer),
        "cut_off": domain.cut_off,
        "gap": number(domain.gap),
        "convex": not domain.crossings,
        "crossings": [{"angle": one.angle, "safe": one.safe, "share": number(one.share)} for one in domain.crossings],
        "least_everywhere": everywhere(domain, closed=study.question.closed),
    }


def _corners(polygon: FloatArray) -> list[list[float]]:
    return [[float(x) + 0.0, float(y) + 0.0] for x, y in polygon]


def study_csv(study: Study) -> str:
    """A line for each point; as mbla's other tables."""
    pair, short = study.question.pair, study.question.short
    stream = io.StringIO(newline="")
    writer = csv.writer(stream, lineterminator="\r\n")
    angle = "azimuth [degree]" if study.question.kind == DIRECTION else "angle [degree]"
    head = [angle, "load_factor", *(f"factor_{name}" for name in short), "associative_load_factor"]
    head += ["static_bound", "kinematic_bound", "status", "verified", "exit_code", "mechanism"]
    writer.writerow([*head, *(f"power_{name}" for name in short if pair), "reason", "time [s]"])
    for point in study.points:
        x, y = point.at(point.load_factor)
        figures = (point.load_factor, x, y, point.associative, point.static_bound, point.kinematic_bound)
        row: list[Any] = [point.angle, *map(number, figures), point.status, point.answered, point.exit_code]
        row += [point.mechanism, *(point.powers.get(name) for name in pair), point.reason, number(point.seconds)]
        writer.writerow(row)
    return stream.getvalue()
