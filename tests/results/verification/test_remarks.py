"""Which remarks are the same, and which ones no run makes."""

from __future__ import annotations

import pytest

from mbla.errors import Message
from mbla.results.explanations import explanations
from mbla.results.findings import FOUND_AGAIN, REMARKS_THAT_WARN
from mbla.results.verification.remarks import POSSIBLE, same_remark

WORDS = "least 0.5664, 3 of 4 ties, by 1.2e-05"


def test_every_remark_that_is_judged_has_its_explanation() -> None:
    assert explanations().keys() >= FOUND_AGAIN | POSSIBLE.keys() | REMARKS_THAT_WARN
    assert not FOUND_AGAIN & POSSIBLE.keys()


@pytest.mark.parametrize(
    ("words", "same"),
    [
        (WORDS, True),
        (WORDS.replace("0.5664", "0.5665"), True),  # rounded on another machine
        (WORDS.replace("1.2e-05", "1.3e-05"), True),
        (WORDS.replace("0.5664", "0.5666"), False),
        (WORDS.replace("3 of", "2 of"), False),  # a count is no rounded number
        (WORDS.replace("least", "greatest"), False),
    ],
)
def test_remarks_are_the_same_to_the_last_of_their_digits(words: str, same: bool) -> None:
    assert same_remark(Message("brittle-ties", WORDS), Message("brittle-ties", words)) is same
    assert not same_remark(Message("brittle-ties", WORDS), Message("pushover-rough", words))
