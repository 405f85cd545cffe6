"""Records of accelerations as PEER writes them (AT2): a header with NPTS and DT, then values only, some to a line.

The header has ``NPTS= 7990, DT= .0050 SEC,`` or, in older files, ``4000   0.0050   NPTS, DT``; the first value is that
at time zero. Files of velocities and displacements (VT2, DT2) look alike and are refused.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from mbla.errors import Message
from mbla.model.motion.record import Record, checked, refused
from mbla.model.tables import TableRefused, finite_number, text_of

MOST_OF_HEADER = 20
"""lines"""
NUMBER = r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][-+]?\d+)?)"
POINTS, STEP = (re.compile(rf"\b{name}\s*[=:]?\s*{NUMBER}", re.IGNORECASE) for name in ("NPTS", "DT"))
BEFORE = re.compile(rf"{NUMBER}[\s,]+{NUMBER}[\s,]+NPTS\s*,?\s*DT\b", re.IGNORECASE)
"""as older files have them, in front of their names"""
UNIT = re.compile(r"\bUNITS?\s+(?:OF|IN|:|=)\s*\(?([A-Za-z]+(?:/[A-Za-z]+(?:[/^]?[A-Za-z0-9]+)?)?)", re.IGNORECASE)
ACCELERATION = re.compile(r"\bACCELERATION\b", re.IGNORECASE)
OTHERS = re.compile(r"\b(VELOCITY|DISPLACEMENT)\b", re.IGNORECASE)


def read_at2(path: Path) -> Record:
    """Times and values of a record.

    Raises TableRefused for files that cannot be read, headers without NPTS or DT, and another count of values.
    """
    lines = text_of(path).splitlines()
    name = path.name
    if not any(line.strip() for line in lines):
        raise refused(f"{name}: is empty: a record of PEER has a header with NPTS and DT, then values")
    header, points, step = _header(name, lines)
    above = " ".join(lines[:header])
    other = None if ACCELERATION.search(above) else OTHERS.search(above)
    if other or path.suffix.lower() in (".vt2", ".dt2"):
        what = other[1].lower() if other else {"v": "velocity", "d": "displacement"}[path.suffix[1].lower()]
        raise refused(f"{name}: is a record of {what}: give that of acceleration, which PEER calls AT2")
    values, rows = _values(name, lines, header)
    if len(values) != points:
        which = "more" if len(values) > points else "fewer"
        words = f"{name}:{header}: NPTS = {points}, but {len(values)} values follow, {which} than that: get it anew"
        raise refused(words)
    unit = UNIT.search(above)
    times = np.arange(points, dtype=np.float64) * step
    return checked(path, times, np.array(values)[:, None], rows, unit[1].lower() if unit else "")


def _header(name: str, lines: Sequence[str]) -> tuple[int, int, float]:
    """Number of its last line, from 1, how many values there are, and their step."""
    points = step = None
    for number, line in enumerate(lines[:MOST_OF_HEADER], start=1):
        both = BEFORE.search(line)
        here = (both[1], both[2]) if both else tuple(_first(pattern, line) for pattern in (POINTS, STEP))
        points, step = here if None not in here else (points or here[0], step or here[1])
        if points is not None and step is not None:
            return number, *_points_and_step(f"{name}:{number}", points, step)
    lacks = [key for key, found in (("NPTS", points), ("DT", step)) if found is None]
    missing = f"{' and '.join(lacks)} {'are' if len(lacks) > 1 else 'is'}"
    words = f"{name}: {missing} not in its header: write NPTS= 4000, DT= .005 SEC above the values, or give it as CSV"
    raise refused(words)


def _first(pattern: re.Pattern[str], line: str) -> str | None:
    """The number that a pattern finds in a line."""
    found = pattern.search(line)
    return None if found is None else found[1]


def _points_and_step(place: str, points: str, step: str) -> tuple[int, float]:
    count, length = (finite_number(text.upper().replace("D", "E"), False) for text in (points, step))
    if count is None or count != round(count) or count < 2:
        raise refused(f"{place}: NPTS = {points}: must be a number of values, 2 or more")
    if length is None or not length > 0.0:
        raise refused(f"{place}: DT = {step}: must be > 0, in seconds")
    return int(count), length


def _values(name: str, lines: Sequence[str], header: int) -> tuple[list[float], list[int]]:
    """Values below the header, and their lines."""
    values, rows, faults = list[float](), list[int](), list[Message]()
    for number, line in enumerate(lines[header:], start=header + 1):
        for text in line.replace(",", " ").split():
            value = finite_number(text.upper().replace("D", "E"), False)
            if value is None:
                faults.append(Message("table-number", f"{name}:{number}: {text}: must be a finite number"))
            else:
                values.append(value)
                rows.append(number)
    if faults:
        raise TableRefused(*faults)
    return values, rows
