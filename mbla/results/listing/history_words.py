"""What is known of the history that a state of elastic joints has: whether a path followed anew leads to it."""

from __future__ import annotations

import math

from mbla.model.model import LoadCase, Model
from mbla.results.findings import not_checked, not_followed
from mbla.results.listing.text import counted, number
from mbla.results.listing.verdict_words import LEAST_OFF, load_factor_words
from mbla.results.results import PathAgain, PushoverAgain, Results


def pushovers_words(results: Results) -> tuple[str, ...]:
    """Sentences on the pushovers that a verification followed anew, or that it did not."""
    if results.pushovers_again is None:
        return not_followed(results)
    cases = {case.load_case.name: case.load_case for case in results.cases}
    return tuple(
        f"{again.case}: {pushover_words(results.model, cases[again.case], again)}"
        for again in results.pushovers_again
        if again.agrees
    )


def pushover_words(model: Model, load_case: LoadCase, again: PushoverAgain) -> str:
    """What a pushover that was followed anew came to, beside that of the file."""
    words = f"the pushover followed anew has {counted(again.steps, 'step')} and ends because {again.end}"
    of = load_case.question.factors
    if again.agrees:
        return f"{words}; {of} of the file are {_percent(again.off)} off"
    says = [f"{of} of the file are up to {_percent(again.off)} off, at {number(again.at)} {model.units.length}"]
    says = says if again.off > again.allowed else []
    says += [f"not as in the file: {', '.join(again.others)}"] if again.others else []
    return f"{words}; {'; '.join(says)}"


def history_words(results: Results) -> tuple[str, ...]:
    """Sentences on the paths that a verification followed anew, or that it did not."""
    if results.paths_again is None:
        return not_checked(results)
    followed = {path.case for path in results.paths_again}
    words = [
        f"{path.case}: {path_words(results.model, case.load_case, path)}"
        for case in results.cases
        for path in results.paths_again
        if path.case == case.load_case.name and path.agrees
    ]
    asked = [case.load_case for case in results.cases if case.load_case.has_load_factor]
    without = [load_case.name for load_case in asked if load_case.name not in followed]
    words += [f"no path of elastic joints to follow anew: {', '.join(without)}"] if without else []
    return tuple(words)


def path_words(model: Model, load_case: LoadCase, path: PathAgain) -> str:
    """What a path that was followed anew came to, beside a figure of the file."""
    joints = f"the path followed anew, by other steps and with joints of {path.ratio:g} of their stiffness in shear"
    if math.isnan(path.load_factor):
        return f"{joints}, does not show its greatest load, and so not that the history is that of the loading"
    if math.isinf(path.load_factor):
        return f"{joints}, has no greatest load"
    again, own = (load_factor_words(model, load_case, value) for value in (path.load_factor, path.in_file))
    words = f"{joints}, leads to {again}; the file has {own} with {path.ratio_in_file:g}, {_percent(path.off)} off"
    if path.agrees and path.off > path.allowed:
        return f"{words}, which is approximate, and carried"
    return words + (f" (at most {_percent(path.allowed)})" if path.agrees else f": more than {_percent(path.allowed)}")


def _percent(share: float) -> str:
    return f"{100.0 * share:.2g} %" if share >= LEAST_OFF else f"less than {100.0 * LEAST_OFF:g} %"
