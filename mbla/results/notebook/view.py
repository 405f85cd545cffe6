"""The view that can be turned, as a page of its own: in a frame in a notebook, or in a file."""

from __future__ import annotations

from dataclasses import dataclass, field
from html import escape
from pathlib import Path

from mbla.results.results import CaseResult, Results
from mbla.results.whole_file import write_whole

HEIGHT = 780
"""pixels of the frame in a notebook"""


@dataclass(frozen=True)
class View:
    """A whole page with one view; it asks for nothing from a network."""

    name: str
    page: str = field(repr=False)

    @classmethod
    def of_case(cls, results: Results, case: CaseResult) -> View:
        """Of a load case; UsageError if the extra for reports is not installed."""
        from mbla.results.view3d.view import page_html

        return cls(case.load_case.name, page_html(results, case))

    def save(self, path: str | Path) -> Path:
        """Write the page, to be opened in a browser; FileError if that fails."""
        path = Path(path)
        write_whole(path, self.page.encode("utf-8"))
        return path

    def _repr_html_(self) -> str:
        frame = f'width="100%" height="{HEIGHT}" style="border: 0"'
        return f'<iframe title="{escape(self.name)}" {frame} srcdoc="{escape(self.page)}"></iframe>'
