import re
from dataclasses import replace

import pytest

from mbla.errors import UsageError
from mbla.results.pictures.page import WARNING
from mbla.results.results import Results
from mbla.results.view3d import view
from mbla.results.view3d.view import library_html, page_html, view_html
from mbla.solution.solution import Status
from tests.results.synthetic import tower_results


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


def test_library_is_there_once_and_on_request(results: Results) -> None:
    with_it = view_html(results, results.cases[0], include_library=True)
    without = view_html(results, results.cases[0], include_library=False)
    assert with_it == library_html() + without
    assert len(without) < 50_000
    assert "src=" not in re.sub(r"<script>.*?</script>", "", with_it, flags=re.DOTALL)


@pytest.mark.parametrize("status", [Status.NOT_VERIFIED, Status.APPROXIMATE, Status.ITERATION_LIMIT, Status.SOLVED])
def test_title_says_what_the_figure_is_worth(results: Results, status: Status) -> None:
    text = view_html(results, replace(results.cases[0], status=status), include_library=False)
    title = text[: text.index("<script>")]
    words = {"not_verified": "NOT VERIFIED", "approximate": "approximate", "iteration_limit": "NOT SOLVED"}
    assert words.get(status.value, "0.5 g, verified") in title
    assert (WARNING in title) == (status is not Status.SOLVED)


def test_no_text_of_a_deck_is_markup(results: Results) -> None:
    evil = "</script><script>alert(1)</script>"
    blocks = replace(results.model.blocks, groups=("base", evil, "brick"))
    model = replace(results.model, title=evil, blocks=blocks)
    text = page_html(replace(results, assembly=replace(results.assembly, model=model)), results.cases[0]).replace(
        library_html(), ""
    )
    assert "alert(1)</script>" not in text
    assert text.count("<script>") == 1


def test_missing_extra_is_told(results: Results, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    view._plotly_js.cache_clear()
    monkeypatch.setitem(sys.modules, "plotly.offline", None)
    with pytest.raises(UsageError, match=r"mbla\[report\]"):
        view_html(results, results.cases[0], include_library=True)
    view_html(results, results.cases[0], include_library=False)
