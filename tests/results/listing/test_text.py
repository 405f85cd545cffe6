from mbla.results.listing.text import WIDTH, counted, entry, number, sentence, small, table, vector


def test_sentences_are_broken_at_the_width() -> None:
    lines = sentence("word " * 60)
    assert max(map(len, lines)) <= WIDTH
    assert " ".join(" ".join(lines).split()) == ("word " * 60).strip()
    assert sentence("") == []


def test_entries_stand_in_one_column() -> None:
    lines = entry("name", "value " * 30)
    assert all(line.index("value") == 34 for line in lines)
    assert max(map(len, lines)) <= WIDTH
    assert [str(line) for line in entry("a" * 40, "value")] == [f"  {'a' * 40}", f"{'':34}value"]


def test_table_columns() -> None:
    assert table(["name", "n"], [["a", "1"], ["long name", "22"]]) == [
        "  name        n",
        "  a           1",
        "  long name  22",
    ]


def test_wide_tables_shorten_their_first_column() -> None:
    lines = table(["name", "n"], [["x" * 80 + "end", "1" * 40]])
    assert max(map(len, lines)) <= WIDTH
    assert "..xx" in lines[1]
    assert "end" in lines[1]


def test_numbers() -> None:
    assert number(0.1453456789) == "0.145346"
    assert number(-0.0) == "0"
    assert number(float("nan")) == "-"
    assert small(1.234e-9) == "1.2e-09"
    assert small(float("nan")) == "-"
    assert vector([1, -1e-12, 0.123456], size=1.0) == "(1, 0, 0.1235)"
    assert (counted(1, "hinge"), counted(4, "hinge")) == ("1 hinge", "4 hinges")
