"""JSON Schema and key reference of the deck, generated from its types.

A schema sees single values and the keys of one mapping. Names, sums over keys and geometry are left to mbla itself. The
key reference are Markdown tables. ``python -m mbla.deck.schema --write`` writes the files.
"""

from __future__ import annotations

import inspect
import json
import re
from collections.abc import Iterator
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from mbla.deck.content import DeckContent
from mbla.deck.fields import branches
from mbla.deck.quantities import NAME_PATTERN, PARAMETER_PATTERN, Integer, RealNumber, WithUnit
from mbla.deck.section import EXACTLY_ONE
from mbla.deck.units import DIMENSIONS

REPOSITORY = Path(__file__).parents[2]
MARKERS = ("<!-- keys:begin -->", "<!-- keys:end -->")


def deck_schema() -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of a complete deck."""
    schema = DeckContent.model_json_schema(by_alias=True)
    definitions = {name: tidy(definition) for name, definition in schema.pop("$defs").items()}
    for section, keys in EXACTLY_ONE.items():
        definitions[section.__name__]["oneOf"] = [{"required": [key]} for key in keys]
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


def generated_files(kind: str, schema: dict[str, Any], reference: str) -> dict[Path, str]:
    """Schema of a kind of file, and its page with the key reference between the markers, as they are to be written."""
    folder = REPOSITORY / "schemas"
    page = folder / f"{kind}.md"
    before, rest = page.read_text(encoding="utf-8").split(MARKERS[0], 1)
    return {
        folder / f"{kind}.schema.json": json.dumps(schema, indent=1, ensure_ascii=False) + "\n",
        page: f"{before}{MARKERS[0]}\n\n{reference}\n{MARKERS[1]}{rest.split(MARKERS[1], 1)[1]}",
    }


def key_reference() -> str:
    """A table for every section of the deck: key, value with its unit, default, meaning."""
    introduction = (
        "Units: L, F and M stand for the deck's units of length, force and mass. Wherever a number is asked for, "
        'an expression `"=..."` may stand; where it has a unit, also a text such as `"18 kN/m^3"`. '
        "Angles are in degrees, in expressions too: sin, cos and tan take degrees, asin, acos, atan and atan2 give "
        "them.\n"
    )
    return "\n".join([introduction, *section_tables(DeckContent, "deck")])


def section_tables(root: type[BaseModel], name: str) -> Iterator[str]:
    """A table for every section of a kind of file; ``name`` is the title of the file."""
    places: dict[type[BaseModel], list[str]] = {}
    _collect(root, "", places)
    short = {section: _joined(titles) or name for section, titles in places.items()}
    for section, titles in places.items():  # in the order of the file, each once, with all places where it stands
        alike = list(short.values()).count(short[section]) > 1
        yield _table(", ".join(dict.fromkeys(titles)) if alike else short[section], section)


def _collect(section: type[BaseModel], title: str, places: dict[type[BaseModel], list[str]]) -> None:
    """Places of a section and of all below it; the recursion ends because sections do not hold themselves."""
    places.setdefault(section, []).append(title)
    for name, field in section.model_fields.items():
        for suffix, below in _sections_in(field.annotation, ""):
            _collect(below, f"{title}.{field.alias or name}{suffix}".lstrip("."), places)


def _joined(titles: list[str]) -> str:
    """One title for places that differ in one key (``blocks[].*.transform``), or all of them."""
    unique = list(dict.fromkeys(title.removesuffix("[]") for title in titles))
    if len(unique) == 1:
        return titles[0]
    keys = [title.split(".") for title in unique]
    if len({len(each) for each in keys}) > 1:
        by_length = {len(each): [".".join(other) for other in keys if len(other) == len(each)] for each in keys}
        return ", ".join(_joined(group) for group in by_length.values())
    return ".".join(column[0] if len(set(column)) == 1 else "*" for column in zip(*keys, strict=True))


def _sections_in(annotation: Any, suffix: str) -> Iterator[tuple[str, type[BaseModel]]]:
    """Sections that an annotation stands for, with what their places add to that of the field."""
    for each in branches(annotation):
        origin, arguments = get_origin(each), get_args(each)
        if isinstance(each, type) and issubclass(each, BaseModel):
            yield suffix, each
        elif origin is dict:
            yield from _sections_in(arguments[1], f"{suffix}.NAME")
        elif origin in (list, tuple):
            yield from _sections_in(arguments[0], f"{suffix}[]")


def _table(title: str, section: type[BaseModel]) -> str:
    lines = [f"#### `{title}`", "", inspect.cleandoc(section.__doc__ or ""), ""]
    lines += ["| key | value | default | meaning |", "|---|---|---|---|"]
    for name, field in section.model_fields.items():
        value = _value(field.annotation, field.metadata)
        lines.append(
            f"| `{field.alias or name}` | {value} | {_default(field)} | {field.description or _first(field)} |"
        )
    return "\n".join([*lines, ""])


def _first(field: FieldInfo) -> str:
    """First sentence about the section a field holds, for fields without words of their own."""
    sections = [section for _, section in _sections_in(field.annotation, "")]
    paragraph = inspect.cleandoc(sections[0].__doc__ or "").split("\n\n")[0] if sections else ""
    return " ".join(paragraph.split()).split(". ")[0].rstrip(".")


def _default(field: FieldInfo) -> str:
    if field.is_required():
        return "required"
    value = field.get_default(call_default_factory=True, validated_data={})
    if isinstance(value, list) and value and all(isinstance(each, str) for each in value):
        return ", ".join(f"`{each}`" for each in value)
    if value is None or value is PydanticUndefined or value == "" or isinstance(value, (list, dict, BaseModel)):
        return "–"
    if isinstance(value, tuple):
        return f"`[{', '.join(f'{number:g}' for number in value)}]`"
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    return f"`{value:g}`" if isinstance(value, float) else f"`{value}`"


def _value(annotation: Any, metadata: list[Any] | tuple[Any, ...] = ()) -> str:
    """What a value may be, in words."""
    for item in metadata:
        if isinstance(item, RealNumber):
            return _quantity(item)
        if isinstance(item, Integer):
            return _integer(item)
        if getattr(item, "pattern", None) in (NAME_PATTERN, PARAMETER_PATTERN):
            return "name"
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        metadata = [
            part for item in arguments[1:] for part in (item.metadata if isinstance(item, FieldInfo) else [item])
        ]
        return _value(arguments[0], metadata)
    if origin is Literal:
        return ", ".join(f"`{value}`" for value in arguments)
    if origin in (Union, UnionType):
        return " or ".join(dict.fromkeys(_value(each) for each in arguments if each is not type(None)))
    if origin is dict:
        return f"name: {_value(arguments[1])}"
    if origin is list:
        return f"list of {_plural(_value(arguments[0]))}"
    if origin is tuple:
        return f"{len(arguments)} {_plural(_value(arguments[0]))}"
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return "mapping"
    return {bool: "`true`, `false`", str: "text", Any: "value"}[annotation]


def _plural(words: str) -> str:
    """``numbers [L]``, ``lists of 3 numbers``, ``names or mappings``."""
    if words[0].isdecimal():
        return f"lists of {words}"
    for noun in ("integer", "number", "name", "mapping", "list", "text", "value"):
        words = re.sub(rf"\b{noun}\b(?!:)", f"{noun}s", words)
    return words


def _integer(item: Integer) -> str:
    """``integer, 2 to 1000``; limits beyond a million are left out."""
    least, most = item.ge > -1_000_000, item.le < 1_000_000
    if not least:
        return f"integer, {item.le} or less" if most else "integer"
    return f"integer, {item.ge} " + (f"to {item.le}" if most else "or more")


def _quantity(quantity: RealNumber) -> str:
    unit = DIMENSIONS[quantity.dimension].unit
    kind = "number with its unit" if isinstance(quantity, WithUnit) else "number"
    words = f"{kind} [{unit}]" if unit else kind
    signs = {"gt": ">", "ge": "≥", "lt": "<", "le": "≤"}
    bounds = [f"{sign} {getattr(quantity, key):g}" for key, sign in signs.items() if getattr(quantity, key) is not None]
    return ", ".join([words, *bounds])


if __name__ == "__main__":
    for path, text in generated_files("deck", deck_schema(), key_reference()).items():
        path.write_text(text, encoding="utf-8")
