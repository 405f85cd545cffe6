"""What a run of the command line makes of a geometry file, and whether that is right."""

from __future__ import annotations

import contextlib
import io
import json
import re
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.cli import main
from mbla.errors import UsageError
from mbla.results.explanations import find_explanations
from mbla.results.hdf5.result_file import read_results_hdf5

DECK = """\
mbla: 1
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 0.7}}}}
blocks:
  - {item}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
load_cases:
  push: {{live: [{{acceleration: [1, 0, 0]}}]}}
analysis: {{flow_rule: associative}}
output: {{vtu: false}}
"""
SECONDS = 30
"""a file of some kilobytes that takes longer hangs; on a busy machine most take less than one"""
FAULT = re.compile(r"deck\.yaml:\d+:\d+ \w+[\w.\[\]]*( = .+?)?: .+")
"""a line for each fault: place, key, value, what is wrong"""
FIGURES = ("blocks", "interfaces", "contact_points", "total_weight", "total_volume", "contact_area")
"""what is compared of a model, besides the load factor and the volume of each block"""
POWERS = {"total_weight": 3, "total_volume": 3, "contact_area": 2}
"""with which figures grow with lengths"""
NAMED = re.compile(
    r"line \d+|\.csv:\d+: |"  # where it stands in the file
    r"block \S+( \([^)]*\))?: .*\b(faces?|vertex|vertices|edges?|volume|pieces|one-sided|coordinate|measures)\b|"
    r"\S+\[\d+\] .*overlap|overlap.*\S+\[\d+\]|"  # which of the blocks
    r"is not a well-formed .+|cannot be read: .+|is not a COMPAS file: |holds no |has no |is empty|"
    r"is not UTF-8 text|a \w+ on layer \S+ |face \d+ of the file |the points have neither|its buffer \S+ |"
    r"names (node|point) |the loads reach |reach below it|\d+ more (blocks|faults) |coordinates are rounded by"
)
"""what a diagnosis names: block and face, vertex or edge; or line; or what of the whole file is wrong"""


@dataclass(frozen=True)
class Outcome:
    """What the command left behind.

    status  : its exit status
    faults  : lines on standard error
    notices : identifiers of what was said of a file that was taken
    volumes : (n_blocks,) ascending, where it was solved
    """

    status: int
    faults: tuple[str, ...]
    seconds: float
    written: bool
    notices: frozenset[str] = frozenset()
    volumes: FloatArray | None = None
    figures: Mapping[str, float] | None = None


def outcome(folder: Path, item: str, files: Mapping[str, bytes], *, solve: bool) -> Outcome:
    """Write files and deck, and run it; or check it only, which finds everything but the load factor."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        (folder / name).write_bytes(content)
    deck, out = folder / "deck.yaml", folder / "out"
    deck.write_text(DECK.format(item=item), encoding="utf-8")
    stdout, stderr = io.StringIO(), io.StringIO()
    began = time.perf_counter()
    with contextlib.redirect_stdout(stdout), contextlib.redirect_stderr(stderr):
        status = main([*(["run", "-q", "-o", str(out)] if solve else ["check"]), "--json", str(deck)])
    seconds = time.perf_counter() - began
    faults = tuple(line.removeprefix(f"{folder}/") for line in stderr.getvalue().splitlines())
    if status not in (0, 4, 5):
        return Outcome(status, faults, seconds, out.exists())
    answer = json.loads(stdout.getvalue())
    figures = {key: answer["model"][key] for key in FIGURES}
    notices = frozenset(notice["identifier"] for notice in answer["notices"])
    if not solve:
        return Outcome(status, faults, seconds, out.exists(), notices, None, figures)
    figures["load_factor"] = answer["cases"][0]["load_factor"]
    volumes = np.sort(read_results_hdf5(out / "deck.h5").model.blocks.volumes)
    return Outcome(status, faults, seconds, out.exists(), notices, volumes, figures)


def refusal_defects(found: Outcome) -> list[str]:
    """What is wrong with the way in which a file was refused; nothing where all is well."""
    defects = []
    if found.status != 3:
        defects.append(f"exit status {found.status}, not 3")
    if found.written:
        defects.append("something was written")
    if not found.faults:
        defects.append("nothing was said")
    for line in found.faults:
        if not FAULT.fullmatch(line):
            defects.append(f"no fault with its place: {line}")
        elif not NAMED.search(line):
            defects.append(f"does not name what is wrong: {line}")
        elif not _explained(line):
            defects.append(f"mbla explain has no remedy: {line}")
    return defects


def _explained(line: str) -> bool:
    """Whether ``mbla explain`` knows what to do; of further blocks of an item those told one by one say it."""
    try:
        return bool(find_explanations(line))
    except UsageError:
        return " more " in line


def differences(found: Outcome, sound: Outcome, tolerance: float, scale: float = 1.0) -> list[str]:
    """Where the result differs from that of the file that is not broken; nothing where it is the same.

    scale : of the lengths, beside that file
    """
    if found.status != sound.status or found.figures is None or sound.figures is None:
        return [f"exit status {found.status}, not {sound.status}: {found.faults}"]
    told = [
        f"{key} {found.figures[key]}, not {figure * scale ** POWERS.get(key, 0)}"
        for key, figure in sound.figures.items()
        if key in found.figures
        and found.figures[key] != pytest.approx(figure * scale ** POWERS.get(key, 0), rel=tolerance, abs=0)
    ]
    if found.volumes is not None and sound.volumes is not None and len(found.volumes) == len(sound.volumes):
        worst = float(np.abs(found.volumes / (sound.volumes * scale**3) - 1).max())
        told += [f"volumes of blocks differ by {worst:.1e}"] if not worst <= tolerance else []
    return told
