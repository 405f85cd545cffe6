"""The table of formulation and case in decks/benchmarks/README.md; ``python -m tests.decks.benchmark_table`` writes it.

Every row is a run through the library as ``mbla run --set`` would do it. A formulation that refuses a case, or whose
options nothing read, has no row: the reason goes to standard error and below the table.
"""

from __future__ import annotations

import io
import math
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache

from mbla.contacts import Contacts
from mbla.contacts.glue import held_model
from mbla.deck import Deck, read_deck
from mbla.deck.sections.analysis import AnalysisSection
from mbla.errors import DeckError, MblaError
from mbla.model import Model, build_model
from mbla.results.outcome import associative_of, best_iterate, law_residual, range_of, result_of
from mbla.results.results import CaseResult
from mbla.results.sta import StatusFile
from mbla.run import contacts_of, solve_case
from mbla.solution.settings import solver_settings
from tests.decks.benchmark_cases import CASES, BenchmarkCase, Formulation, formulation, overrides_of
from tests.decks.folder import DECKS

README = DECKS / "benchmarks" / "README.md"
BEGIN = "<!-- table: python -m tests.decks.benchmark_table -->\n"
END = "<!-- end of table -->\n"
HEAD = (
    "case",
    "formulation",
    "solved as",
    "status",
    "load factor",
    "static bound",
    "kinematic bound",
    "range, bracket, peak",
    "residual",
    "programs",
    "iterations",
    "seconds",
)
INTERNAL = "internal error"
NOT_RUN = "Not in the table: "
"""begins the line of what refused to run, with the reason"""


@dataclass(frozen=True)
class Refused:
    """A formulation that gave no row for a case, and why."""

    case: str
    formulation: str
    reason: str


def run_case(case: BenchmarkCase, chosen: Formulation) -> CaseResult | Refused:
    """Solve and verify one load case by one formulation."""
    overrides = overrides_of(case, chosen)
    try:
        deck, read = watched(read_deck(DECKS / "benchmarks" / f"{case.deck}.yaml", overrides))
        model, contacts = _model_of(case)
        load_case = next(each for each in model.load_cases if each.name == case.load_case)
        settings = solver_settings(deck.analysis)
        result = solve_case(deck, model, contacts, load_case, settings, StatusFile(io.StringIO(), case.name), None)
    except DeckError as error:  # without the place: it names a folder of this machine
        faults = [f"{fault.key} = {fault.value}: {fault.message}" for fault in error.faults]
        return Refused(case.name, chosen.name, "; ".join(faults))
    except MblaError as error:
        return Refused(case.name, chosen.name, " ".join(str(error).split()))
    except Exception as error:  # must not cost the other rows; ``main`` fails for it
        words = " ".join(f"{INTERNAL} ({type(error).__name__}: {error})".split())
        return Refused(case.name, chosen.name, words)
    ignored = [
        key for key in (override.split("=")[0].split(".")[0] for override in chosen.overrides) if key not in read
    ]
    if ignored:
        return Refused(case.name, chosen.name, f"analysis.{ignored[0]} is not read by the solver stage")
    if result_of(result) is not None and not chosen.shows(result.solution):
        return Refused(case.name, chosen.name, "the solution does not bear its mark: another formulation was solved")
    return result


@cache
def _model_of(case: BenchmarkCase) -> tuple[Model, Contacts]:
    """Model and contacts, which no formulation changes."""
    deck = read_deck(DECKS / "benchmarks" / f"{case.deck}.yaml", case.overrides)
    model = build_model(deck)
    contacts = contacts_of(deck, model)
    return held_model(model, contacts), contacts


def watched(deck: Deck) -> tuple[Deck, set[str]]:
    """The same deck with an analysis that notes which of its keys are read, and the set that they are noted in."""
    read: set[str] = set()

    class Watched(AnalysisSection):
        def __getattribute__(self, name: str) -> object:
            read.add(name)
            return super().__getattribute__(name)

    analysis = deck.analysis
    values = {name: getattr(analysis, name) for name in type(analysis).model_fields}
    content = deck.content.model_copy(update={"analysis": Watched.model_construct(**values)})
    read.clear()
    return replace(deck, content=content), read


def rows_of(case: BenchmarkCase, tell: Callable[[str], None]) -> Iterator[tuple[str, ...] | Refused]:
    """One row for each formulation of a case."""
    label = f"{case.name}: [{case.deck}.yaml]({case.deck}.yaml){expected_words(case)}"
    for name in case.formulations:
        result = run_case(case, formulation(name))
        if isinstance(result, Refused):
            tell(f"{case.name}, {name}: {result.reason}")
            yield result
            continue
        tell(f"{case.name}, {name}: {result.status}")
        yield (label, name, *figures_of(result))
        label = ""


