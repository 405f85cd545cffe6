from __future__ import annotations

from pathlib import Path

import pytest

from mbla.errors import Message
from mbla.model.tables import MOST_FAULTS, TableRefused, read_table


def table(folder: Path, text: str | bytes) -> Path:
    path = folder / "t.csv"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def refused(path: Path, **keys: bool) -> tuple[str, ...]:
    with pytest.raises(TableRefused) as caught:
        read_table(path, ("block", "x"), () if keys else ("y",), **keys)
    return caught.value.faults


@pytest.mark.parametrize(
    "text",
    [
        "block,x,y\na,1.5,2\nb,-3e2,0\n",
        "\ufeffy;Block;X\r\n2;a;1,5\r\n\r\n# remark\r\n0;b;-3e2\r\n",
        '# made by hand\n y , block , x \n"2","a", 1.5\n 0,b,-300,,\n',
    ],
)
def test_columns_in_any_order_comments_and_decimal_commas(tmp_path: Path, text: str) -> None:
    read = read_table(table(tmp_path, text), ("block", "x"), ("y",))
    assert read.numbers("xy").tolist() == [[1.5, 2], [-300, 0]]
    assert read.columns["block"] == ["a", "b"]
    assert read.faults == []


def test_lines_are_counted_with_comments_and_empty_ones(tmp_path: Path) -> None:
    read = read_table(table(tmp_path, "# one\nblock,x\n\na,1\n# two\nb,2\n"), ("block", "x"))
    assert read.lines == [4, 6]


def test_rows_may_go_on(tmp_path: Path) -> None:
    read = read_table(table(tmp_path, "block,x,v1,v2\na,1,7,8,9,10\nb,2,7\n"), ("block", "x"), with_rest=True)
    assert read.rest == [["7", "8", "9", "10"], ["7"]]


@pytest.mark.parametrize(
    ("text", "faults"),
    [
        ("", ("t.csv: is empty: its first line must name the columns block and x",)),
        ("block,x\n", ("t.csv: has no rows below its header",)),
        (
            "blok,x\na,1\n",
            (
                "t.csv:1: unknown column blok; did you mean block? columns are block, x and y",
                "t.csv:1: column block is missing",
            ),
        ),
        ("block,x,x\na,1,2\n", ("t.csv:1: column x is there twice",)),
        ("block,x\na\nb,1,2\n", ("t.csv:2: has 1 columns instead of 2 (block, x)", "t.csv:3: has more columns than")),
        ('block,x\n"a,1\n', ("t.csv:2: cannot be read: unexpected end of data",)),
        (b"block,x\n\xff,1\n", ("t.csv: is not UTF-8 text: save it as CSV UTF-8",)),
    ],
)
def test_refused(tmp_path: Path, text: str | bytes, faults: tuple[str, ...]) -> None:
    found = refused(table(tmp_path, text))
    assert len(found) == len(faults)
    assert all(one.startswith(other) for one, other in zip(found, faults, strict=True))


def test_missing_file(tmp_path: Path) -> None:
    assert refused(tmp_path / "t.csv") == ("t.csv: cannot be read: No such file or directory",)


def test_header_of_a_table_whose_rows_go_on(tmp_path: Path) -> None:
    path = table(tmp_path, "x,block,v1\na,1,7\n")
    assert refused(path, with_rest=True) == ("t.csv:1: the header must begin with block,x, not x,block",)


@pytest.mark.parametrize("text", ["abc", "", "nan", "inf", "1_000", "1,5", "0x10"])
def test_no_numbers(tmp_path: Path, text: str) -> None:
    quoted = f'"{text}"' if "," in text else text
    read = read_table(table(tmp_path, f"block,x\na,{quoted}\n"), ("block", "x"))
    read.numbers("x")
    assert read.faults == [f"t.csv:2: x = {text or '(empty)'}: must be a finite number"]


def test_many_faults_are_counted() -> None:
    faults = TableRefused(*(Message("table-row", f"fault {number}") for number in range(25))).faults
    assert len(faults) == MOST_FAULTS + 1
    assert faults[-1] == "15 more faults of this table"
