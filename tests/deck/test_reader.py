from __future__ import annotations

import string

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mbla.deck.reader import MAX_DEPTH, MOST_ITEMS, MOST_KEYS, read_yaml
from mbla.deck.sources import SourceText
from mbla.deck.tree import FILE_SHIFT, OFFSET_MASK, MappingMarks, SequenceMarks, Tree
from mbla.errors import MOST_FAULTS, Message


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


def test_value_after_a_key_that_is_no_text_is_not_taken_for_a_key() -> None:
    assert read("{[a]: 1, {b: 2}: 3, 4: 5, c: 6}") == (
        {"c": 6},
        [
            "deck:1:2 a key must be text",
            "deck:1:10 a key must be text",
            'deck:1:21 a key must be text: write "4" in quotes',
        ],
    )


def test_plain_values_seen_before_keep_their_type() -> None:
    assert repr(read("[1, 1.0, 1, '1', true, True, 0, false]")[0]) == "[1, 1.0, 1, '1', True, True, 0, False]"


def test_offset_shifts_marks() -> None:
    source = SourceText("--set", "a.b=[1, x]", line=1)
    document = read_yaml(source, 0, 4)
    assert document.data == [1, "x"]
    assert isinstance(document.marks, SequenceMarks)
    assert (document.marks.own, document.marks.items) == (4, [5, 8])


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
    assert document.whole or document.faults


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
