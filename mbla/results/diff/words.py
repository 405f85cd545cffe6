"""A comparison in words."""

from __future__ import annotations

import math

from mbla.results.diff.cases import CaseComparison, ComparedFigure
from mbla.results.diff.comparison import ResultComparison
from mbla.results.listing.answers import status_name, status_words
from mbla.results.listing.text import counted, heading, number, sentence, small, table

MOST_LINES = 60
"""lines of the diff of the decks that are shown; JSON has all"""

ROUNDING = 1e-8
"""relative difference that is shown as none"""


def comparison_text(comparison: ResultComparison, names: tuple[str, str]) -> str:
    """What differs, at most 100 columns wide; ``names`` are those of the files."""
    lines = [
        f"{letter}  {file}   {deck}, {created}"
        for letter, file, deck, created in zip("AB", names, comparison.decks, comparison.created, strict=True)
    ]
    lines += _deck(comparison)
    for case in comparison.cases:
        lines += _case(case)
    lines += [*heading("Summary"), *_summary(comparison)]
    return "\n".join(line.rstrip() for line in lines) + "\n"


def _deck(comparison: ResultComparison) -> list[str]:
    lines = heading("Deck")
    shown = comparison.deck_diff[:MOST_LINES]
    lines += [f"  {line}" for line in shown] if shown else sentence("The texts are the same.")
    if len(comparison.deck_diff) > len(shown):
        lines += sentence(f"and {counted(len(comparison.deck_diff) - len(shown), 'more line')}; --json has them all")
    for letter, overrides in zip("AB", comparison.overrides, strict=True):
        if comparison.overrides[0] != comparison.overrides[1]:
            lines += sentence(f"changed by the user in {letter}: {', '.join(overrides) or 'nothing'}")
    return lines


def _figures(figures: tuple[ComparedFigure, ...]) -> list[str]:
    if not figures:
        return []
    rows = [
        [
            _name(figure) + (f" [{figure.unit}]" if figure.unit else ""),
            *map(number, figure.values),
            _percent(figure),
            _verdict(figure),
        ]
        for figure in figures
    ]
    return table(["", "A", "B", "difference", ""], rows)


def _name(figure: ComparedFigure) -> str:
    return figure.name.replace("_", " ")


def _percent(figure: ComparedFigure) -> str:
    if math.isnan(figure.difference):
        return "-"
    return "0" if abs(figure.difference) <= ROUNDING else f"{100 * figure.difference:+.3g} %"


def _verdict(figure: ComparedFigure) -> str:
    if figure.same:
        return ""
    if math.isnan(figure.difference):
        return "in A only" if math.isnan(figure.values[1]) else "in B only"
    return "differs"


def _case(case: CaseComparison) -> list[str]:
    lines = heading(f"Load case {case.name}")
    statuses = [status_words(status) for status in case.status]
    if statuses[0] == statuses[1]:
        lines += sentence(f"status {statuses[0]} in both")
    else:
        lines += sentence(f"STATUS DIFFERS: {statuses[0]} in A, {statuses[1]} in B")
    if case.flow_rule[0] != case.flow_rule[1]:
        lines += sentence(f"flow rule {case.flow_rule[0]} in A, {case.flow_rule[1]} in B")
    lines += _figures((*case.answers, *case.figures))
    lines += sentence(f"answers count as the same within {small(case.answers[0].tolerance)}")
    return lines + _motion(case)


def _motion(case: CaseComparison) -> list[str]:
    found = case.mechanism
    if found.angle is None:
        return sentence(f"mechanisms not compared: {found.compared}")
    return sentence(f"angle between the two {found.compared}s: {found.angle:.3g} degrees")


def _summary(comparison: ResultComparison) -> list[str]:
    lines = []
    for letter, names in zip("AB", comparison.only, strict=True):
        lines += [line for name in names for line in sentence(f"{name}: in {letter} only")]
    for case in comparison.cases:
        answer = case.answers[0]
        values = "{} {} in A, {} in B".format(_name(answer), *map(number, answer.values))
        a, b = (status_name(status) for status in case.status)
        differs = "DIFFERS" if a == b else f"DIFFERS, {a} in A, {b} in B"
        lines += sentence(f"{case.name}: {differs if case.differs else f'the same, {a}'}; {values}")
    total = len(comparison.cases) + len(comparison.only[0]) + len(comparison.only[1])
    verb = "differs" if comparison.differing == 1 else "differ"
    return lines + sentence(f"{comparison.differing} of {counted(total, 'load case')} {verb} in status or answer")
