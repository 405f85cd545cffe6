"""A part of a page that shows one load case in three dimensions (only importer of plotly, extra ``report``).

plotly.js is put into the page as it comes with the package, so nothing is asked of a network. The scene is a block of
JSON with its arrays in base64; ``view.js`` draws it, and moves the mechanism between the frames in it.
"""

from __future__ import annotations

import hashlib
import json
from functools import cache
from html import escape
from importlib import resources

from mbla.errors import UsageError
from mbla.results.listing.verdict_words import verdict
from mbla.results.outcome import result_of
from mbla.results.pictures.page import INK, WARNING
from mbla.results.results import CaseResult, Results
from mbla.results.view3d.scene import scene_of
from mbla.solution.solution import Status


def view_html(
    results: Results, case: CaseResult, *, include_library: bool, view: tuple[float, float] | None = None
) -> str:
    """A ``<div>`` that shows the structure of a load case, to be turned, with its mechanism, to be moved.

    Parameters
    ----------
    results, case
        Any outcome; what is no verified result says so in its title.
    include_library
        Put plotly.js (about 5 MB) in front. A page needs it once, before or in its first view.
    view
        Azimuth and elevation of the eye at first, degrees; None: what suits the structure.

    Raises UsageError where the extra for reports is not installed.
    """
    library = library_html() if include_library else ""
    data = json.dumps(scene_of(results, case, view), separators=(",", ":"), allow_nan=False, ensure_ascii=True)
    data = data.replace("<", "\\u003c")  # no text of a deck may end the script
    name = hashlib.sha256(data.encode("ascii")).hexdigest()[:12]
    start = (
        f"for (const host of document.querySelectorAll('[data-mbla-view=\"{name}\"]:not([data-mbla-begun])')) "
        '{ host.dataset.mblaBegun = "yes"; window.mblaView3d(host, data); }'
    )
    return (
        f'{library}<div class="mbla-view3d" data-mbla-view="{name}" style="color: {INK}; '
        f'background: #FFFFFF">{_title(results, case)}</div>\n'
        f"<script>(function () {{ const data = {data};\n{start} }})();</script>\n"
    )


def page_html(results: Results, case: CaseResult) -> str:
    """A complete page with one view; raises as ``view_html`` does."""
    title = escape(f"{results.model.title or results.deck.name}: {case.load_case.name}")
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1"></head>\n'
        f'<body style="font-family: sans-serif">{view_html(results, case, include_library=True)}</body></html>\n'
    )


def library_html() -> str:
    """The scripts that every view of a page needs; UsageError if the extra for reports is not installed."""
    return f"<script>{_plotly_js()}</script>\n<script>{_view_js()}</script>\n"


@cache
def _plotly_js() -> str:
    try:
        from plotly.offline import get_plotlyjs
    except ImportError as error:
        raise UsageError(
            "extra-missing", "reports need an extra that is not installed: pip install 'mbla[report]'"
        ) from error
    # an inline script ends at the first end tag, wherever it stands
    return str(get_plotlyjs()).replace("</script", "<\\/script")


@cache
def _view_js() -> str:
    return resources.files("mbla.results.view3d").joinpath("view.js").read_text(encoding="utf-8")


def _title(results: Results, case: CaseResult) -> str:
    title = escape(results.model.title or results.deck.name)
    words = escape(f"load case {case.load_case.name}: {verdict(results.model.of_case(case.load_case), case)}")
    sure = result_of(case) is not None and case.status is Status.SOLVED
    colour = INK if sure or case.status in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED) else WARNING
    return f'<div class="mbla-view3d-title">{title}<br><strong style="color: {colour}">{words}</strong></div>'
