from mbla.program.reductions import ProgramSize, ReductionStep, StepState
from mbla.program.reductions.steps import ReductionSwitches
from mbla.results.listing.solving import FOUND, found_words, reduction_lines
from tests.results.synthetic import STEP


def test_every_reduction_has_its_words() -> None:
    assert set(FOUND) == {"glued", *vars(ReductionSwitches())}


def test_what_was_found_or_why_nothing() -> None:
    one = ProgramSize(6, 4, 20, 6)
    assert found_words(STEP) == "2 parts solved apart"
    assert found_words(ReductionStep("points", StepState.APPLIED, 1, one, one)) == "1 contact point left out"
    assert found_words(ReductionStep("mirror", StepState.OFF, 0, one, one)) == "switched off"
    assert found_words(ReductionStep("mirror", StepState.BARRED, 0, one, one)) == "would change the answer"


def test_a_row_says_what_is_left_after_each() -> None:
    lines = [" ".join(str(line).split()) for line in reduction_lines((STEP,))]
    assert lines[0] == "reduction found unknowns cones entries largest program"
    assert lines[1] == "none 12 8 80 12"
    assert lines[2] == "parts 2 parts solved apart 12 8 80 6"


def test_nothing_is_said_where_nothing_was_looked_for() -> None:
    assert reduction_lines(()) == []
