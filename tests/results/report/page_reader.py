"""An HTML page taken apart without a browser: elements with attributes and text; unbalanced tags are an error."""

from __future__ import annotations

from dataclasses import dataclass, field
from html.parser import HTMLParser

VOID = {"meta", "link", "img", "br", "hr", "input"}
SILENT = {"style", "script", "title"}


@dataclass
class Node:
    """One element; ``text`` is what a reader sees of it and all below, runs of spaces as one."""

    tag: str
    attributes: dict[str, str]
    parent: Node | None = None
    pieces: list[str] = field(default_factory=list)

    @property
    def text(self) -> str:
        return " ".join("".join(self.pieces).split())


class Page(HTMLParser):
    """The elements of a page in their order."""

    def __init__(self, html: str) -> None:
        super().__init__(convert_charrefs=True)
        self.nodes: list[Node] = []
        self._open: list[Node] = []
        self.feed(html)
        self.close()
        assert not self._open, f"not closed: {[node.tag for node in self._open]}"

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        node = Node(tag, {name: value or "" for name, value in attrs}, self._open[-1] if self._open else None)
        assert len(node.attributes) == len(attrs), f"attribute given twice: {attrs}"
        self.nodes.append(node)
        if tag not in VOID:
            self._open.append(node)

    def handle_endtag(self, tag: str) -> None:
        assert self._open, f"</{tag}> closes nothing"
        node = self._open.pop()
        assert node.tag == tag, f"</{tag}> closes <{node.tag}>"

    def handle_data(self, data: str) -> None:
        if self._open and self._open[-1].tag in SILENT:
            self._open[-1].pieces.append(data)
        else:
            for node in self._open:
                node.pieces.append(data)

    def all(self, tag: str, **attributes: str) -> list[Node]:
        """Elements of a tag whose attributes contain the words given (``class_`` for class)."""
        wanted = {name.rstrip("_"): value for name, value in attributes.items()}
        return [
            node
            for node in self.nodes
            if node.tag == tag and all(value in node.attributes.get(name, "").split() for name, value in wanted.items())
        ]

    def one(self, tag: str, **attributes: str) -> Node:
        found = self.all(tag, **attributes)
        assert len(found) == 1, f"{len(found)} of <{tag}> {attributes}"
        return found[0]

    def within(self, owner: Node, tag: str) -> list[Node]:
        """Elements of a tag inside another one."""

        def inside(node: Node) -> bool:
            parent = node.parent
            while parent is not None and parent is not owner:
                parent = parent.parent
            return parent is owner

        return [node for node in self.nodes if node.tag == tag and inside(node)]

    def rows(self, table: Node) -> list[list[str]]:
        """Cells of a table, its head first."""
        return [
            [cell.text for cell in self.nodes if cell.tag in ("th", "td") and cell.parent is row]
            for row in self.within(table, "tr")
        ]
