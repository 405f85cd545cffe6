"""The table of decks/README.md, made from the decks; ``python -m tests.decks.readme_table`` writes it again."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from mbla.deck.sections.output import Expectation
from tests.decks.folder import DECKS, PATHS, deck_of

BEGIN = "<!-- table: python -m tests.decks.readme_table -->\n"
END = "<!-- end of table -->\n"
README = DECKS / "README.md"


def table() -> str:
    """One line for each load case of each deck."""
    lines = ["| deck | structure | load case | expected load factor | source |", "|---|---|---|---|---|"]
    for path in PATHS:
        lines += _rows(path)
    return "\n".join(lines) + "\n"


def _rows(path: Path) -> Iterator[str]:
    content = deck_of(path).content
    place = path.relative_to(DECKS).as_posix()
    name = f"[{place}]({place})"
    title = content.title
    for case, expectation in content.expected.items():
        source = expectation.source.replace("|", "/")
        yield f"| {name} | {title} | {case} | {_figure(expectation, content.analysis.flow_rule)} | {source} |"
        name = title = ""


def _figure(expectation: Expectation, flow_rule: str) -> str:
    """The factor by the deck's flow rule, the associative one where it differs, a status other than solved."""
    own, associative = expectation.load_factor, expectation.associative_load_factor
    words = [] if expectation.reaction is None else [f"reaction {expectation.reaction:.8g}"]
    if own is not None:
        words.append(f"{own:.8g}")
    if expectation.angle is not None:
        words.append(f"{expectation.angle:.8g} degrees")
    if expectation.position is not None:
        words.append(f"worst at position {expectation.position}")
    if associative is not None and (own is None or abs(own - associative) > 1e-9):
        words.append(f"associative {associative:.8g}")
    if expectation.lower is not None:
        words.append(f"least {expectation.lower:.8g}")
    if expectation.status not in (None, "solved"):
        words.append(str(expectation.status))
    if flow_rule == "associative" and words and (own, expectation.reaction) != (None, None):
        words[0] = f"associative {words[0]}"
    return ", ".join(words)


def with_table(text: str) -> str:
    """The page with its table renewed."""
    before, rest = text.split(BEGIN)
    _, after = rest.split(END)
    return before + BEGIN + table() + END + after


def main() -> None:
    """Write the page again."""
    README.write_text(with_table(README.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
