"""Lines of the listing as blocks of a page."""

from mbla.results.listing.text import entry, heading, sentence, table
from mbla.results.report.blocks import DataTable, Entries, Paragraph, Title, blocks_of


def test_a_sentence_with_a_colon_is_the_caption_of_its_table() -> None:
    lines = ["", *sentence("Hinges:"), *table(["interface", "at"], [["a/b", "1"], ["c/d", "2"]])]
    assert blocks_of(lines) == [DataTable("Hinges", ("interface", "at"), (("a/b", "1"), ("c/d", "2")), 1)]


def test_tables_that_follow_each_other_stay_apart() -> None:
    first, second = table(["a"], [["1"]]), table(["a"], [["1"]])
    assert len(blocks_of([*first, *second])) == 2


def test_entries_gather_and_take_their_details_along() -> None:
    lines = [*entry("status", "solved"), *entry("stands", "yes"), *sentence("of itself", "    "), *entry("  x", "1")]
    assert blocks_of(lines) == [Entries((("status", "solved"), ("stands", "yes\nof itself"), ("x", "1")))]


def test_wrapped_lines_are_one_again() -> None:
    words = "word " * 60 + "end"
    assert blocks_of(sentence(words)) == [Paragraph(words, False)]
    assert blocks_of(entry("name", words)) == [Entries((("name", words),))]


def test_cells_that_the_listing_shortens_are_whole() -> None:
    long = "block" * 30
    assert blocks_of(table(["name", "x"], [[long, "1"]])) == [DataTable("", ("name", "x"), ((long, "1"),), 1)]


def test_headings_and_lines_of_no_element() -> None:
    assert blocks_of([*heading("Model"), "  plain", ""]) == [Title("Model"), Paragraph("plain", False)]
