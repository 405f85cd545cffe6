"""JSON Schema of the deck, generated from its types; ``python -m mbla.deck.schema --write`` writes the files.

A schema sees single values and the keys of one mapping. Names, sums over keys and geometry are left to mbla itself.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from mbla.deck.content import DeckContent
from mbla.deck.key_reference import key_reference
from mbla.deck.section import AT_LEAST_ONE, EXACTLY_ONE

REPOSITORY = Path(__file__).parents[2]
MARKERS = ("<!-- keys:begin -->", "<!-- keys:end -->")


def deck_schema() -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of a whole deck."""
    schema = DeckContent.model_json_schema(by_alias=True)
    definitions = {name: tidy(definition) for name, definition in schema.pop("$defs").items()}
    for section, keys in EXACTLY_ONE.items():
        definitions[section.__name__]["oneOf"] = [{"required": [key]} for key in keys]
    for section, keys in AT_LEAST_ONE.items():
        definitions[section.__name__]["anyOf"] = [{"required": [key]} for key in keys]
    schema = tidy(schema)
    # With an inclusion, what this file lacks may come from another.
    required = [key for key in schema.pop("required") if key != "mbla"]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:mbla:schema:deck:1",
        "title": "mbla deck",
        **schema,
        "required": ["mbla"],
        "if": {"not": {"required": ["include"]}},
        "then": {"required": required},
        "$defs": definitions,
    }


def deck_schema_text() -> str:
    """The schema as the file in ``schemas/`` has it."""
    return json.dumps(deck_schema(), indent=1, ensure_ascii=False) + "\n"


def tidy(node: Any) -> Any:
    """A schema without null values, which no deck has, and without titles that repeat the keys."""
    if isinstance(node, list):
        return [tidy(item) for item in node]
    if not isinstance(node, dict):
        return node
    node = {key: value if key in ("default", "const", "enum") else tidy(value) for key, value in node.items()}
    if isinstance(node.get("title"), str):
        del node["title"]
    if node.get("default", 0) is None:
        del node["default"]
    if "patternProperties" in node:
        node["additionalProperties"] = False
    prefix = node.get("prefixItems")
    if prefix and all(item == prefix[0] for item in prefix):
        node["items"] = node.pop("prefixItems")[0]
    if "anyOf" in node:
        branches = [branch for branch in node.pop("anyOf") if branch != {"type": "null"}]
        node = {**branches[0], **node} if len(branches) == 1 else {"anyOf": branches, **node}
    return node


def write_schema(folder: Path = REPOSITORY) -> list[Path]:
    """Write ``schemas/deck.schema.json`` and, between its markers, the key reference in ``schemas/deck.md``."""
    return write_generated(folder, "deck", deck_schema_text(), MARKERS, with_key_reference)


def write_generated(
    folder: Path, kind: str, schema: str, markers: tuple[str, str], with_reference: Callable[[str], str]
) -> list[Path]:
    """Write the schema of one kind of file, and the page with its key reference where that has the markers."""
    schema_file = folder / "schemas" / f"{kind}.schema.json"
    schema_file.write_text(schema, encoding="utf-8")
    page = folder / "schemas" / f"{kind}.md"
    text = page.read_text(encoding="utf-8") if page.is_file() else ""
    if not all(marker in text for marker in markers):
        return [schema_file]
    page.write_text(with_reference(text), encoding="utf-8")
    return [schema_file, page]


def with_key_reference(text: str) -> str:
    """A text with the key reference between its two markers."""
    return between(text, MARKERS, key_reference())


def between(text: str, markers: tuple[str, str], content: str) -> str:
    """A text with other content between two markers."""
    before, rest = text.split(markers[0], 1)
    after = rest.split(markers[1], 1)[1]
    return f"{before}{markers[0]}\n\n{content}\n{markers[1]}{after}"


def main(arguments: Sequence[str] | None = None) -> None:
    """Entry of ``python -m mbla.deck.schema``."""
    parser = argparse.ArgumentParser(
        prog="python -m mbla.deck.schema", description="Generated files of the deck types."
    )
    parser.add_argument("--write", action="store_true", required=True, help="write schema and key reference")
    parser.parse_args(arguments)
    write_schema()


if __name__ == "__main__":
    main()
