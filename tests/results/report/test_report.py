"""The report without a browser: what is in it, that it is whole, safe, and says what listing and JSON say."""

import re
import sys
from dataclasses import replace
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from mbla.deck.sections.analysis import AnalysisSection
from mbla.errors import Message, Notice, UsageError
from mbla.results.explanations import explanations
from mbla.results.listing.blocks import Facts, ListingSection, Paragraph, WordTable
from mbla.results.listing.listing import case_sections
from mbla.results.listing.sections.contact_words import contact_section
from mbla.results.listing.sections.model_words import model_sections, settings_section
from mbla.results.listing.text import number
from mbla.results.record.json_record import results_json
from mbla.results.report import report
from mbla.results.report.assumptions import SLIDING, assumptions
from mbla.results.report.content import OF_LISTING
from mbla.results.report.figures import ReportFigure, ReportFigures
from mbla.results.report.report import report_html, report_path, write_report
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Status
from tests.results.report.page_reader import Node, Page
from tests.results.synthetic import full_results, tower_results

EVIL = "<script>alert(1)</script>\"'><img src=x onerror=alert(2)>&amp;{{ 7*7 }}"
DOT = "data:image/png;base64,iVBORw0KGgo="


@pytest.fixture(autouse=True)
def no_drawing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures take seconds and have tests of their own."""
    figures = ReportFigures((ReportFigure(DOT, "Mechanism", "The structure"),))
    monkeypatch.setattr(report, "case_figures", lambda results, case: figures)
    monkeypatch.setattr(report, "model_figures", lambda results, view: figures)
    monkeypatch.setattr(report, "series_figures", lambda results, series: figures)


def page_of(results: Results, case: str | None = None) -> Page:
    return Page(report_html(results, case, view=False)[0])


def with_status(status: Status) -> Results:
    results = tower_results()
    first = results.cases[0]
    solution = first.solution
    if status in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED):
        solution = replace(solution, mechanics=None, associative=None)
    checks = replace(first.checks, verified=status in (Status.SOLVED, Status.UNBOUNDED))
    return replace(results, cases=(CaseResult(first.load_case, replace(solution, status=status), checks, status),))


@pytest.mark.parametrize("results", [tower_results(), tower_results("associative"), full_results()])
def test_the_page_is_whole_and_accessible(results: Results) -> None:
    page = page_of(results)
    ids = [node.attributes["id"] for node in page.nodes if "id" in node.attributes]
    assert len(ids) == len(set(ids))
    for node in page.nodes:
        for name in ("aria-labelledby", "headers", "for"):
            if name in node.attributes:
                assert node.attributes[name] in ids
    links = [node.attributes["href"] for node in page.all("a")]
    assert links
    assert all(link[0] == "#" and link[1:] in ids for link in links)
    assert page.one("html").attributes["lang"] == "en"
    assert all(node.attributes["alt"] for node in page.all("img"))
    assert all("scope" in node.attributes for node in page.all("th"))
    levels = [int(node.tag[1]) for node in page.nodes if re.fullmatch("h[1-6]", node.tag)]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert max(np.diff(levels)) <= 1


@pytest.mark.parametrize("results", [tower_results(), full_results()])
def test_no_part_of_it_comes_from_elsewhere(results: Results) -> None:
    html = report_html(results, view=False)[0]
    page = Page(html)
    for node in page.nodes:
        for name in ("src", "href", "srcset", "action", "data", "poster"):
            assert re.match("data:|#", node.attributes.get(name, "#")), node
    assert "url(" not in html
    assert "@import" not in html
    policy = page.one("meta", **{"http-equiv": "Content-Security-Policy"}).attributes["content"]
    assert policy.startswith("default-src 'none'; script-src 'none';")


def said(page: Page, owner: Node, section: ListingSection) -> None:
    """All that a section of the listing says stands in a part of the page: facts and rows as rows, cell by cell."""
    rows = [row for table in page.within(owner, "table") for row in page.rows(table)]
    for block in section.blocks:
        match block:
            case Paragraph():
                assert " ".join(block.text.split()) in owner.text
            case Facts():
                assert block.caption in owner.text
                for fact in block.rows:
                    assert [fact.name, " ".join(" ".join([fact.value, *fact.notes]).split())] in rows
            case WordTable():
                assert " ".join(block.caption.split()) in owner.text
                for row in (block.head, *block.rows):
                    assert [" ".join(cell.split()) for cell in row] in rows


@pytest.mark.parametrize("results", [tower_results(), tower_results("associative"), full_results()])
def test_listing_and_report_say_the_same(results: Results) -> None:
    page = page_of(results)
    for i, case in enumerate(results.cases):
        owner = page.one("section", id=f"case-{i + 1}")
        for section in case_sections(results.assembly, case):
            if section.title not in OF_LISTING:
                said(page, owner, section)
    model = page.one("section", id="model")
    for section in (*model_sections(results.model), contact_section(results.model, results.contacts)):
        said(page, model, section)
    said(page, page.one("section", id="provenance"), settings_section(results))


@pytest.mark.parametrize("results", [tower_results(), full_results()])
def test_verdict_model_load_cases_and_assumptions_come_in_that_order(results: Results) -> None:
    page = page_of(results)
    ids = [node.attributes["id"] for node in page.all("section", class_="chapter")]
    cases = [f"case-{i + 1}" for i in range(len(results.cases))]
    assert ids == ["model", *cases, "assumptions", "deck", "provenance"]


def test_the_page_begins_with_what_a_code_says() -> None:
    page = page_of(full_results())
    (code,) = page.all("strong", class_="code")
    assert "NOT MET" in code.text
    assert code.attributes["class"] == "code bad"
    results = page.one("section", id="results")
    assert results.text.index(code.text) < results.text.index("static bound")


def test_what_a_report_takes_for_granted_follows_the_model() -> None:
    dry, strong = (text for text in assumptions(tower_results()) if text.startswith("Joints"))
    assert "friction coefficient 0.65 (33 degrees), no cohesion, no tension, compression without limit" in dry
    assert "cohesion 1 N/m2, tensile strength 2 N/m2, compressive strength 3 N/m2" in strong
    flows = {rule: " ".join(assumptions(tower_results(rule))) for rule in ("associative", "non_associative")}
    assert "slides is lifted by its friction angle" in flows["associative"]
    assert "slides without lifting" in flows["non_associative"]
    assert set(SLIDING) == set(get_args(AnalysisSection.model_fields["flow_rule"].annotation))


def test_the_table_of_verdicts_has_the_figures_of_the_record() -> None:
    results = tower_results()
    page, record = page_of(results), results_json(results)["cases"]
    rows = page.rows(page.one("table", id="verdicts"))
    assert rows[0] == [
        *("load case", "status", "load factor", "associative", "static bound", "kinematic bound"),
    ]
    assert [row[0] for row in rows[1:]] == [case["name"] for case in record]
    assert rows[1] == ["push_x", "solved", number(record[0]["load_factor"]), "0.5", "0.5", "0.5"]
    assert rows[2] == ["fall", "NO EQUILIBRIUM", *4 * ["-"]]


@pytest.mark.parametrize("status", [status for status in Status if status is not Status.SOLVED])
def test_what_is_no_verified_result_looks_so(status: Status) -> None:
    page = page_of(with_status(status))
    words = status.value.replace("_", " ").upper()
    tone = {Status.APPROXIMATE: "fair", Status.UNBOUNDED: "open"}.get(status, "bad")
    row = page.within(page.one("table", id="verdicts"), "tr")[1]
    assert row.attributes["class"] == tone
    assert words in row.text
    case = page.one("section", id="case-1")
    assert f"{words}: " in next(node.text for node in page.within(case, "p") if "alarm" in node.attributes["class"])
    title = page.within(case, "h2")[0]
    assert title.text.endswith(words)
    if tone != "fair":
        assert page.rows(page.one("table", id="verdicts"))[1][2] == "-"


def test_text_from_elsewhere_stays_text() -> None:
    results = tower_results()
    blocks = replace(results.model.blocks, groups=(EVIL, *results.model.blocks.groups[1:]))
    model = replace(results.model, title=EVIL, blocks=blocks)
    first = results.cases[0]
    solution = replace(first.solution, reason=EVIL, remarks=(Message("solver-remark", EVIL),))
    results = replace(
        results,
        assembly=replace(results.assembly, model=model),
        cases=(replace(first, solution=solution), *results.cases[1:]),
        deck=replace(results.deck, name=EVIL, sources=((EVIL, EVIL + "</pre>"),), overrides=(EVIL,)),
        notices=(Notice("warning", "near-miss", EVIL),),
        provenance={EVIL: EVIL},
        settings={EVIL: EVIL},
        files=(EVIL,),
    )
    page = page_of(results)
    assert not page.all("script")
    assert len(page.all("img")) == len(results.cases) + 1
    assert not [name for node in page.nodes for name in node.attributes if name.startswith("on")]
    assert page.one("h1").text == EVIL
    assert page.one("pre").text == EVIL + "</pre>"
    for key in ("case-1", "model", "warnings", "deck", "provenance"):
        assert EVIL in page.one("section", id=key).text


def test_the_deck_is_there_as_it_was() -> None:
    text = "mbla: 1\n\n  title: Tür – µ\n\tx\n"
    results = tower_results()
    deck = replace(results.deck, sources=(("a.yaml", text), ("b.yaml", "")), overrides=("analysis.solver=mbla",))
    page = page_of(replace(results, deck=deck))
    assert "".join(page.all("pre")[0].pieces).removeprefix("\n") == text
    assert [node.text for node in page.all("summary")] == ["a.yaml (4 lines)", "b.yaml (0 lines)"]
    assert "analysis.solver=mbla" in page.one("section", id="deck").text


def test_a_warning_is_explained_once() -> None:
    results = tower_results()
    twice = tuple(Notice("warning", "near-misses", f"pair {i}") for i in range(2))
    text = page_of(replace(results, notices=twice)).one("section", id="warnings").text
    assert text.count("warning [near-misses]: pair") == 2
    for part in (explanations()["near-misses"].meaning, explanations()["near-misses"].remedy):
        assert text.count(" ".join(part.split())) == 1


def test_one_case_alone() -> None:
    page = page_of(tower_results(), "fall")
    assert [row[0] for row in page.rows(page.one("table", id="verdicts"))[1:]] == ["fall"]
    assert page.one("section", id="case-1").text.startswith("Load case fall")
    assert "2 load cases of the deck not shown here" in page.one("section", id="results").text


@pytest.mark.parametrize("name", ["report.h5", "report", "report.pdf"])
def test_only_html_is_written(tmp_path: Path, name: str) -> None:
    with pytest.raises(UsageError, match=r"its name ends in \.html"):
        write_report(tower_results(), tmp_path / name, view=False)
    assert not list(tmp_path.iterdir())


def test_a_folder_gets_the_report_under_the_name_of_the_result(tmp_path: Path) -> None:
    result = tmp_path / "wall.h5"
    (tmp_path / "old.d").mkdir()
    assert report_path(None, result) == tmp_path / "wall.html"
    assert report_path(tmp_path / "new", result) == tmp_path / "new" / "wall.html"
    assert report_path(tmp_path / "old.d", result) == tmp_path / "old.d" / "wall.html"
    assert report_path(tmp_path / "a.html", result) == tmp_path / "a.html"


def test_without_the_extra_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "jinja2", None)
    for view in (False, True):  # before anything is drawn, and whatever it is to hold
        with pytest.raises(UsageError, match=r"^reports need an extra .*: pip install 'mbla\[report\]'$"):
            report_html(tower_results(), view=view)


def test_missing_pictures_are_said_in_the_page_and_beside_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(report, "case_figures", lambda results, case: ReportFigures((), "pictures need OpenGL"))
    html, remarks = report_html(tower_results(), view=False)
    assert remarks == ["pictures are missing: pictures need OpenGL"]
    page = Page(html)
    assert len([node for node in page.all("p", class_="alarm") if "pictures need OpenGL" in node.text]) == 2
