from __future__ import annotations

import string

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mbla.deck.text.reader import MAX_DEPTH, MOST_ITEMS, MOST_KEYS, read_yaml
from mbla.deck.text.sources import SourceText
from mbla.deck.text.tree import (
    FILE_SHIFT,
    OFFSET_MASK,
    MappingMarks,
    SequenceMarks,
    Tree,
    key_text,
    plain_scalar,
    shorten,
)
from mbla.errors import MOST_FAULTS, KeyPath, Message


def read(text: str) -> tuple[object, list[str]]:
    document = read_yaml(SourceText("deck", text), 0)
    return document.data, [str(fault) for fault in document.faults]


def test_block_and_flow_style_agree() -> None:
    block = "a:\n  - 1\n  - x: two\n    y: [3, 4.5]\nb: {c: ''}\n"
    flow = "{a: [1, {x: two, y: [3, 4.5]}], b: {c: ''}}"
    assert read(block) == read(flow) == ({"a": [1, {"x": "two", "y": [3, 4.5]}], "b": {"c": ""}}, [])


def test_quoted_scalars_are_text() -> None:
    assert read("{a: '1', b: \"true\", c: '', d: |\n 1\n}")[1] != []
    assert read("a: '1'\nb: \"true\"\nc: ''\nd: |\n  1\n")[0] == {"a": "1", "b": "true", "c": "", "d": "1\n"}


def test_words_of_yaml_1_1_are_text_as_keys_too() -> None:
    assert read("{on: lintel, no: yes, y: off}") == ({"on": "lintel", "no": "yes", "y": "off"}, [])


def test_marks_point_at_first_characters() -> None:
    text = "ä: [1, {b: 'c'}]\nd:\n  - -2\n"
    document = read_yaml(SourceText("deck", text), 3)
    marks = document.marks
    assert isinstance(marks, MappingMarks)
    items = marks.values["ä"]
    assert isinstance(items, SequenceMarks)
    inner = items.items[1]
    assert isinstance(inner, MappingMarks)
    places = [
        marks.keys["ä"],
        items.own,
        items.items[0],
        inner.own,
        inner.keys["b"],
        inner.values["b"],
        marks.keys["d"],
    ]
    assert [mark & OFFSET_MASK for mark in places if isinstance(mark, int)] == [0, 3, 4, 7, 8, 11, 17]
    assert all(mark >> FILE_SHIFT == 3 for mark in places if isinstance(mark, int))


def test_place_of_a_value_deep_inside() -> None:
    source = SourceText("deck", "a:\n  - x: 1\n  - {x: [0, -0.6]}\n")
    document = read_yaml(source, 0)
    assert isinstance(document.marks, MappingMarks)
    tree = Tree(document.data, document.marks, [source])
    assert str(tree.fault(("a", 1, "x", 1), Message("not-a-number", "no"))) == "deck:3:13 a[1].x[1] = -0.6: no"


def test_depth_limit_is_exact() -> None:
    assert read("[" * MAX_DEPTH + "]" * MAX_DEPTH)[1] == []
    assert read("[" * (MAX_DEPTH + 1) + "]" * (MAX_DEPTH + 1))[1] == [
        f"deck:1:{MAX_DEPTH + 1} is nested more than {MAX_DEPTH} levels deep"
    ]


@pytest.mark.parametrize("opening", ["[", "{a: ", "- ", "? "])
def test_hostile_nesting(opening: str) -> None:
    *_, fault = read(opening * 100_000)[1]
    assert "levels deep" in fault


def test_keys_of_a_mapping_are_counted() -> None:
    keys = "".join(f"k{n}: 1\n" for n in range(MOST_KEYS))
    assert read(keys)[1] == []
    assert read(f"{keys}last: 1\nafter: &a 1\n")[1] == [
        "deck:10001:1 last: is one key too many: a mapping has at most 10,000"
    ]


@pytest.mark.parametrize(("item", "extra"), [("1", "2"), ("1", "[2]"), ("[1]", "2")])
def test_items_of_a_list_are_counted(item: str, extra: str) -> None:
    items = f"{item}, " * MOST_ITEMS
    assert read(f"a: [{items}]")[1] == []
    assert read(f"a: [{items}\n{extra}, &a 1]")[1] == [
        "deck:2:1 a[100000]: is one item too many: a list has at most 100,000"
    ]


def test_alias_bomb_is_refused_before_it_grows() -> None:
    lines = ["a0: &a0 [x, x]"] + [f"a{i}: &a{i} [*a{i - 1}, *a{i - 1}]" for i in range(1, 30)]
    data, faults = read("\n".join(lines))
    assert len(faults) == 30 + 2 * 29
    assert isinstance(data, dict)
    assert data["a29"] == [None, None]


def test_first_of_two_keys_stands_and_the_rest_is_read() -> None:
    data, faults = read("a: 1\na: {b: .nan}\nc: 2\n")
    assert data == {"a": 1, "c": 2}
    assert faults == ["deck:2:1 a: is given twice, first in line 1", "deck:2:8 b = .nan: must be a finite number"]


# An underscore stands for a blank.
SYNTAX = r"""[ ] { } , :_ -_ ? &a_ *a !!str_ <<:_ | > ' " \ # --- ... %YAML_1.2 a b:_1 true 1e3 .inf ~ = @ `"""
YAML_PIECES = st.sampled_from(
    [*(piece.replace("_", " ") for piece in SYNTAX.split()), "\n", "\n  ", "\t", "\u2028", "\U0001f600"]
)


@given(st.lists(YAML_PIECES, max_size=40).map("".join))
def test_any_text_is_read_or_refused(text: str) -> None:
    source = SourceText("deck", text)
    document = read_yaml(source, 0)
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    for fault in document.faults:
        assert 1 <= fault.place.line <= len(lines) + 1
    assert document.complete or document.faults


JSON = st.recursive(
    st.booleans() | st.integers(-(2**53), 2**53) | st.floats(-1e300, 1e300) | st.text(string.printable, max_size=8),
    lambda below: (
        st.lists(below, max_size=4) | st.dictionaries(st.text(string.ascii_letters, min_size=1), below, max_size=4)
    ),
    max_leaves=20,
)


@given(JSON)
def test_json_is_read_as_json(value: object) -> None:
    import json

    document = read_yaml(SourceText("deck", json.dumps(value)), 0)
    control = any(ord(c) < 32 and c not in "\n\r\t" for c in json.dumps(value).encode().decode("unicode_escape"))
    if not control:
        assert document.faults == []
    assert document.data == value


def test_reading_ends_after_a_thousand_faults() -> None:
    _, faults = read("[" + "~, " * (MOST_FAULTS + 500) + "]")
    assert len(faults) == MOST_FAULTS + 1
    assert faults[0] == "deck:1:2 [0] = ~: has no value: give one, or leave the key out"
    assert faults[-1] == f"deck:1:{3 * MOST_FAULTS - 1} is read no further after 1000 faults"


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
