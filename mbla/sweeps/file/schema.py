"""JSON Schema of the sweep file, generated from its types; ``python -m mbla.sweeps.file.schema --write`` writes
it and the key reference.

A schema sees single values and the keys of one mapping. Names, designs and the base deck are left to mbla itself.
"""

from __future__ import annotations

from typing import Any

from mbla.deck.quantities import EXPRESSION_PATTERN, QUANTITY_PATTERN
from mbla.deck.schema import generated_files, section_tables, tidy
from mbla.sweeps.file.content import SIDES, WAYS, SweepContent
from mbla.sweeps.file.parts import KINDS

VALUE_TYPES = ["number", "string", "boolean", "array"]
"""what a value of a parameter may be"""


def sweep_schema() -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of a complete sweep file."""
    schema = SweepContent.model_json_schema(by_alias=True)
    definitions = {name: _without_expressions(tidy(each)) for name, each in schema.pop("$defs").items()}
    for section, keys in (("Parameter", WAYS), ("DesignPart", KINDS), ("FragilitySection", SIDES)):
        definitions[section]["oneOf"] = [{"required": [key]} for key in keys]
    definitions["Parameter"]["properties"]["values"]["items"] = {"type": VALUE_TYPES}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:mbla:schema:sweep:1",
        "title": "mbla sweep file",
        **_without_expressions(tidy(schema)),
        "$defs": definitions,
    }


def _without_expressions(node: Any) -> Any:
    """A schema without the ``"=..."`` texts that a deck takes for numbers."""
    if isinstance(node, list):
        return [_without_expressions(each) for each in node]
    if not isinstance(node, dict):
        return node
    node = {key: _without_expressions(value) for key, value in node.items()}
    if node.get("pattern") == QUANTITY_PATTERN:
        node["pattern"] = QUANTITY_PATTERN.replace("=|", "", 1)
    branches = [each for each in node.get("anyOf", ()) if each.get("pattern") != EXPRESSION_PATTERN]
    if len(branches) == 1:
        del node["anyOf"]
        return {**branches[0], **node}
    return node


def sweep_key_reference() -> str:
    """A table for every section of a sweep file: key, value, default, meaning."""
    introduction = (
        "Numbers are plain: no expressions. What goes into the deck (`values` of parameters, `set`) is written as the "
        "deck takes it there.\n"
    )
    return "\n".join([introduction, *section_tables(SweepContent, "sweep file")])


if __name__ == "__main__":
    for path, text in generated_files("sweep", sweep_schema(), sweep_key_reference()).items():
        path.write_text(text, encoding="utf-8")
