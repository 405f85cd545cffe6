import re
from dataclasses import replace
from typing import Any

import numpy as np

from mbla.contacts.contacts import ContactReport
from mbla.results.listing.sections.contact_words import contact_section, finding_sections
from mbla.results.listing.text import section_lines
from tests.results.synthetic import empty_report, tower_contacts, tower_model


def findings(**changes: Any) -> str:
    report: ContactReport = replace(empty_report(), **changes)
    return "\n".join(section_lines(finding_sections(tower_model(), report)))


def test_counts_of_what_was_found() -> None:
    report = replace(
        empty_report(),
        slivers=np.array([[0, 1]]),
        sliver_widths=np.array([1e-4]),
        unsupported=(np.array([1, 2]),),
        isolated=np.array([2]),
    )
    contacts = replace(tower_contacts(), report=report, gaps=np.array([0.0, -0.002]))
    text = "\n".join(section_lines([contact_section(tower_model(), contacts)]))
    assert re.search(r"slivers dropped +1\n", text)
    assert re.search(r"blocks without contact +1\n", text)
    assert re.search(r"unsupported blocks +2, 1 part\n", text)
    assert re.search(r"greatest gap or overlap +2.0e-03 m\n", text)


def test_near_misses_the_closest_first_in_units_of_length() -> None:
    text = findings(near_misses=np.array([[0, 1], [1, 2]]), near_miss_gaps=np.array([0.02, 0.004]))
    size = float(tower_model().blocks.sizes[1])
    rows = [line.split() for line in text.splitlines() if "/" in line and "[m]" not in line]
    assert [row[0] for row in rows] == ["tower[0]/brick[0]", "base[0]/tower[0]"]
    assert float(rows[1][1]) == np.round(0.02 * size, 4)
