"""An assessment by a code in words: the ratios in a sentence, and the table of all figures with their articles."""

from __future__ import annotations

from mbla.deck.sections.assessment import LIMIT_STATES
from mbla.results.assessment import NAMES, OLD
from mbla.results.listing.blocks import GAP, Block, ListingSection, apart, paragraphs, table_of
from mbla.results.listing.text import full_sentence, number, section_lines
from mbla.results.results import CaseResult, Results

MODELLED = (
    "Modelled: the mechanism as one that begins at alpha_0, and the curve under actions that are taken to last until "
    "collapse. Not modelled: what ends it before, such as ties that rupture, beams that lose their seat or vaults that "
    "fall with it (C8.7.1.2.1.6), and the elastic period of elements that are free to vibrate."
)
OF_2019 = (
    "a_g,0 and a_g,d are found with F_0, T_C* and the soil of their limit state kept. What follows from the curve is "
    "as sure as its steps, and where it ends is what the run says."
)
OF_2009 = "Displacements by Circolare 617/2009 are left out: their articles were not found in a text to be read."


def code_verdict(case: CaseResult) -> str:
    """What a code says at every limit state, in a line: met or not, capacity over demand; empty where none is asked."""
    found, asked = case.assessment, case.load_case.assessment
    if found is None or asked is None:
        return ""
    said = {name: f"{name} no verdict" for name in LIMIT_STATES if getattr(asked.spectra, name) is not None}
    for name, ratio in found.ratios.items():
        met = "met" if ratio.value >= 1.0 else "NOT MET"
        said[name] = f"{name} {met}, capacity/demand {number(ratio.value)}"
    return f"{found.code}: {'; '.join(said.values())}"


def assessment_words(case: CaseResult) -> str:
    """Capacity over demand at every limit state; empty where no assessment is asked for."""
    found, asked = case.assessment, case.load_case.assessment
    if found is None or asked is None:
        return ""
    said = {name: "no verdict" for name in LIMIT_STATES if getattr(asked.spectra, name) is not None}
    for name, ratio in found.ratios.items():
        said[name] = f"{number(ratio.value)} ({ratio.words}), {'met' if ratio.value >= 1.0 else 'NOT MET'}"
    verdicts = "; ".join(f"{name} {words}" for name, words in said.items())
    return " ".join([f"{found.code}, capacity over demand: {verdicts}.", *map(full_sentence, found.remarks)])


def all_assessment_lines(results: Results) -> list[str]:
    """Of every load case that has an assessment, under its name."""
    assessed = [case for case in results.cases if case.assessment is not None]
    sections = [
        ListingSection(f"Load case {case.load_case.name}", [GAP, *assessment_blocks(case)]) for case in assessed
    ]
    return [results.model.title or results.deck.name, *section_lines(sections)]


def assessment_blocks(case: CaseResult) -> list[Block]:
    """The same, every figure with its article, and what is not in it."""
    found = case.assessment
    if found is None:
        return []
    rows = [
        [each.limit_state, each.symbol, number(each.value), each.unit, each.article, each.words]
        for each in found.figures
    ]
    figures = apart(table_of(["", "symbol", "value", "unit", "article", ""], rows, left=6))
    said = apart(paragraphs(MODELLED, OF_2009 if found.code == NAMES[OLD] else OF_2019)) if rows else []
    return [*paragraphs(assessment_words(case)), *figures, *said]
