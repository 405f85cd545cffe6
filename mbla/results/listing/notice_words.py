"""Notices and warnings in the listing and on the terminal, each with the identifier that ``mbla explain`` takes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from mbla.errors import Notice
from mbla.results.listing.text import counted, heading, sentence
from mbla.results.outcome import case_notices, notices_of
from mbla.results.results import Results
from mbla.solution.solution import Status

CAUSES = ("isolated-blocks", "unsupported-parts")
"""Warnings that stand before the load cases: the verdicts on these follow from them."""
CAUSES_OF_A_FALL = ("near-misses",)
"""Those that do where a load case has no equilibrium: a contact that is missed may be all that it lacks."""
HINT = "`mbla explain ID` says what an identifier in brackets means and what to do."


def notice_lines(notices: Sequence[Notice], title: str = "Remarks") -> list[str]:
    """Every notice and warning with its identifier; nothing where there is none."""
    if not notices:
        return []
    return heading(title) + [line for notice in notices for line in sentence(str(notice))]


def warnings_of(results: Results) -> tuple[Notice, ...]:
    """Every warning: of deck, model, contacts and expectations, then of each load case."""
    return tuple(notice for notice in notices_of(results) if notice.severity == "warning")


def warning_lines(results: Results) -> list[str]:
    """All warnings once more, numbered, for the end of the listing."""
    warnings = warnings_of(results)
    if not warnings:
        return sentence("0 warnings")
    lines = sentence(f"{counted(len(warnings), 'warning')}:")
    for number, warning in enumerate(warnings, 1):
        lines += sentence(f"{number}. {warning}", "    ")
    return lines + sentence(HINT)


def cause_lines(results: Results) -> list[str]:
    """For the terminal: what has to be known before any figure, which follows from it."""
    causes = _causes(results)
    return [line for notice in results.notices if notice.identifier in causes for line in sentence(str(notice))]


def _causes(results: Results) -> tuple[str, ...]:
    falls = any(case.status is Status.NO_EQUILIBRIUM for case in results.cases)
    return (*CAUSES, *CAUSES_OF_A_FALL) if falls else CAUSES


def warning_summary(results: Results) -> list[str]:
    """For the terminal: in full what is told neither above nor in the words of its case, then all identifiers."""
    warnings = warnings_of(results)
    if not warnings:
        return []
    own = [notice for case in results.cases for notice in case_notices(case)]
    before = _causes(results)
    told = [notice for notice in warnings if notice.identifier not in before and (not notice.case or notice in own)]
    lines = [line for notice in told for line in sentence(str(notice))]
    counts = Counter(warning.identifier for warning in warnings)
    named = ", ".join(name if count == 1 else f"{name} ({count})" for name, count in counts.items())
    return lines + sentence(f"{counted(len(warnings), 'warning')}: {named}; mbla explain ID says more")
