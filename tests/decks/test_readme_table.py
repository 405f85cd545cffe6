from __future__ import annotations

from tests.decks.readme_table import README, with_table


def test_the_table_of_decks_is_up_to_date() -> None:
    text = README.read_text(encoding="utf-8")
    assert text == with_table(text), "python -m tests.decks.readme_table writes it again"
