"""What is done to a file once it is written."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tests.trust.geometry.formats import Files, Format
from tests.trust.geometry.shapes import EITHER, REFUSED, SAME, TOLD, Expect, Generator
from tests.trust.geometry.stones import Stone

Damage = Callable[[bytes, Generator], bytes]

CHECKED = ("obj", "stl", "ply", "vtu", "vtu cells", "msh", "compas", "table of vertices", "table of faces")
"""formats in which a line less or more is noticed; an element less of a CalculiX file is not"""


def text(kind: Format) -> bool:
    """Formats that are text."""
    return not kind.binary


def anything(_: Format) -> bool:
    """Every format."""
    return True


def checked(kind: Format) -> bool:
    """Formats that notice a line less or more."""
    return kind.name in CHECKED


@dataclass(frozen=True)
class TextFault:
    """One thing that is done to the first file of stones; ``times`` it is done, each with another seed."""

    name: str
    damage: Damage
    expect: Expect
    suits: Callable[[Format], bool] = text
    times: int = 1
    told: frozenset[str] = frozenset()


def _as(change: Callable[[bytes], bytes]) -> Damage:
    """The same for every seed."""
    return lambda content, random: change(content)


def cut(content: bytes, random: Generator) -> bytes:
    return content[: int(random.uniform(0.02, 0.97) * len(content))]


def cut_short(content: bytes, random: Generator) -> bytes:
    """The last figures are missing."""
    return content.rstrip()[: -int(random.integers(2, 12))]


def cut_at_the_start(content: bytes, random: Generator) -> bytes:
    return content[int(random.uniform(0.05, 0.9) * len(content)) :]


def _line_ends(*kinds: bytes) -> Damage:
    """Each line with one of these at its end."""

    def damage(content: bytes, random: Generator) -> bytes:
        lines = content.split(b"\n")
        ends = [kinds[int(random.integers(len(kinds)))] for _ in lines]
        return b"".join(line + end for line, end in zip(lines, ends, strict=True))

    return damage


def _amid(more: bytes) -> Damage:
    """Some bytes more."""

    def damage(content: bytes, random: Generator) -> bytes:
        at = int(random.integers(len(content)))
        return content[:at] + more + content[at:]

    return damage


def line_missing(content: bytes, random: Generator) -> bytes:
    lines = content.split(b"\n")
    del lines[int(random.integers(len(lines) - 1))]
    return b"\n".join(lines)


def line_twice(content: bytes, random: Generator) -> bytes:
    lines = content.split(b"\n")
    row = int(random.integers(len(lines) - 1))
    return b"\n".join([*lines[: row + 1], *lines[row:]])


def rubbish_at_the_end(content: bytes, random: Generator) -> bytes:
    return content + bytes(random.integers(0, 256, 100, dtype=np.uint8))


def random_bytes(content: bytes, random: Generator) -> bytes:
    return bytes(random.integers(0, 256, len(content), dtype=np.uint8))


UNUSED = frozenset({"file-vertices-unused"})

TEXT_FAULTS = (
    TextFault("empty file", _as(lambda _: b""), REFUSED, anything),
    TextFault("blank file", _as(lambda _: b" \n\t\n\n"), REFUSED, anything),
    TextFault("first line only", _as(lambda content: content.split(b"\n")[0] + b"\n"), REFUSED, anything),
    TextFault("random bytes", random_bytes, REFUSED, anything),
    TextFault("cut off", cut, TOLD, anything, times=4, told=UNUSED),
    TextFault("last figures missing", cut_short, EITHER, anything),
    TextFault("begins in the middle", cut_at_the_start, REFUSED, anything),
    TextFault("line ends of Windows", _as(lambda content: content.replace(b"\n", b"\r\n")), SAME),
    TextFault("mixed line ends", _line_ends(b"\n", b"\r\n"), SAME),
    TextFault("line ends of old Macs", _as(lambda content: content.replace(b"\n", b"\r")), EITHER),
    TextFault("line ends of three kinds", _line_ends(b"\n", b"\r\n", b"\r"), EITHER),
    TextFault("byte order mark", _as(lambda content: b"\xef\xbb\xbf" + content), EITHER),
    TextFault("UTF-16", _as(lambda content: content.decode("latin-1").encode("utf-16")), EITHER),
    TextFault("NUL amid the text", _amid(b"\0"), EITHER),
    TextFault("bytes that are no UTF-8", _amid(b"\xff\xfe"), EITHER),
    TextFault("line missing", line_missing, EITHER, checked, times=4),
    TextFault("line twice", line_twice, EITHER, checked, times=4),
    TextFault("rubbish at the end", rubbish_at_the_end, EITHER, anything),
)


# --- one number of a file ---------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class NumberFault:
    """Another text in place of one number of the file: a coordinate, or the number of a corner.

    spelt : the text, with {} where the number was
    """

    spelt: str
    expect: Expect


COORDINATES = (
    *(
        NumberFault(words, REFUSED)
        for words in ("one", "--1", "{}e999", "-{}E+400", "1.2.3", "{},5", "{}m", "0x1p3", "nan", "-inf", "1e308")
    ),
    *(
        NumberFault(words, EITHER)
        for words in ("+{}", "{}e", "{}e0", "{}E+00", "{}d0", "00{}", "", '"{}"', "true", "null", "[{}]")
    ),
)
CORNERS = (
    *(NumberFault(words, REFUSED) for words in ("corner", "{}.5", "{}e40", "99999999", "9" * 25, "-99999", "1e999")),
    *(NumberFault(words, EITHER) for words in ("{}.0", "+{}", "0{}", "", "-0", '"{}"', "true", "null", "{}_0", "-1")),
)


def with_number(files: Files, marked: Files, fault: NumberFault) -> Files | None:
    """The files with another text where the first of them differs from the one with a mark; None where none does.

    marked : the same files, one number of the first being another
    """
    name = next(iter(files))
    token = re.compile(rb"[-+.\w]+")
    for one, other in zip(token.finditer(files[name]), token.finditer(marked[name]), strict=True):
        if one[0] != other[0]:
            spelt = fault.spelt.replace("{}", one[0].decode()).encode()
            return {**files, name: files[name][: one.start()] + spelt + files[name][one.end() :]}
    return None


def mark_coordinate(stones: list[Stone], random: Generator) -> list[Stone]:
    """A coordinate elsewhere, of a corner with a height and a distance along the arch that are not zero."""
    row, corner = int(random.integers(1, len(stones) - 1)), int(random.integers(4, 8))
    x, y, z = stones[row].corners[corner]
    return [stone.with_corner(corner, (x + 0.25, y, z)) if n == row else stone for n, stone in enumerate(stones)]


def mark_corner(stones: list[Stone], random: Generator) -> list[Stone]:
    """The first corner of a face another one; the first, as all triangles of the face have it."""
    row, face = int(random.integers(1, len(stones) - 1)), int(random.integers(6))
    other = next(corner for corner in range(8) if corner not in stones[row].faces[face])
    instead = (other, *stones[row].faces[face][1:])
    return [stone.with_face(face, instead) if n == row else stone for n, stone in enumerate(stones)]
