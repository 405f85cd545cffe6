"""The report of a result: its content collected, the page filled (only importer of jinja2, extra ``report``), written.

Everything of a result is untrusted text: titles, names and decks come from anywhere. The templates escape all of it; a
Content-Security-Policy in the page forbids every request, and every script but those whose hashes it names.
"""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from importlib.resources import files
from pathlib import Path
from typing import Any

from mbla import __version__
from mbla.errors import FileError, UsageError
from mbla.results.disk import write_complete
from mbla.results.listing.answers import series_section
from mbla.results.listing.blocks import Fact, ListingSection, facts
from mbla.results.listing.sections.assessment_words import code_verdict
from mbla.results.listing.sections.contact_words import contact_section, finding_sections
from mbla.results.listing.sections.model_words import model_sections, settings_section
from mbla.results.listing.text import counted, full_sentence, number
from mbla.results.listing.verdict_words import bound_words, least_words, reasons, verdict
from mbla.results.outcome import notices_of
from mbla.results.report.assumptions import assumptions
from mbla.results.report.content import CaseContent, case_content, notice_kinds, verdict_table
from mbla.results.report.figures import ReportFigures, case_figures, model_figures, series_figures
from mbla.results.results import CaseResult, Results
from mbla.results.series import chosen_cases, detailed_cases, series_of
from mbla.results.view3d.view import library_html, view_html

SUFFIXES = (".html", ".htm")
SCRIPT = re.compile(r"<script\b[^>]*>(.*?)</script\s*>", re.DOTALL | re.IGNORECASE)


def write_report(results: Results, path: Path, case: str | None = None, *, view: bool = True) -> list[str]:
    """Write the report of all load cases, or of one; remarks on what could not be shown, each a sentence.

    Parameters
    ----------
    path
        An HTML file; its folder is created if missing, an earlier report replaced.
    view
        A view of each load case that can be turned.

    Raises
    ------
    UsageError
        No such load case; a name that is not that of an HTML file; an extra that is not installed.
    FileError
        The file cannot be written.
    """
    if path.suffix.lower() not in SUFFIXES:
        raise UsageError("output-format", f"{path}: a report is an HTML file, its name ends in .html")
    if path.is_dir():  # said before anything is drawn
        raise FileError("folder-given", f"{path}: is a folder")
    text, remarks = report_html(results, case, view=view)
    write_complete(path, text.encode("utf-8", "backslashreplace"))
    return remarks


def report_path(output: Path | None, result: Path) -> Path:
    """The file of a report: next to its result, in a folder under the same name, or as named."""
    default = result.with_suffix(".html")
    if output is None:
        return default
    return output / default.name if output.is_dir() or not output.suffix else output


def report_html(results: Results, case: str | None = None, *, view: bool = True) -> tuple[str, list[str]]:
    """The page, the same for the same result, and remarks on what it could not show."""
    library()
    shown = replace(results, cases=chosen_cases(results, None if case is None else [case]))
    detailed = replace(shown, cases=detailed_cases(shown.cases))
    content = _content(results, shown, detailed, _cases(detailed, view))
    page = render(content, [each.view for each in content["cases"]])
    missing = [figures.missing for figures in _all_figures(content) if figures.missing]
    return page, [f"pictures are missing: {text}" for text in dict.fromkeys(missing)]


def _all_figures(content: dict[str, Any]) -> list[ReportFigures]:
    series = [figures for _, figures in content["series"]]
    return [*(each.figures for each in content["cases"]), content["model_figures"], *series]


def _cases(detailed: Results, view: bool) -> list[CaseContent]:
    """The library of the views comes once, with the first of them."""
    contents = []
    for i, case in enumerate(detailed.cases):
        figures = case_figures(detailed, case)
        html = case_view(detailed, case, figures.view, first=i == 0) if view else ""
        contents.append(case_content(detailed, case, i + 1, figures, html))
    return contents


