"""The views of a report that can be turned (its one door to them)."""

from __future__ import annotations

from mbla.results.results import CaseResult, Results


def case_view(results: Results, case: CaseResult, *, first: bool) -> str:
    """Trusted HTML of the view of a case; its library comes with the first one of a page.

    Raises
    ------
    UsageError
        The extra for reports is not installed.
    """
    from mbla.results.view3d.view import view_html

    return view_html(results, case, include_library=first)
