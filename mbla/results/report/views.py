"""The views of a report that can be turned (its one door to them)."""

from __future__ import annotations

from importlib.resources import files

from mbla.results.results import CaseResult, Results


def case_view(results: Results, case: CaseResult, view: tuple[float, float] | None, *, first: bool) -> str:
    """Trusted HTML of the view of a case; what all views need comes with the first one of a page.

    view : azimuth and elevation in degrees from which it is seen first, as in its pictures

    Raises
    ------
    UsageError
        The extra for reports is not installed.
    """
    from mbla.results.view3d.view import library_html, view_html

    html = view_html(results, case, include_library=False, view=view)
    return f"{library_html()}<script>{_begin_when_seen()}</script>\n{html}" if first else html


def _begin_when_seen() -> str:
    return files("mbla.results.report").joinpath("views.js").read_text(encoding="utf-8")
