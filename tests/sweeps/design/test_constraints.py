from __future__ import annotations

from typing import Any

import pytest

from mbla.deck.expressions import ExpressionError
from mbla.errors import DeckError
from mbla.sweeps.file.comparisons import read_comparison
from tests.sweeps.design.hand_made import column, design

PARAMETERS: dict[str, Any] = {
    "t": {"key": "blocks.0.arch.thickness", "values": [0.2, 0.4, 0.6, 0.8]},
    "radius": {"values": [2, 3]},
    "shape": {"key": "blocks.0.arch.shape", "values": ["pointed", "segmental"]},
    "wind": {"key": "loads.wind", "horizon": {"points": 4}},
}
KNOWN: dict[str, object] = {
    "radius": 9,
    "limit": "=0.2*radius",
    "span": "=2*radius",
    "fixed": "=sqrt(16)",
    "bad": "=1/0",
}


def kept(*constraints: str, known: dict[str, object] | None = None) -> set[tuple[Any, ...]]:
    """Thickness and radius of the points that stay."""
    found = design(
        PARAMETERS, known=KNOWN if known is None else known, constraints=list(constraints), vectors={"wind": (1, 0, 0)}
    )
    assert found.left_out + len(found.points) == 64
    assert sum(count for _, count in found.breaches) >= found.left_out
    return set(zip(column(found, "t"), column(found, "radius"), strict=True))


ALL = {(t, r) for t in (0.2, 0.4, 0.6, 0.8) for r in (2, 3)}


def message_of(*constraints: str, **parameters: Any) -> list[tuple[str, str]]:
    with pytest.raises(DeckError) as caught:
        design(PARAMETERS | parameters, known=KNOWN, constraints=list(constraints), vectors={"wind": (1, 0, 0)})
    return [(fault.key, fault.message) for fault in caught.value.faults]


def test_points_that_break_a_constraint_are_left_out() -> None:
    assert kept("t < 0.2*radius") == {(0.2, 2), (0.2, 3), (0.4, 3)}


def test_equal_numbers_are_equal_whatever_their_rounding() -> None:
    """3 x 0.2 is 0.6000000000000001 in binary, and 0.6 is the thickness that was meant."""
    assert 3 * 0.2 != 0.6
    assert kept("t == 0.2*radius") == {(0.4, 2), (0.6, 3)}
    assert kept("t >= 0.2*radius") == {(0.4, 2), (0.6, 2), (0.8, 2), (0.6, 3), (0.8, 3)}
    assert kept("t > 0.2*radius") == {(0.6, 2), (0.8, 2), (0.8, 3)}


def test_parameters_of_the_deck_are_those_at_the_point() -> None:
    """``limit`` follows the radius that the sweep sets, not the 9 of the deck."""
    assert kept("t < limit") == kept("t < 0.2*radius")
    assert kept("span >= 6") == {(t, r) for t, r in ALL if r == 3}
    assert kept("t*10 < fixed") == {(0.2, 2), (0.2, 3)}


def test_a_parameter_of_the_deck_that_the_sweep_gives_an_expression() -> None:
    found = design(
        {"a": {"values": ["=b", "=2*b", "=c"]}, "b": {"values": [1, 2]}},
        known={"a": 0, "b": 0, "c": 5},
        constraints=["a >= 2"],
    )
    assert [(p.settings["parameters.a"], p.settings["parameters.b"]) for p in found.points] == [
        ("=b", 2),
        ("=2*b", 1),
        ("=2*b", 2),
        ("=c", 1),
        ("=c", 2),
    ]


def test_how_many_points_break_each_constraint() -> None:
    found = design(
        PARAMETERS, known=KNOWN, constraints=["t < 0.5", "t < 0.3", "radius > 0"], vectors={"wind": (1, 0, 0)}
    )
    assert found.breaches == (("t < 0.5", 32), ("t < 0.3", 48), ("radius > 0", 0))
    assert found.left_out == 48
    assert [point.number for point in found.points] == list(range(1, 17))
    assert found.points[-1].position == (0, 1, 1, 3)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("t + 1", 'is no comparison: write one such as "t < 0.2*radius"'),
        ("t != 0.2", "compares by something other than < <= > >= =="),
        ("t < 1 and radius > 2", "joins comparisons by and/or: write each as one of its own; all of them must hold"),
        (
            "joints.dry.friction < 1",
            "joints.dry.friction is no name of letters, digits and _: give that parameter one, with its key",
        ),
        ("radus < 3", "unknown parameter radus; did you mean radius? known: "),
        ("shape < 3", "shape has values that are no numbers, which cannot be compared"),
        ("t < radius^2", "^ is not an operator of expressions: write ** for powers"),
        ("t = 1", "= compares nothing: write == for equal numbers"),
        ("", "is an expression without content: "),
        ("t < bad", "bad divides by zero, where t = 0.2 and bad = =1/0"),
        ("1/(radius - 3) < t", "divides by zero, where radius = 3 and t = 0.2"),
        ("sqrt(2 - radius*t) < 1", "sqrt(-0.4) is not defined, where radius = 3 and t = 0.8"),
    ],
)
def test_refusals(text: str, message: str) -> None:
    try:
        read_comparison(text)
    except ExpressionError as error:
        told = error.message.words
    else:
        [(key, told)] = message_of(text)
        assert key == "constraints[0]"
    assert told.startswith(message)


def test_a_design_of_which_nothing_is_left_is_refused() -> None:
    [(key, told)] = message_of("t > 1", "radius > 2")
    assert key == "constraints"
    assert told == "leave none of 64 points: t > 1 is broken by 64; radius > 2 is broken by 32"
