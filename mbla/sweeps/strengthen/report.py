"""What ``mbla strengthen`` found, as lines, as a table and as JSON."""

from __future__ import annotations

import csv
import io
import math
from typing import Any

import numpy as np

from mbla import __version__
from mbla.model.ties.ties import OUTSIDE
from mbla.results.listing.text import counted, full_sentence, number, sentence, table
from mbla.results.record.json_values import as_json
from mbla.solution.solution import WITH_VALUE
from mbla.sweeps.design.design import header_of
from mbla.sweeps.strengthen.study import Strengthened

MOST = 40
"""candidates in the table of the listing: those that are used, then those that are worth the most of their cost"""


def rows_of(answer: Strengthened) -> list[dict[str, Any]]:
    """Every candidate: those used first, by their part of the cost, then by what they are worth."""
    ties, found = answer.candidates.ties, answer.cheapest
    order = np.lexsort((-found.use, -answer.capacities * answer.candidates.costs))
    blocks, lengths = answer.model.blocks, ties.lengths

    def body(point: int) -> str:
        block = int(ties.bodies[point])
        return "ground" if block == OUTSIDE else blocks.name(block)

    return [
        {
            "name": ties.names[row],
            "from_body": body(int(ties.start[row])),
            "to_body": body(int(ties.start[row + 1]) - 1),
            "from_place": ties.places[ties.start[row]],
            "to_place": ties.places[ties.start[row + 1] - 1],
            "length": float(lengths[row]),
            "unit_cost": float(answer.candidates.costs[row]),
            "cheapest_capacity": float(found.capacities[row]),
            "capacity": float(answer.capacities[row]),
            "cost": float(answer.capacities[row] * answer.candidates.costs[row]),
            "worth": float(found.use[row]),
        }
        for row in order.tolist()
    ]


def record_of(answer: Strengthened) -> dict[str, Any]:
    """The JSON object."""
    found = answer.cheapest
    return {
        "mbla": __version__,
        "deck": answer.deck.path.name,
        "status": found.status.value,
        "reason": found.reason or answer.shortfall or None,
        "program_cost": as_json(found.cost),
        "least_cost": as_json(found.least_cost),
        "cost": as_json(answer.cost),
        "asked": answer.asked,
        "raised": answer.raised,
        "analyses": answer.analyses,
        "cases": {
            name: {"required": required, "load_factor": as_json(factor)}
            for name, (required, factor) in answer.factors.items()
        },
        "verified": answer.verified,
        "candidates": as_json(rows_of(answer)),
        "files": [str(path) for path in answer.files],
        "exit_code": answer.exit_code,
    }


def table_csv(answer: Strengthened) -> str:
    """Every candidate as a row of CSV."""
    units = answer.model.units
    head = {"name": "", "from_body": "", "to_body": "", "length": units.length, "unit_cost": ""}
    head |= {"cheapest_capacity": units.force, "capacity": units.force, "cost": "", "worth": ""}
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    places = [f"{end}_{axis} [{units.length}]" for end in ("from", "to") for axis in "xyz"]
    writer.writerow([*map(header_of, head, head.values()), *places])
    for row in rows_of(answer):
        writer.writerow([*(row[key] for key in head), *row["from_place"].tolist(), *row["to_place"].tolist()])
    return text.getvalue()


WORTH = (
    "Worth: what a unit of capacity of a candidate saves elsewhere, over its cost: 1 where it is used; a candidate "
    "comes into use where it costs less than that share of its cost."
)


def _candidate_table(answer: Strengthened) -> list[str]:
    units = answer.model.units
    head = ["candidate", "from", "to", f"length [{units.length}]", f"capacity [{units.force}]"]
    rows = [row for row in rows_of(answer) if row["capacity"] > 0.0 or row["worth"] > 0.0][:MOST]
    cells = []
    for row in rows:
        figures = [number(row[key]) if row[key] else "-" for key in ("capacity", "cheapest_capacity", "cost")]
        bodies = [row["name"], row["from_body"], row["to_body"], number(row["length"])]
        cells.append([*bodies, *figures, f"{row['worth']:.4g}"])
    return table([*head, "cheapest", "cost", "worth"], cells, left=3)


def lines_of(answer: Strengthened) -> list[str]:
    """The same in words."""
    found, count = answer.cheapest, len(answer.candidates.costs)
    if found.status not in WITH_VALUE:
        return sentence(full_sentence(f"No strengthening: {found.reason}"))
    used = int((answer.capacities > 0.0).sum())
    says = f"{used} of {counted(count, 'candidate')} used, cost {number(answer.cost)}"
    lines = [f"{answer.deck.path.name}: {says if used else 'nothing has to be added'}"]
    lines += [*_candidate_table(answer), *sentence(WORTH), *sentence(_bound_words(answer))]
    for name, (required, factor) in answer.factors.items():
        says = "no load factor" if math.isnan(factor) else f"load factor {number(factor)}"
        says = "any multiple of its live loads is carried" if factor == math.inf else says
        lines += sentence(f"{name}: {says} with these ties, required {number(required)}.")
    if not answer.suffices:
        why = answer.shortfall or "capacities were raised as far as is tried"
        lines += sentence(full_sentence(f"That is NOT enough: {why}"))
    elif not answer.verified:
        lines += sentence("Not all of these are verified.")
    return [*lines, *(f"  {path}" for path in answer.files)]


def _bound_words(answer: Strengthened) -> str:
    """What the cheapest capacities cost, what is proved of it, and why those written cost more."""
    found = answer.cheapest
    least = number(found.least_cost)
    says = f"By associative flow the cheapest capacities cost no less than {least}: its mechanisms prove it"
    if math.isnan(found.least_cost):
        says = "Nothing proves that no others are cheaper"
    says += f"; those of the program cost {number(found.cost)}"
    section = answer.deck.content.strengthen
    assert section is not None  # there is no answer without
    more = {name: factor for name, factor in answer.asked.items() if factor > section.required[name]}
    if more:
        given_factors = ", ".join(f"{number(factor)} ({name})" for name, factor in more.items())
        says += f"; those written are of load factors {given_factors}, for the analysis to find what is required"
    if answer.raised > 1.0:
        says += f", raised by {100 * (answer.raised - 1):.3g} % where the program had no more to give"
    if section.catalogue is not None:
        says += ", rounded up to the catalogue: above its greatest to the least sum of several ties beside each other"
    return f"{says}."
