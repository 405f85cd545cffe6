"""A report as a page: templates filled (only importer of jinja2, extra ``report``), and its views to be turned.

Everything of a result is untrusted text: titles, names and decks come from anywhere. The templates escape all of it; a
Content-Security-Policy in the page forbids every request, and every script but those whose hashes it names.
"""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Iterable, Mapping
from importlib.resources import files
from typing import Any

from mbla.errors import UsageError
from mbla.results.results import CaseResult, Results

SCRIPT = re.compile(r"<script\b[^>]*>(.*?)</script\s*>", re.DOTALL | re.IGNORECASE)


def render(content: Mapping[str, Any], views: Iterable[str]) -> str:
    """The page; ``views`` are the pieces of trusted HTML in ``content``, whose scripts may run.

    Raises
    ------
    UsageError
        The extra for reports is not installed.
    """
    jinja2 = library()
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("mbla.results.report"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    style = files("mbla.results.report").joinpath("templates", "report.css").read_text(encoding="utf-8")
    return str(environment.get_template("report.html").render(style=style, policy=_policy(views), **content))


def library() -> Any:
    """jinja2, or UsageError that says what to install: asked before anything is drawn."""
    try:
        import jinja2
    except ImportError as error:
        raise UsageError(
            "extra-missing", "reports need an extra that is not installed: pip install 'mbla[report]'"
        ) from error
    return jinja2


def _policy(views: Iterable[str]) -> str:
    """Nothing from anywhere: styles and pictures of the page itself, and the scripts of its views by their hashes."""
    hashes = dict.fromkeys(_hash(text) for view in views for text in SCRIPT.findall(view))
    scripts = " ".join(f"'sha256-{each}'" for each in hashes) or "'none'"
    return (
        f"default-src 'none'; script-src {scripts}; style-src 'unsafe-inline'; img-src data: blob:; "
        "base-uri 'none'; form-action 'none'"
    )


def _hash(text: str) -> str:
    """As a browser counts it, with line ends as newlines."""
    whole = text.replace("\r\n", "\n").replace("\r", "\n")
    return base64.b64encode(hashlib.sha256(whole.encode("utf-8")).digest()).decode("ascii")


# --- The views of a report that can be turned (its one door to them) ------------------------------------------------


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
