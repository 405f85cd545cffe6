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
    deck("nothing but NUL", b"\0" * 1000),
    deck("NUL amid a name", BLOCK.replace("stone", "sto\0ne")),
    deck("bad UTF-8", BLOCK.encode() + b"title: \xff\xfe\n"),
    deck("overlong UTF-8", b"mbla: 1\ntitle: \xc0\xaf\n"),
    deck("UTF-8 of a surrogate", b"mbla: 1\ntitle: \xed\xa0\x80\n"),
    deck("UTF-8 cut short", BLOCK.encode() + b"# \xf0\x9f"),
    deck("UTF-16 with mark", BLOCK.encode("utf-16")),
    deck("UTF-16 big end first", b"\xfe\xff" + BLOCK.encode("utf-16-be")),
    deck("UTF-16 without mark", BLOCK.encode("utf-16-le")),
    deck("UTF-32", BLOCK.encode("utf-32")),
    deck("UTF-7", b"+AG0-bla: 1\n"),
    deck("Latin-1", "mbla: 1\ntitle: Gewölbe\n".encode("latin-1")),
    deck("EBCDIC", BLOCK.encode("cp500")),
    deck("a byte order mark amid the text", BLOCK.replace("joints:", "\ufeffjoints:")),
    deck("escape sequences of a terminal", BLOCK + "title: \x1b[2J\x1b]0;mbla\x07\n"),
    deck("escape sequences written as escapes", BLOCK + 'title: "\\e[2J"\n'),
    deck("a bell in a key", BLOCK + '"\\a": 1\n'),
    deck("control characters of the second set", BLOCK + "title: \x9b2J\n"),
    deck("text turned from right to left", BLOCK + "\u202etitle\u202c: 1\n"),
    deck("letters of another alphabet that look alike", with_text("density", "densіty")),
    deck("blank of no width in a key", with_text("density", "den\u200bsity")),
    deck("digits of another script", with_text("2000", "٢٠٠٠")),
    deck("full-width digits", with_text("2000", "２０００")),
    deck("characters that Unicode never assigns", BLOCK + "title: \uffff\n"),
    deck("a zip file", b"PK\x03\x04" + bytes(range(256)) * 10),
    deck("a gzip file", b"\x1f\x8b\x08\x00" + bytes(range(256))),
    deck("an executable", b"\x7fELF\x02\x01\x01" + b"\0" * 500),
    deck("a pickle", b"\x80\x04\x95\x10\x00\x00\x00\x00\x00\x00\x00\x8c\x05posix\x94\x8c\x06system\x94\x93\x94."),
    deck("XML with entities", '<!DOCTYPE d [<!ENTITY a "b"><!ENTITY c "&a;&a;">]><d>&c;</d>'),
    Case("1 GB of zeros", _sparse(1024 * MEGABYTE)),
    Case("1 TB of zeros behind a deck", _sparse(1024**4, BLOCK.encode())),
    deck("17 MB of blanks", b" " * (17 * MEGABYTE)),
    deck("10 MB of blanks", b" " * (10 * MEGABYTE)),
    deck("10 MB of line breaks", b"\n" * (10 * MEGABYTE)),
    deck("10 MB of carriage returns", b"\r" * (10 * MEGABYTE)),
    deck("10 MB of comment", BLOCK + "oops: 1 #" + "x" * (10 * MEGABYTE)),
    deck("10 MB in one word", b"x" * (10 * MEGABYTE)),
    deck("10 MB in one quoted text", BLOCK + 'title: "' + "x" * (10 * MEGABYTE) + '"\n'),
    deck("10 MB in one key", BLOCK + "? " + "x" * (10 * MEGABYTE) + "\n: 1\n"),
    deck("10 MB in one line of a block", BLOCK + "title: |\n  " + "x" * (10 * MEGABYTE) + "\n"),
    deck("10 MB of wide characters", BLOCK + "title: " + "😀" * (10 * MEGABYTE // 4) + "\n"),
]

YAML = [
    deck("10,000 brackets", "[" * 10_000),
    deck("1,000,000 brackets", "[" * 1_000_000),
    deck("1,000,000 braces", "{" * 1_000_000),
    deck("1,000,000 brackets in a section", BLOCK + "expected: " + "[" * 1_000_000),
    deck("1,000,000 dashes", "- " * 1_000_000),
    deck("1,000,000 question marks", "? " * 1_000_000),
    deck("10,000 levels of indentation", "".join(" " * n + "a:\n" for n in range(3000))),
    deck("100,000 closing brackets", BLOCK + "]" * 100_000),
    deck("aliases of aliases", LAUGHS),
    deck(
        "aliases of aliases in a section",
        BLOCK + "expected:\n" + "".join("  " + each for each in LAUGHS.splitlines(True)),
    ),
    deck("an alias of itself", "mbla: &a [*a]\n"),
    deck("an alias of nothing", "mbla: *nothing\n"),
    deck("100,000 aliases", "mbla: &a 1\nblocks: [" + "*a, " * 100_000 + "]\n"),
    deck("100,000 anchors", "blocks: [" + ", ".join(f"&a{n} x" for n in range(100_000)) + "]\n"),
    deck("merge keys", "mbla: 1\n<<: {mbla: 1}\n"),
    deck("a tag of Python", "mbla: !!python/object/apply:os.system ['touch written']\n"),
    deck("a tag of Python for names", "mbla: !!python/name:os.system\n"),
    deck("a tag of its own", "%TAG ! tag:x.org,2000:\n--- !deck\nmbla: 1\n"),
    deck("a tag that makes a number of a text", with_text("2000", '!!float "2000"')),
    deck("binary data", BLOCK + "title: !!binary R0lGODlh\n"),
    deck("a set", BLOCK + "expected: !!set {push}\n"),
    deck("duplicate keys", BLOCK + "mbla: 1\n"),
    deck("duplicate keys in quotes", BLOCK + '"mbla": 1\n'),
    deck("duplicate keys with an escape", BLOCK + '"mb\\x6ca": 1\n'),
    deck("1,000,000 duplicate keys", BLOCK + "expected: {" + "a: 1, " * 1_000_000 + "}\n"),
    deck("20,000 unknown keys", BLOCK + "".join(f"k{n}: 1\n" for n in range(20_000))),
    deck("200,000 unknown keys", BLOCK + "".join(f"k{n}: 1\n" for n in range(200_000))),
    deck(
        "50 mappings of 1,000 unknown keys",
        BLOCK
        + "loads:\n"
        + "".join(f"  l{m}: [{{{', '.join(f'k{n}: 1' for n in range(1000))}}}]\n" for m in range(50)),
    ),
    deck("100,000 wrong items", BLOCK + "masses: [" + "x, " * 100_000 + "]\n"),
    deck("8,000,000 wrong items", BLOCK + "masses: [" + "x," * 8_000_000 + "]\n"),
    deck("100,000 wrong numbers", with_text("min: [0, 0, 0]", "min: [" + "x, " * 100_000 + "]")),
    deck("20,000 wrong items", BLOCK + "masses: [" + "x, " * 20_000 + "]\n"),
    deck("10,000 wrong blocks", with_text("blocks:\n", "blocks:\n" + "  - {bax: {}}\n" * 10_000)),
    deck(
        "5,000 unknown materials",
        with_text("blocks:\n", "blocks:\n" + "  - {box: {material: q, min: [0, 0, 0], max: [1, 1, 1]}}\n" * 5_000),
    ),
    deck("500,000 nothings", BLOCK + "masses: [" + "~, " * 500_000 + "]\n"),
    deck("1,000,000 documents", "---\n" * 1_000_000),
    deck("a second deck", BLOCK + "---\n" + BLOCK),
    deck("directives", "%YAML 9.9\n---\n" + BLOCK),
    deck("10,000 directives", "%FOO bar\n" * 10_000 + "---\n" + BLOCK),
    deck("a key that is a list", "? [a, b]\n: 1\n"),
    deck("a key that is a mapping of mappings", "? {a: {b: {c: d}}}\n: 1\n"),
    deck("an unfinished quote", BLOCK + "title: '" + "a " * 100_000),
    deck("an unfinished bracket", BLOCK + "masses: [" + "a, " * 100_000),
    deck("tabs", BLOCK.replace("  ", "\t")),
    deck("nothing but a comment", "# mbla: 1\n"),
    deck("infinity", with_text("2000", ".inf")),
    deck("not a number", with_text("2000", ".nan")),
    deck("1e999", with_text("2000", "1e999")),
    deck("-1e308", with_text("2000", "-1e308")),
    deck("an integer of 300 digits", with_text("2000", "9" * 300) + "oops: 1\n"),
    deck("an integer of 5,000 digits", with_text("2000", "9" * 5000)),
    deck("an integer of 5,000,000 digits", with_text("2000", "9" * 5_000_000)),
    deck("a hexadecimal integer of 1,000,000 digits", with_text("2000", "0x" + "f" * 1_000_000)),
    deck("a number of 1,000,000 decimals", with_text("2000", "-0." + "0" * 1_000_000 + "1")),
    deck("an exponent of 1,000,000 digits", with_text("2000", "1e" + "9" * 1_000_000)),
    deck("a number by sixties", with_text("2000", "12:30:45")),
    deck("a date", with_text("2000", "2001-12-14t21:59:43.10-05:00")),
]

EXPRESSIONS = {
    "a tower of powers": "=9**9**9",
    "a tower of powers that is finite": "=9**9**9**0 - 10**9",
    "attributes": "=().__class__",
    "attributes of a number": "=(1).__class__.__bases__[0].__subclasses__()",
    "an import": "=__import__('os').system('touch written')",
    "a function of Python": "=eval('1')",
    "opening a file": "=open('/etc/passwd').read()",
    "a lambda": "=(lambda: 1)()",
    "a generator": "=sum(x for x in [1])",
    "a list of lists": "=[[0]*99999999]*99999999",
    "a text repeated": "='a'*999999999999",
    "bytes repeated": "=b'a'*999999999999",
    "a text with a format": "=f'{1:>999999999}'",
    "a shift": "=1<<999999999999",
    "a complex number": "=(-1)**0.5",
    "an assignment": "=(x:=1)",
    "a star": "=max(*[1,2])",
    "a keyword": "=round(1.5, ndigits=99999999)",
    "a factorial": "=factorial(999999)",
    "rounding to many digits": "=round(1.5, 999999999)",
    "290 parentheses": "=" + "(" * 290,
    "290 signs": "=" + "-" * 290 + "1",
    "290 calls": "=" + "abs(" * 58 + "1" + ")" * 58,
    "10 MB": "=1" + "+1" * (5 * MEGABYTE),
    "an integer of 290 digits too many": "=" + "9" * 290 + "**2",
    "a hexadecimal integer": "=0x" + "f" * 280,
    "a name in full-width letters that is none": "=ｏｓ",
    "an underscore": "=_",
    "dunder names": "=__builtins__",
    "a comparison": "=1<2<3",
    "a condition": "=1 if 1 else 2",
    "an ellipsis": "=...",
    "a slice": "=mu[0:9]",
    "a line break": "=1\\n+1;import os",
    "a division by zero": "=1/0",
    "a remainder of zero": "=1%0",
    "an overflow of exp": "=exp(1e9)",
    "a logarithm of nothing": "=log(0)",
    "a unit of powers": "9**9**9 m",
    "a unit that is a name of Python": "1 __import__",
    "a unit of many parts": "1 " + "m*" * 40 + "m",
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
    "with a backslash": "a\\\\b",
    "of dots": "..",
    "of a point": ".",
    "empty": "",
    "of 10 kB": "x" * 10_000,
    "of 1 MB": "x" * MEGABYTE,
    "of blanks": "   ",
    "with an escape": "\\e[2J",
    "from right to left": "\\u202ex",
    "that begins with a dash": "-rf",
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
