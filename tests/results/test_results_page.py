from tests.results.results_page import PAGE, renewed


def test_generated_tables_of_the_page_are_those_of_the_program() -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert renewed(page) == page, "write it anew: python -m tests.results.results_page"