def _content(results: Results, shown: Results, detailed: Results, cases: list[CaseContent]) -> dict[str, Any]:
    """Everything that the templates show but styles and policy; ``detailed`` are the load cases with sections."""
    model, contacts, deck = results.model, results.contacts, results.deck
    left_out = len(model.load_cases) - len(shown.cases)
    heads, verdicts = verdict_table(detailed)
    return {
        "title": model.title or deck.name,
        "deck": deck,
        "created": results.created,
        "version": results.provenance.get("mbla", __version__),
        "heads": heads,
        "verdicts": verdicts,
        "bounded": any(case.load_case.has_load_factor for case in detailed.cases),
        "settles": any(
            case.load_case.has_load_factor and not case.load_case.question.multiplies for case in detailed.cases
        ),
        "warnings_words": _warning_words(shown),
        "verdict_words": [_in_words(detailed, case) for case in detailed.cases],
        "left_out": f"{counted(left_out, 'load case')} of the deck not shown here" if left_out else "",
        "cases": cases,
        "series": [(series_section(model, series), series_figures(shown, series)) for series in series_of(shown.cases)],
        "model_figures": model_figures(shown, cases[0].figures.view if cases else None),
        "model": [*model_sections(model), contact_section(model, contacts), *finding_sections(model, contacts.report)],
        "assumptions": assumptions(shown),
        "notices": notice_kinds(notices_of(shown)),
        "settings": [settings_section(results), *_of_the_run(results)],
    }


def _of_the_run(results: Results) -> list[ListingSection]:
    """When it was, how long it took, what it wrote; versions of the program and of its libraries."""
    run = {"date": results.created, "exit status": str(results.exit_code)}
    run |= {f"seconds to {stage}": number(round(seconds, 3)) for stage, seconds in results.time.items()}
    run |= {"deck hash (SHA-256)": results.deck.sha256, "files": ", ".join(results.files) or "-"}
    told = {"Run": run, "Versions and platform": results.provenance}
    return [ListingSection(title, facts(Fact(*row) for row in rows.items())) for title, rows in told.items()]


def _warning_words(shown: Results) -> str:
    warnings = [notice for notice in notices_of(shown) if notice.severity == "warning"]
    return f"{counted(len(warnings), 'warning')}; see below." if warnings else "No warnings."


def _in_words(results: Results, case: CaseResult) -> tuple[str, str, str, list[str]]:
    """Name, verdict, what a code says and further sentences: the least found, what is known where little is."""
    model = results.model.of_case(case.load_case)
    further = (least_words(model, case), *reasons(case), bound_words(model, case))
    told = [full_sentence(text) for text in further if text]
    return case.load_case.name, f"{verdict(model, case)}.", full_sentence(code_verdict(case)), told


# --- The page -------------------------------------------------------------------------------------------------------


def render(content: Mapping[str, Any], views: Iterable[str]) -> str:
    """The page; ``views`` are the pieces of trusted HTML in ``content``, whose scripts may run.

    Raises UsageError where the extra for reports is not installed.
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
    """jinja2; raises UsageError that says what to install: asked before anything is drawn."""
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
    plain = text.replace("\r\n", "\n").replace("\r", "\n")
    return base64.b64encode(hashlib.sha256(plain.encode("utf-8")).digest()).decode("ascii")


def case_view(results: Results, case: CaseResult, view: tuple[float, float] | None, *, first: bool) -> str:
    """Trusted HTML of the view of a case; what all views need comes with the first one of a page.

    view : azimuth and elevation in degrees from which it is seen first, as in its pictures

    Raises UsageError where the extra for reports is not installed.
    """
    html = view_html(results, case, include_library=False, view=view)
    begin = files("mbla.results.report").joinpath("views.js").read_text(encoding="utf-8")  # when it is seen
    return f"{library_html()}<script>{begin}</script>\n{html}" if first else html
