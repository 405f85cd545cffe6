"""Load cases of a result by their names."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.errors import UsageError
from mbla.results.results import CaseResult, Results


def chosen_cases(results: Results, names: Sequence[str] | None) -> tuple[CaseResult, ...]:
    """Cases by name in the order of the deck, None for all; UsageError for a name that the result does not have.

    The name of a load that travels stands for all its positions.
    """
    known = {name for case in results.cases for name in _names(case)}
    for name in names or ():
        if name not in known:
            raise no_such_case(results, name)
    return tuple(case for case in results.cases if names is None or not _names(case).isdisjoint(names))


def _names(case: CaseResult) -> set[str]:
    return {case.load_case.name, case.load_case.deck_name}


def no_such_case(results: Results, name: str | None) -> UsageError:
    """The error for a name that the result does not have, or for any case where it has none."""
    if name is None:
        return UsageError("unknown-load-case", "the result has no load case")
    known = ", ".join(case.load_case.name for case in results.cases) or "none"
    return UsageError("unknown-load-case", f"no load case {name} in the result; it has {known}")