def expected_words(case: BenchmarkCase) -> str:
    """What the deck expects, where the case does not change the deck."""
    deck = read_deck(DECKS / "benchmarks" / f"{case.deck}.yaml")
    expected = deck.content.expected.get(case.load_case)
    if expected is None or case.overrides:
        return ""
    own = "" if expected.load_factor is None else f"; expected {expected.load_factor:.8g}"
    associative = expected.associative_load_factor
    return own + (f", associative {associative:.8g}" if associative not in (None, expected.load_factor) else "")


def figures_of(result: CaseResult) -> tuple[str, ...]:
    """The figures of a row; a value in brackets is the best iterate, no result."""
    solution, checks = result.solution, result.checks
    own, best = result_of(result), best_iterate(result)
    factor = f"{own.load_factor:.7g}" if own else f"({best.load_factor:.7g})" if best else "–"
    solved_as = "–" if solution.size is None else "planar" if solution.size.dimension == 2 else "spatial"
    return (
        solved_as,
        result.status.value,
        factor,
        _number(checks.static_bound, ".7g"),
        _number(checks.kinematic_bound, ".7g"),
        range_words(result),
        _number(law_residual(checks), ".0e"),
        str(len(solution.programs)),
        str(sum(program.iterations for program in solution.programs)),
        f"{solution.seconds:.2f}",
    )


def range_words(result: CaseResult) -> str:
    """Verified range of a factor without normality, or bracket of polyhedral friction; a peak of the load path."""
    ends, associative, outer = range_of(result), associative_of(result), result.solution.outer
    if outer is not None and associative is not None:
        ends = associative.load_factor, outer.load_factor
    words = [] if ends is None else [" .. ".join(_number(end, ".6g") for end in ends)]
    peak = result.checks.peak_load_factor
    words += [] if math.isnan(peak) else [f"peak {peak:.5g}"]
    return "; ".join(words) or "–"


def _number(value: float, form: str) -> str:
    return "–" if math.isnan(value) else format(value + 0.0, form)


def table(cases: tuple[BenchmarkCase, ...] = CASES, tell: Callable[[str], None] = lambda text: None) -> str:
    """The whole table, and below it what refused to run."""
    rows, refused = [], []
    for case in cases:
        for row in rows_of(case, tell):
            if isinstance(row, Refused):
                refused.append(row)
            else:
                rows.append(row)
    lines = [_line(HEAD), _line(("---",) * len(HEAD)), *(_line(row) for row in rows)]
    lines += [""] if refused else []
    lines += [f"- {NOT_RUN}{each.case} / {each.formulation}: {each.reason}" for each in refused]
    return "\n".join(lines) + "\n"


def rows_in(text: str) -> dict[tuple[str, str], tuple[str, ...]]:
    """Rows of a page by case and formulation: the cells that follow; of what refused to run the reason."""
    found: dict[tuple[str, str], tuple[str, ...]] = {}
    case = ""
    for line in text.split(BEGIN)[1].split(END)[0].splitlines():
        if line.startswith("| ") and not line.startswith(("| case |", "| --- |")):
            label, name, *figures = (cell.strip() for cell in line.strip("|").split("|"))
            case = label.split(": [")[0] if label else case
            found[case, name] = tuple(figures)
        elif line.startswith(f"- {NOT_RUN}"):
            names, _, reason = line.removeprefix(f"- {NOT_RUN}").partition(": ")
            which, _, name = names.partition(" / ")
            found[which, name] = (reason,)
    return found


def _line(cells: tuple[str, ...]) -> str:
    return f"| {' | '.join(cells)} |"


def with_table(text: str, new: str) -> str:
    """The page with its table renewed."""
    before, rest = text.split(BEGIN)
    _, after = rest.split(END)
    return before + BEGIN + new + END + after


def main() -> int:
    """Write the page again, saying each row on standard error; 1 where a formulation ended in an internal error."""

    def tell(text: str) -> None:
        sys.stderr.write(text + "\n")
        sys.stderr.flush()

    new = table(CASES, tell)
    README.write_text(with_table(README.read_text(encoding="utf-8"), new), encoding="utf-8")
    return 1 if INTERNAL in new else 0


if __name__ == "__main__":
    sys.exit(main())
