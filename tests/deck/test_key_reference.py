from __future__ import annotations

from mbla.deck.fields import section_keys
from mbla.deck.schema import key_reference
from mbla.deck.section import Section


def rows() -> dict[str, dict[str, list[str]]]:
    tables: dict[str, dict[str, list[str]]] = {}
    title = ""
    for line in key_reference().splitlines():
        if line.startswith("#### "):
            title = line.removeprefix("#### ").strip("`")
            tables[title] = {}
        elif line.startswith("| `"):
            key, *cells = [cell.strip() for cell in line.strip("|").split(" | ")]
            tables[title][key.strip("`")] = cells
    return tables


def sections(root: type[Section]) -> list[type[Section]]:
    return [root] + [below for each in root.__subclasses__() for below in sections(each)]


def test_every_key_of_every_section_has_a_row() -> None:
    found = sorted(tuple(keys) for keys in rows().values())
    used = [each for each in sections(Section) if each.__module__.startswith("mbla.deck.")]
    bases = ("Item", "Masonry", "VaultItem", "Section")
    expected = sorted(tuple(section_keys(each)) for each in used if each.__name__ not in bases)
    assert found == expected


def test_units_defaults_and_bounds() -> None:
    tables = rows()
    assert tables["materials.NAME"]["density"] == ["number [M/L^3], > 0", "–", "mass per volume"]
    assert tables["contacts"]["tolerance"][:2] == ["number, > 0, ≤ 0.1", "`0.001`"]
    assert tables["blocks[].wall"]["unit"][:2] == ["3 numbers [L], > 0", "required"]
    assert tables["blocks[].wall.openings[]"]["from"][0] == "2 numbers [L]"
    assert tables["blocks[].polyhedron"]["faces"][0] == "list of lists of whole numbers, 0 or more"
    assert tables["output"]["vtu"][:2] == ["`true`, `false`", "`true`"]
    assert tables["output"]["frames"][:2] == ["whole number, 2 to 1000", "`11`"]
    assert tables["blocks[].*.*.rotate"]["about"][:2] == ["3 numbers [L]", "`[0, 0, 0]`"]
    position = next(table for table in tables.values() if "voussoir" in table)
    assert position["voussoir"][0] == "whole number or 2 whole numbers"  # negative ones count from the last
    assert position["index"][0] == "whole number, 0 or more"
    assert tables["deck"]["parameters"][0] == "name: number"
    assert tables["supports[]"]["blocks"][0] == "name or mapping or list of names or mappings"


def test_every_row_has_a_meaning() -> None:
    assert all(cells[-1] for table in rows().values() for cells in table.values())


def test_words_about_a_kind_of_item_end_where_its_sentence_does() -> None:
    items = rows()["blocks[]"]
    assert (
        items["stack"][2] == "Equal cuboids one on the other along +z, the lowest with its least corner at the origin"
    )
    assert items["cross_vault"][2].endswith("the middle of the bay at the origin, springings at z = 0")
