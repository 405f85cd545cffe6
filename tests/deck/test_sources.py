from __future__ import annotations

import os
from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.deck.text.sources import MAX_BYTES, SourceText
from mbla.errors import DeckError, FileError, Message, Place
from tests.deck.decks import BLOCK


def refusal(folder: Path, content: bytes) -> str:
    path = folder / "deck.yaml"
    path.write_bytes(content)
    with pytest.raises(DeckError) as caught:
        read_deck(path)
    (fault,) = caught.value.faults
    return str(fault).replace(f"{path}:", "")


def test_place_counts_lines_however_they_end() -> None:
    source = SourceText("deck.yaml", "a\r\nbc\rd\n\ne")
    assert [source.place(source.text.index(letter)) for letter in "abcde"] == [
        Place("deck.yaml", line, column) for line, column in [(1, 1), (2, 1), (2, 2), (3, 1), (5, 1)]
    ]


def test_byte_order_mark_is_accepted_and_not_counted(tmp_path: Path) -> None:
    path = tmp_path / "deck.yaml"
    path.write_bytes(b"\xef\xbb\xbf" + BLOCK.encode())
    assert read_deck(path).fault_at(("mbla",), Message("not-a-number", "")).place == Place(str(path), 1, 7)


def test_windows_line_ends(tmp_path: Path) -> None:
    path = tmp_path / "deck.yaml"
    path.write_bytes(BLOCK.replace("\n", "\r\n").encode())
    assert read_deck(path).fault_at(("contacts", "joint"), Message("not-a-number", "")).place.line == 11


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be", "utf-32"])
def test_other_encodings(tmp_path: Path, encoding: str) -> None:
    assert any(word in refusal(tmp_path, BLOCK.encode(encoding)) for word in ("UTF-16", "U+0000"))


def test_bad_byte_has_its_place(tmp_path: Path) -> None:
    content = BLOCK.replace("A block", "A bl\xf6ck").encode("latin-1")
    assert refusal(tmp_path, content) == "2:12 byte 0xF6 is not UTF-8: save the deck as UTF-8"


@pytest.mark.parametrize("character", ["\0", "\x07", "\x1b", "\x7f", "\x90", "\ufffe"])
def test_control_characters(tmp_path: Path, character: str) -> None:
    message = refusal(tmp_path, BLOCK.replace("A block", f"A{character}block").encode())
    assert message == f"2:9 control character U+{ord(character):04X} is not allowed in a deck"


def test_size_limit(tmp_path: Path) -> None:
    content = BLOCK.encode() + b"#" * MAX_BYTES
    assert "put large geometry and tables in files of their own" in refusal(tmp_path, content)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("nowhere.yaml", r"nowhere\.yaml: cannot be opened: No such file"),
        (".", "not a regular file"),
        ("/dev/zero", "not a regular file"),
        ("a\0b", "cannot be opened"),
    ],
)
def test_what_is_no_file_to_read(tmp_path: Path, name: str, words: str) -> None:
    with pytest.raises(FileError, match=words):
        read_deck(tmp_path / name)


def test_pipe_does_not_hang(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.yaml")
    with pytest.raises(FileError, match="not a regular file"):
        read_deck(tmp_path / "pipe.yaml")


@pytest.mark.skipif(not Path("/proc/self/mem").exists(), reason="the system shows no memory as a file")
def test_file_that_opens_and_cannot_be_read() -> None:
    with pytest.raises(FileError, match=r"^/proc/self/mem: cannot be read: Input/output error$"):
        read_deck("/proc/self/mem")
