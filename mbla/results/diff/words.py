"""A comparison in words."""

from __future__ import annotations

import math

from mbla.results.diff.cases import CaseComparison, Figure
from mbla.results.diff.comparison import Comparison, ModelComparison
from mbla.results.listing.answers import status_name, status_words
from mbla.results.listing.text import counted, heading, number, sentence, small, table, vector

MOST_NAMED = 8
"""names of a list, interfaces and supports that are shown; JSON has all"""
MOST_LINES = 60
"""lines of the diff of the decks that are shown; JSON has all"""

ROUNDING = 1e-8
"""relative difference that is shown as none"""


def comparison_text(comparison: Comparison, names: tuple[str, str]) -> str:
    """What differs, at most 100 columns wide; ``names`` are those of the files."""
    lines = [
        f"{letter}  {file}   {deck}, {created}"
        for letter, file, deck, created in zip("AB", names, comparison.decks, comparison.created, strict=True)
    ]
    lines += [*_deck(comparison), *_run(comparison), *_model(comparison.model)]
    for case in comparison.cases:
        lines += _case(case)
    lines += [*_warnings(comparison), *heading("Summary"), *_summary(comparison)]
    return "\n".join(line.rstrip() for line in lines) + "\n"


def _deck(comparison: Comparison) -> list[str]:
    lines = heading("Deck")
    shown = comparison.deck_diff[:MOST_LINES]
    lines += [f"  {line}" for line in shown] if shown else sentence("The texts are the same.")
    if len(comparison.deck_diff) > len(shown):
        lines += sentence(f"and {counted(len(comparison.deck_diff) - len(shown), 'more line')}; --json has them all")
    for letter, overrides in zip("AB", comparison.overrides, strict=True):
        if comparison.overrides[0] != comparison.overrides[1]:
            lines += sentence(f"changed by the user in {letter}: {', '.join(overrides) or 'nothing'}")
    return lines


def _run(comparison: Comparison) -> list[str]:
    rows = [[name, *pair] for each in (comparison.settings, comparison.provenance) for name, pair in each.items()]
    return heading("Settings and program") + table(["", "A", "B"], rows, left=3) if rows else []


def _model(model: ModelComparison) -> list[str]:
    lines = heading("Model")
    differ = [figure for figure in model.totals if not figure.same]
    lines += _figures(model.totals if differ else ()) or sentence("Counts and totals are the same.")
    if model.units[0] != model.units[1]:
        lines += sentence(f"Units: {model.units[0]} in A, {model.units[1]} in B; everything here is in those of A.")
    if model.matched_by == "place":
        lines += sentence("Blocks were matched by their place: their names are others, or in another order.")
    lists = (
        ("elsewhere in B", model.moved),
        ("of another volume or mass in B", model.changed),
        ("without match in B", model.only[0]),
        ("of B without match in A", model.only[1]),
        ("fixed in one of the two only", model.fixed_in_one),
    )
    for what, names in lists:
        if names:
            more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
            lines += sentence(f"{counted(len(names), 'block')} {what}: {', '.join(names[:MOST_NAMED])}{more}")
    lines += [line for words in model.joints for line in sentence(f"joint law {words}")]
    return lines + [line for words in model.ties for line in sentence(f"tie {words}")]


def _figures(figures: tuple[Figure, ...]) -> list[str]:
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


def _name(figure: Figure) -> str:
    return figure.name.replace("_", " ")


def _percent(figure: Figure) -> str:
    if math.isnan(figure.difference):
        return "-"
    return "0" if abs(figure.difference) <= ROUNDING else f"{100 * figure.difference:+.3g} %"


def _verdict(figure: Figure) -> str:
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
    lines += _motion(case)
    lines += _modes(case)
    for support, change in list(case.reactions.items())[:MOST_NAMED]:
        share = math.sqrt(float(change @ change)) / case.load if case.load > 0.0 else math.nan
        words = f"{vector(change, float(abs(change).max()))}, {share:.2g} of the loads"
        lines += sentence(f"reaction of {support}: changes by {words}")
    if len(case.reactions) > MOST_NAMED:
        lines += sentence(f"and {counted(len(case.reactions) - MOST_NAMED, 'more reaction')}")
    return lines + sentence(f"solved in {case.time[0]:.3g} s in A, {case.time[1]:.3g} s in B")


def _motion(case: CaseComparison) -> list[str]:
    found = case.mechanism
    if found.angle is None:
        return sentence(f"mechanisms not compared: {found.compared}")
    return sentence(f"angle between the two {found.compared}s: {found.angle:.3g} degrees")


def _modes(case: CaseComparison) -> list[str]:
    modes = case.modes
    if modes is None:
        return []
    changed = len(modes.changed)
    compared = counted(modes.compared, "interface")
    lines = sentence(f"{changed} of {compared} in another mode" if changed else f"modes of {compared} the same in both")
    for letter, alone in zip("AB", modes.only, strict=True):
        lines += sentence(f"{counted(alone, 'interface')} of {letter} without match") if alone else []
    for bodies, centroid, (old, new) in modes.changed[:MOST_NAMED]:
        place = vector(centroid, float(abs(centroid).max()))
        lines += sentence(f"interface {bodies} at {place}: {old} in A, {new} in B", "    ")
    more = f"and {counted(changed - MOST_NAMED, 'more interface')}; --json has them all"
    return lines + (sentence(more, "    ") if changed > MOST_NAMED else [])


def _warnings(comparison: Comparison) -> list[str]:
    if not comparison.warnings_gone and not comparison.warnings_new:
        return []
    lines = heading("Warnings")
    lines += [line for notice in comparison.warnings_gone for line in sentence(f"in A only: {notice}")]
    return lines + [line for notice in comparison.warnings_new for line in sentence(f"in B only: {notice}")]


def _summary(comparison: Comparison) -> list[str]:
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
