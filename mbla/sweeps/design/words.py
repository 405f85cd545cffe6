"""A design in words, as ``mbla sweep --dry-run`` shows it: its parts, how many points there are, and each of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mbla.deck.suggestions import listed
from mbla.results.listing.text import INDENT, WIDTH, counted, entry, heading, sentence, shortened
from mbla.sweeps.design.design import Design, SweepColumn
from mbla.sweeps.file.content import Part
from mbla.sweeps.plan import Plain

DIGITS = (6, 9, 12)
"""significant digits of a column: the fewest of these that tell all its values apart"""
LONGEST = 24
"""characters of a text; of a longer one the middle is left out"""
GAP = 2


def design_lines(design: Design) -> list[str]:
    """Parts, totals, what constraints leave out, remarks, and a table of all points."""
    lines = [*heading("Design"), *part_lines(design), *count_lines(design)]
    for remark in design.remarks:
        lines += ["", *sentence(remark)]
    return [*lines, *heading("Points"), *point_lines(design)]


def part_lines(design: Design) -> list[str]:
    """``sobol  unit_weight and cohesion: 128 points, seed 1``, one for each part."""
    sizes = {dimension.name: dimension.size for dimension in design.dimensions}
    return [line for part, names in design.parts for line in entry(part.kind, _part_words(part, names, sizes))]


def _part_words(part: Part, dimensions: Sequence[str], sizes: dict[str, int]) -> str:
    if part.kind == "grid":
        return " × ".join(f"{name} ({sizes[name]})" for name in dimensions)
    together = f"{listed(part.parameters, 'and')}: {counted(sizes[dimensions[0]], 'point')}"
    return together if part.seed is None else f"{together}, seed {part.seed}"


def count_lines(design: Design) -> list[str]:
    """How many points there are, and how many each constraint leaves out."""
    lines = entry("points", str(len(design.points)))
    if design.breaches:
        lines += entry("left out by constraints", f"{design.left_out} of {len(design.points) + design.left_out}")
        for text, count in design.breaches:
            lines += entry(f"{INDENT}{shortened(text, LONGEST)}", f"broken by {count}")
    return lines


def point_lines(design: Design) -> list[str]:
    """Number and values of each point; columns that do not fit beside each other go into a further table."""
    numbers = ["point", "", *(str(point.number) for point in design.points)]
    columns = [
        [column.name, column.unit, *_cells(column, [point.values[i] for point in design.points])]
        for i, column in enumerate(design.columns)
    ]
    left = [column.kind == "text" for column in design.columns]
    room = WIDTH - len(INDENT) - _width(numbers)
    lines: list[str] = []
    for group in _groups([_width(cells) for cells in columns], room):
        lines += ([""] if lines else []) + _aligned(
            [numbers, *(columns[i] for i in group)], [False, *(left[i] for i in group)]
        )
    return lines


def _cells(column: SweepColumn, values: Sequence[Plain]) -> list[str]:
    """Values of a column as text."""
    if column.kind == "text":
        return [shortened(str(value), LONGEST) for value in values]
    if column.kind == "bool":
        return ["true" if value else "false" for value in values]
    if column.kind == "int":
        return [str(value) for value in values]
    numbers = [float(value) for value in values if isinstance(value, (int, float))]
    different = len(set(numbers))
    for digits in DIGITS:
        cells = [f"{number + 0.0:.{digits}g}" for number in numbers]
        if len(set(cells)) == different:
            break
    return cells


def _width(cells: Sequence[str]) -> int:
    return max(map(len, cells))


def _groups(widths: Sequence[int], room: int) -> Iterator[list[int]]:
    """Columns that fit beside each other, in their order; one that fits nowhere stands alone."""
    group: list[int] = []
    used = 0
    for i, width in enumerate(widths):
        if group and used + GAP + width > room:
            yield group
            group, used = [], 0
        group.append(i)
        used += GAP + width
    yield group


def _aligned(columns: Sequence[Sequence[str]], left: Sequence[bool]) -> list[str]:
    widths = [_width(cells) for cells in columns]
    rows = zip(*columns, strict=True)
    lines = [
        INDENT
        + (" " * GAP).join(
            f"{cell:<{width}}" if to_left else f"{cell:>{width}}"
            for cell, width, to_left in zip(row, widths, left, strict=True)
        )
        for row in rows
    ]
    lines = [line.rstrip() for line in lines]
    return lines if lines[1] else [lines[0], *lines[2:]]
