"""Parts that are the same program are solved once; the answer is that of each by itself."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.program.reductions import Reduced, StepState, reduce_program
from mbla.program.reductions.parts import split_into_parts
from mbla.program.reductions.repeated import _close_matrices, _margin, like_which
from mbla.program.reductions.scene import scene_of
from mbla.results.records.reduction_json import reductions_json
from mbla.results.words.reduction_words import reduction_lines
from mbla.solution.solution import Solution, Status
from tests.line import HEAD, Line, line_of, verified
from tests.program.reductions.scenes import scene

COLUMN = """\
  - box: {{group: foot, material: {stone}, min: [{x}, {y}, -0.2], max: [{x1}, {y1}, 0]}}
  - box: {{group: drum, material: {stone}, min: [{x}, {y}, 0], max: [{x1}, {y1}, {h}]}}
  - box: {{group: drum, material: {stone}, min: [{x}, {y}, {h}], max: [{x1}, {y1}, {top}]}}
"""


def column(x: float, size: float = 0.5, slender: float = 1.0, stone: str = "stone", y: float = 0.0) -> str:
    h = slender * size
    return COLUMN.format(x=x, x1=x + size, y=y, y1=y + size, h=h, top=2.5 * h, stone=stone)


def deck(*columns: str, case: str = "acceleration: [1, 0.2, 0]", more: str = "") -> str:
    return (
        HEAD.replace("materials: {", "materials: {heavy: {density: 5000}, ")
        + "joints: {dry: {friction: 0.6}}\nblocks:\n"
        + "".join(columns)
        + f"supports: [{{blocks: foot}}]\n{more}load_cases:\n  push: {{live: [{{{case}}}]}}\n"
        + "analysis: {flow_rule: associative}\n"
    )


ROW = deck(*(column(1.7 * number) for number in range(3)), column(9.0, slender=1.5))
"""Three columns of one make and a slenderer one, the weakest."""

ALONE = ROW.replace(column(9.0, slender=1.5), "")


def reduced(line: Line) -> Reduced:
    associative = line.deck.analysis.flow_rule == "associative"
    return reduce_program(
        line.model, line.contacts, line.program, line.deck.analysis.reductions, associative=associative
    )


def both(text: str, *overrides: str, case: int = 0) -> tuple[Solution, Solution]:
    """With and without, both verified and of one status."""
    found = []
    for switch in ("true", "false"):
        line = line_of(text, *overrides, f"analysis.reductions.repeated={switch}", case=case)
        solution, checks, status = verified(line)
        assert status is Status.SOLVED, checks.failures
        assert solution.mechanics is not None
        found.append(solution)
    return found[0], found[1]


@pytest.mark.parametrize(
    ("text", "flow"),
    [(ROW, "associative"), (ALONE, "associative"), (ROW, "non_associative")],
    ids=["one is weaker", "all fail at once", "without normality"],
)
def test_the_answer_is_that_without(text: str, flow: str) -> None:
    own, other = both(text, f"analysis.flow_rule={flow}", "analysis.standing=true")
    assert own.mechanics is not None
    assert other.mechanics is not None
    assert own.mechanics.load_factor == pytest.approx(other.mechanics.load_factor, rel=1e-9)
    size = np.abs(other.mechanics.contact_forces).max()
    assert own.mechanics.contact_forces == pytest.approx(other.mechanics.contact_forces, abs=1e-6 * size)
    assert own.mechanics.mechanism == pytest.approx(
        other.mechanics.mechanism, abs=1e-6 * np.abs(other.mechanics.mechanism).max()
    )
    assert own.standing == other.standing
    assert own.standing is not None
    assert other.standing is not None
    assert own.standing.forces == pytest.approx(other.standing.forces, abs=1e-9 * size)
    assert own.standing.settlement is not None
    assert other.standing.settlement is not None
    settled = np.abs(other.standing.settlement).max()
    assert own.standing.settlement == pytest.approx(other.standing.settlement, abs=1e-6 * settled)
    assert len(own.programs) < len(other.programs)
    assert own.remarks == tuple(dict.fromkeys(other.remarks))


def test_what_is_left_and_what_is_said() -> None:
    line = line_of(ROW)
    found = reduced(line)
    assert found.like == (0, 0, 0, 3)
    assert (len(found.parts), len(found.solved), found.size.parts) == (4, 2, 2)
    step = found.steps[-1]
    assert (step.name, step.state, step.found) == ("repeated", StepState.APPLIED, 2)
    assert step.before.unknowns == sum(len(part.dead_load) for part in found.parts)
    assert step.after.unknowns == sum(len(part.dead_load) for part in found.solved)
    assert found.size.contact_points == sum(part.n_points for part in found.solved)
    assert "2 parts the same as another" in "\n".join(reduction_lines(found.steps))
    assert reductions_json(found.steps)[-1]["found"] == 2


def test_programs_are_those_found_by_looking_at_each() -> None:
    """Each part has its own way back, and its own program up to rounding."""
    with_ = reduced(line_of(ROW)).parts
    without = reduced(line_of(ROW, "analysis.reductions.repeated=false")).parts
    for own, other in zip(with_, without, strict=True):
        assert abs(own.equilibrium_matrix - other.equilibrium_matrix).max() < 1e-12
        assert own.dead_load == pytest.approx(other.dead_load, abs=1e-12)
        assert own.live_load == pytest.approx(other.live_load, rel=1e-10, abs=1e-12 * np.abs(other.live_load).max())
        assert own.reduction is not None
        assert other.reduction is not None
        assert abs(own.reduction.velocities - other.reduction.velocities).max() < 1e-9
        assert abs(own.reduction.forces - other.reduction.forces).max() < 1e-9 * abs(other.reduction.forces).max()


def test_switched_off() -> None:
    found = reduced(line_of(ROW, "analysis.reductions.repeated=false"))
    assert found.steps[-1].state is StepState.OFF
    assert found.solved == found.parts


@pytest.mark.parametrize(
    ("other", "same"),
    [
        (column(3.0), True),
        (column(3.0, stone="heavy"), True),  # weights and loads in proportion
        (column(30.0, size=2.0), True),  # and lengths, without strengths
        (column(3.0, slender=1.0 + 1e-13), True),
        (column(3.0, slender=1.0 + 1e-7), False),
        (column(3.0, size=0.51).replace("1.275", "1.25"), False),
    ],
    ids=["moved", "heavier", "larger", "rounding", "a hair slenderer", "another"],
)
def test_what_is_the_same(other: str, same: bool) -> None:
    line = line_of(deck(column(0.0), other))
    assert reduced(line).like == ((0, 0) if same else (0, 1))


@pytest.mark.parametrize(
    ("override", "columns"),
    [
        ("joints.dry.cohesion=100", (column(0.0), column(30.0, size=2.0))),  # strength against weight
        ("joints.dry.cohesion=100", (column(0.0), column(3.0, stone="heavy"))),
        ("load_cases.push.live=[{force: [100, 0, 0], on: {group: drum, index: 1}}]", (column(0.0), column(3.0))),
        ("contacts.overrides=[{between: [{group: foot, index: 1}, drum], joint: glued}]", (column(0.0), column(3.0))),
    ],
    ids=["strength and size", "strength and weight", "load", "glue"],
)
def test_what_is_not_the_same(override: str, columns: tuple[str, ...]) -> None:
    line = line_of(deck(*columns), override)
    assert reduced(line).like == (0, 1)


def test_parts_without_live_load_are_found_too() -> None:
    text = deck(
        *(column(1.7 * number) for number in range(4)), case="acceleration: [1, 0, 0], on: {group: drum, x: [0, 1]}"
    )
    line = line_of(text.replace(", on: {group: drum, x: [0, 1]}", ", on: {box: [[-1, -1, -1], [1, 1, 9]]}"))
    assert reduced(line).like == (0, 1, 1, 1)
    solution, checks, status = verified(line)
    assert status is Status.SOLVED, checks.failures
    assert solution.mechanics is not None
    assert (solution.mechanics.contact_forces[:, 0].reshape(4, -1).sum(axis=1) > 0).all()  # each carries its weight


def test_columns_that_fall_name_the_first() -> None:
    """The upper drum of each stands 0.4 m beside the lower one, of 0.5 m: it falls by itself."""
    falling = [
        column(x)
        .replace(f"min: [{x}, 0.0, 0.5]", f"min: [{x + 0.4}, 0.0, 0.5]")
        .replace(f"max: [{x + 0.5}, 0.5, 1.25]", f"max: [{x + 0.9}, 0.5, 1.25]")
        for x in (0.0, 2.0)
    ]
    line = line_of(deck(*falling))
    assert reduced(line).like == (0, 0)
    solution, checks, status = verified(line)
    assert status is Status.NO_EQUILIBRIUM
    assert checks.verified
    assert solution.certificate is not None
    moving = np.flatnonzero(np.abs(solution.certificate).max(axis=1) > 1e-6)
    assert line.model.blocks.name(int(moving[0])) == "drum[1]"


def test_columns_mirrored_about_a_plane_of_the_deck() -> None:
    """Left and right images are not the same part where a plane that the deck gives halves only one of them."""
    line = line_of(ROW)

    scenes = split_into_parts(scene_of(line.model, line.contacts, line.program))
    assert like_which(scenes).tolist() == [0, 0, 0, 3]
    assert like_which(scenes, ((1.0, 0.0, 0.0, 0.25),)).tolist() == [0, 1, 2, 3]
    assert like_which(scenes, ((0.0, 1.0, 0.0, 0.25),)).tolist() == [0, 0, 0, 3]


def test_far_from_the_origin_more_is_rounding() -> None:
    assert reduced(line_of(deck(column(0.0), column(3.0e4, y=2.0e4)))).like == (0, 0)


def test_rounding_grows_with_the_distance_from_the_origin() -> None:
    """Along whichever axis; from a distance on no more."""
    for x, y, margin in ((0.0, 0.0, 1e-12), (3.0e4, 0.0, 5e-10), (0.0, 3.0e4, 5e-10), (3.0e8, 0.0, 1e-9)):
        assert _margin(scene(deck(column(x, y=y)))) == pytest.approx(margin, rel=0.5)


def test_what_is_rounding_at_either_place_is_rounding() -> None:
    """A part near the origin and one far away, in either order."""
    for places in ((0.0, 3.0e4), (3.0e4, 0.0)):
        line = line_of(deck(*(column(x, slender=1.0 + 1e-10 * (x > 0)) for x in places)))
        assert reduced(line).like == (0, 0)


def test_matrices_of_another_pattern_are_the_same_up_to_rounding() -> None:
    one = sp.csr_array(np.array([[4.0, 0.0], [0.0, 2.0]]))
    for off, same in ((1e-13, True), (1e-3, False)):
        other = sp.csr_array(np.array([[4.0, off], [0.0, 2.0]]))
        assert _close_matrices(one, other, 1e-12) is same
        assert _close_matrices(other, one, 1e-12) is same
