"""Decks that are hostile as texts: their bytes, their YAML, their names, their expressions."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from tests.line import BLOCK
from tests.trust.hostile.case import Case, deck

MEGABYTE = 1024 * 1024


def with_text(old: str, new: str) -> str:
    """The deck of one block with something else in one place."""
    assert old in BLOCK
    return BLOCK.replace(old, new, 1)


def _sparse(size: int, begin: bytes = b"") -> Callable[[Path], None]:
    """A file of zeros, or of blanks that are on the disk in a few places only."""

    def write(folder: Path) -> None:
        with (folder / "deck.yaml").open("wb") as file:
            file.write(begin)
            file.truncate(size)

    return write


LAUGHS = "a: &a [x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{b}: &{b} [{', '.join([f'*{a}'] * 9)}]\n" for a, b in zip("abcdefgh", "bcdefghi", strict=True)
)
"""each alias stands for nine of the one before: 9^9 texts"""

BYTES = [
    deck("empty file", b""),
    deck("NUL bytes", b"mbla: 1\0\0\0"),
    deck("bad UTF-8", BLOCK.encode() + b"title: \xff\xfe\n"),
    deck("UTF-16 with mark", BLOCK.encode("utf-16")),
    deck("Latin-1", "mbla: 1\ntitle: Gewölbe\n".encode("latin-1")),
    deck("escape sequences of a terminal", BLOCK + "title: \x1b[2J\x1b]0;mbla\x07\n"),
    deck("escape sequences written as escapes", BLOCK + 'title: "\\e[2J"\n'),
    deck("text turned from right to left", BLOCK + "\u202etitle\u202c: 1\n"),
    deck("letters of another alphabet that look alike", with_text("density", "densіty")),
    deck("blank of no width in a key", with_text("density", "den\u200bsity")),
    deck("a zip file", b"PK\x03\x04" + bytes(range(256)) * 10),
    deck("XML with entities", '<!DOCTYPE d [<!ENTITY a "b"><!ENTITY c "&a;&a;">]><d>&c;</d>'),
    Case("1 GB of zeros", _sparse(1024 * MEGABYTE)),
    Case("1 TB of zeros behind a deck", _sparse(1024**4, BLOCK.encode())),
    deck("17 MB of blanks", b" " * (17 * MEGABYTE)),
    deck("10 MB of blanks", b" " * (10 * MEGABYTE)),
    deck("10 MB in one word", b"x" * (10 * MEGABYTE)),
    deck("10 MB in one key", BLOCK + "? " + "x" * (10 * MEGABYTE) + "\n: 1\n"),
    deck("10 MB of wide characters", BLOCK + "title: " + "😀" * (10 * MEGABYTE // 4) + "\n"),
]

YAML = [
    deck("1,000,000 brackets", "[" * 1_000_000),
    deck("1,000,000 dashes", "- " * 1_000_000),
    deck("10,000 levels of indentation", "".join(" " * n + "a:\n" for n in range(3000))),
    deck("aliases of aliases", LAUGHS),
    deck("an alias of itself", "mbla: &a [*a]\n"),
    deck("100,000 aliases", "mbla: &a 1\nblocks: [" + "*a, " * 100_000 + "]\n"),
    deck("a tag of Python", "mbla: !!python/object/apply:os.system ['touch written']\n"),
    deck("a tag of Python for names", "mbla: !!python/name:os.system\n"),
    deck("duplicate keys", BLOCK + "mbla: 1\n"),
    deck("1,000,000 duplicate keys", BLOCK + "expected: {" + "a: 1, " * 1_000_000 + "}\n"),
    deck("200,000 unknown keys", BLOCK + "".join(f"k{n}: 1\n" for n in range(200_000))),
    deck(
        "50 mappings of 1,000 unknown keys",
        BLOCK
        + "loads:\n"
        + "".join(f"  l{m}: [{{{', '.join(f'k{n}: 1' for n in range(1000))}}}]\n" for m in range(50)),
    ),
    deck("8,000,000 wrong items", BLOCK + "masses: [" + "x," * 8_000_000 + "]\n"),
    deck("100,000 wrong numbers", with_text("min: [0, 0, 0]", "min: [" + "x, " * 100_000 + "]")),
    deck(
        "5,000 unknown materials",
        with_text("blocks:\n", "blocks:\n" + "  - {box: {material: q, min: [0, 0, 0], max: [1, 1, 1]}}\n" * 5_000),
    ),
    deck("1,000,000 documents", "---\n" * 1_000_000),
    deck("10,000 directives", "%FOO bar\n" * 10_000 + "---\n" + BLOCK),
    deck("an unfinished quote", BLOCK + "title: '" + "a " * 100_000),
    deck("1e999", with_text("2000", "1e999")),
    deck("an integer of 5,000,000 digits", with_text("2000", "9" * 5_000_000)),
    deck("a hexadecimal integer of 1,000,000 digits", with_text("2000", "0x" + "f" * 1_000_000)),
    deck("a number of 1,000,000 decimals", with_text("2000", "-0." + "0" * 1_000_000 + "1")),
]

EXPRESSIONS = {
    "a tower of powers": "=9**9**9",
    "attributes of a number": "=(1).__class__.__bases__[0].__subclasses__()",
    "an import": "=__import__('os').system('touch written')",
    "a function of Python": "=eval('1')",
    "opening a file": "=open('/etc/passwd').read()",
    "a list of lists": "=[[0]*99999999]*99999999",
    "a text repeated": "='a'*999999999999",
    "a shift": "=1<<999999999999",
    "a complex number": "=(-1)**0.5",
    "a factorial": "=factorial(999999)",
    "290 parentheses": "=" + "(" * 290,
    "10 MB": "=1" + "+1" * (5 * MEGABYTE),
    "dunder names": "=__builtins__",
    "a line break": "=1\\n+1;import os",
    "a division by zero": "=1/0",
    "an overflow of exp": "=exp(1e9)",
    "a unit of powers": "9**9**9 m",
    "a unit beyond all numbers": "1 km^9*km^9*km^9*km^9",
    "a prefix on a prefix": "1 yottayottameter",
}
CYCLE = ", ".join(f'p{n}: "=p{(n + 1) % 5000}"' for n in range(5000))
CHAIN = ", ".join(f'p{n}: "=p{n + 1}*p{n + 1}"' for n in range(5000)) + ", p5000: 9"

NAMES = {
    "up": "../x",
    "at the root": "/etc/passwd",
    "with a NUL": "a\\0b",
    "with a line break": "a\\nb",
    "with a slash": "a/b",
    "of dots": "..",
    "empty": "",
    "of 1 MB": "x" * MEGABYTE,
    "with an escape": "\\e[2J",
    "with HTML": "<script>alert(1)</script>",
    "with a format": "%s%s%n{0}",
}

DECKS = [
    *BYTES,
    *YAML,
    *(
        deck(f"an expression: {name}", with_text("density: 2000", f'density: "{text}"'))
        for name, text in EXPRESSIONS.items()
    ),
    deck("5,000 parameters in a circle", with_text("mu: 0.5", f"mu: 0.5, {CYCLE}")),
    deck("5,000 parameters in a chain that overflows", with_text("mu: 0.5", f"mu: 0.5, {CHAIN}")),
    *(
        deck(f"a load case with a name {name}", BLOCK.replace("  push:", f'  "{text}":'))
        for name, text in NAMES.items()
    ),
    *(
        deck(f"a group with a name {name}", with_text("group: block", f'group: "{text}"'))
        for name, text in NAMES.items()
    ),
]
"""All of them."""
