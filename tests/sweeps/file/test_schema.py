from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from mbla.deck.fields import section_keys
from mbla.deck.schema import generated_files
from mbla.deck.section import Section
from mbla.deck.text.reader import read_yaml
from mbla.deck.text.sources import SourceText
from mbla.errors import DeckError
from mbla.sweeps.file import content
from mbla.sweeps.file.read import read_sweep
from mbla.sweeps.file.schema import (
    sweep_key_reference,
    sweep_schema,
)
from tests.faulty_sweeps import SWEEPS
from tests.sweeps.file.sweeps import ALL_WAYS, GOOD


@cache
def validator() -> Any:
    return jsonschema.Draft202012Validator(sweep_schema())


def schema_accepts(text: str) -> bool:
    return bool(validator().is_valid(read_yaml(SourceText("sweep", text), 0).data))


def test_file_is_up_to_date() -> None:
    for path, text in generated_files("sweep", sweep_schema(), sweep_key_reference()).items():
        assert path.read_text(encoding="utf-8") == text


def test_schema_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(sweep_schema())


@pytest.mark.parametrize("text", [GOOD, ALL_WAYS])
def test_good_files_pass_both(tmp_path: Path, text: str) -> None:
    path = tmp_path / "sweep.yaml"
    path.write_text(text, encoding="utf-8")
    read_sweep(path)
    assert schema_accepts(text)


@pytest.mark.parametrize("path", SWEEPS, ids=lambda path: path.stem)
def test_of_faulty_files_the_schema_sees_what_the_table_says(path: Path) -> None:
    """It cannot see names, sums over keys, designs, nor the base deck."""
    assert schema_accepts(SWEEPS[path].text) == SWEEPS[path].schema_accepts
    if not SWEEPS[path].schema_accepts:
        with pytest.raises(DeckError):
            read_sweep(path)


def test_expressions_are_not_numbers_but_times_have_units() -> None:
    assert not schema_accepts(GOOD.replace("to: 0.7", 'to: "=0.7"'))
    assert schema_accepts(GOOD + 'limits: {time: "10 min"}\n')
    assert not schema_accepts(GOOD + 'limits: {time: "=10"}\n')


def test_every_key_of_every_section_has_a_row_with_a_meaning() -> None:
    tables: dict[str, list[str]] = {}
    for line in sweep_key_reference().splitlines():
        if line.startswith("#### "):
            tables[line] = []
        elif line.startswith("| `"):
            key, *cells = [cell.strip() for cell in line.strip("|").split(" | ")]
            assert cells[-1]
            list(tables.values())[-1].append(key.strip("`"))
    sections = [each for each in vars(content).values() if isinstance(each, type) and issubclass(each, Section)]
    ours = [each for each in sections if each.__module__ == content.__name__]
    assert sorted(tables.values()) == sorted(section_keys(each) for each in ours)
    assert len(ours) >= 15
