from __future__ import annotations

import pytest

from mbla.deck.reader import read_yaml
from mbla.deck.sources import SourceText
from mbla.deck.tree import KeyPath, MappingMarks, Tree, key_text, plain_scalar, shorten
from mbla.errors import Message

TEXT = """a:
  b: {c: -0.60, d: [1, [2,
    3]]}
  e: some words, here
  f: "quoted"
list:
  - x: 1
  - 0x1F
"""


@pytest.fixture
def tree() -> Tree:
    source = SourceText("deck.yaml", TEXT)
    document = read_yaml(source, 0)
    assert isinstance(document.marks, MappingMarks)
    return Tree(document.data, document.marks, [source])


@pytest.mark.parametrize(
    ("path", "line"),
    [
        ((), "1:1 no"),
        (("a",), "1:1 a: no"),
        (("a", "b"), "2:3 a.b: no"),
        (("a", "b", "c"), "2:10 a.b.c = -0.60: no"),
        (("a", "b", "d"), "2:20 a.b.d = [1, [2, 3]]: no"),
        (("a", "b", "d", 1, 1), "3:5 a.b.d[1][1] = 3: no"),
        (("a", "e"), "4:6 a.e = some words, here: no"),
        (("a", "f"), '5:6 a.f = "quoted": no'),
        (("list",), "7:3 list: no"),
        (("list", 0), "7:5 list[0]: no"),
        (("list", 1), "8:5 list[1] = 0x1F: no"),
        (("a", "b", "absent"), "2:3 a.b.absent: no"),
        (("a", "b", "absent", 3, "deeper"), "2:3 a.b.absent[3].deeper: no"),
        (("list", 9), "7:3 list[9]: no"),
    ],
)
def test_place_path_and_value(tree: Tree, path: KeyPath, line: str) -> None:
    assert str(tree.fault(path, Message("not-a-number", "no"))) == f"deck.yaml:{line}"


def test_place_of_key(tree: Tree) -> None:
    assert (
        str(tree.fault(("a", "e"), Message("not-a-number", "no"), at_key=True))
        == "deck.yaml:4:3 a.e = some words, here: no"
    )


def test_long_values_are_cut() -> None:
    assert shorten("x" * 1000) == "x" * 59 + "…"
    assert shorten("x" * 60) == "x" * 60
    assert shorten("two\n  lines") == "two lines"


def test_nothing_reaches_the_terminal_but_text() -> None:
    assert shorten("a\x1b[31mb\u202ec") == "a\ufffd[31mb\ufffdc"
    assert key_text(("a\x07", "x" * 100)) == "a\ufffd." + "x" * 59 + "…"


def test_key_text() -> None:
    assert key_text(("blocks", 3, "wall", "length")) == "blocks[3].wall.length"


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0", 0),
        ("-17", -17),
        ("+5", 5),
        ("017", 17),
        ("0o17", 15),
        ("0x1F", 31),
        ("1e3", 1000.0),
        ("1.e-3", 0.001),
        ("1.0E+3", 1000.0),
        (".5", 0.5),
        ("-.5e1", -5.0),
        ("9007199254740993", 9007199254740992.0),
        ("true", True),
        ("FALSE", False),
        ("null", None),
        ("~", None),
        ("", None),
    ],
)
def test_core_schema(text: str, value: object) -> None:
    result = plain_scalar(text)
    assert result == value
    assert type(result) is type(value)


@pytest.mark.parametrize(
    "text",
    [
        "no",
        "on",
        "y",
        "yes",
        "off",
        "2024-01-31",
        "12:30:45",
        "1_000",
        "1,5",
        "0b11",
        "-0x1F",
        "1e",
        "tRUE",
        "inf",
        "١٢",
    ],
)
def test_text_in_yaml_1_2(text: str) -> None:
    assert plain_scalar(text) == text


@pytest.mark.parametrize("text", [".inf", "-.INF", "+.Inf", ".nan", ".NaN"])
def test_not_finite(text: str) -> None:
    with pytest.raises(ValueError, match="finite"):
        plain_scalar(text)


@pytest.mark.parametrize("text", ["1e999", "-1e999", "9" * 399, "9" * 5000, "0x" + "F" * 380, "0o" + "7" * 5000])
def test_too_large(text: str) -> None:
    with pytest.raises(ValueError, match="too large"):
        plain_scalar(text)
