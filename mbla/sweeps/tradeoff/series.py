"""The positions of a travelling load as one: their time together, the least load factor, the worst residual."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from mbla.results.exit_status import EXIT_CODES, GRAVEST_FIRST
from mbla.solution.solution import Status
from mbla.sweeps.measure.measurement import NAN, Measurement


def joined(positions: Sequence[Measurement]) -> Measurement:
    """The measurement of a travelling load; its answer is that of the worst position, if every position has one.

    Positions that no multiple of the load brings down count as infinite where another is brought down.
    """
    factors = [_factor(each) for each in positions]
    known = [factor for factor in factors if not math.isnan(factor)]
    finite = len(known) == len(factors) and any(math.isfinite(factor) for factor in factors)
    worst = positions[factors.index(min(known))] if finite else _gravest(positions)
    harmless = [each for each in positions if not (finite and each.status == Status.UNBOUNDED)]
    gravest = _gravest(harmless or positions)
    return replace(
        worst,
        case=worst.series,
        series="",
        positions=len(positions),
        status=gravest.status,
        verdict="answer" if finite else gravest.verdict,
        answer=worst.answer if finite else NAN,
        reason="; ".join(dict.fromkeys(f"{each.case}: {each.reason}" for each in harmless if each.reason)),
        verified=all(each.verified for each in positions),
        accuracy=_largest([each.accuracy for each in positions]),
        residual=_largest([each.residual for each in positions]),
        memory=_largest([each.memory for each in positions]),
        dimension=max(each.dimension for each in positions),
        solvers=" ".join(dict.fromkeys(name for each in positions for name in each.solvers.split())),
        programs=sum(each.programs for each in positions),
        iterations=sum(each.iterations for each in positions),
        wall=sum(each.wall for each in positions),
        cpu=sum(each.cpu for each in positions),
        solver=sum(each.solver for each in positions),
    )


def _factor(measurement: Measurement) -> float:
    return math.inf if measurement.status == Status.UNBOUNDED else measurement.answer


def _gravest(positions: Sequence[Measurement]) -> Measurement:
    """The one whose status is the worst for the exit status; the first of them."""
    order = [*GRAVEST_FIRST, 0]
    return min(positions, key=lambda each: order.index(EXIT_CODES[Status(each.status)]))


def _largest(values: Sequence[float]) -> float:
    return max((value for value in values if not math.isnan(value)), default=NAN)
