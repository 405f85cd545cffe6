"""Content of a deck checked against its types in one pass; what pydantic finds, in our words and with its place."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from mbla.deck.fields import allowed_keys, description
from mbla.deck.quantities import PATTERNS
from mbla.deck.section import MOST_WRONG, WRONG, TooManyWrongError, WrongValues, validator
from mbla.deck.suggestions import did_you_mean, listed, unknown
from mbla.deck.text.tree import MappingMarks, SequenceMarks, Tree, own_mark
from mbla.errors import MOST_FAULTS, Fault, KeyPath, Message, first_faults

Convert = Callable[[str, str], float]
Root = TypeVar("Root", bound=BaseModel)
TOO_MANY = Message("more-faults", f"more than {MOST_WRONG:,} values are wrong: the others were not checked")


def validate(
    tree: Tree, root: type[Root], convert: Convert, reported: set[int], damaged: set[int]
) -> tuple[Root | None, list[Fault]]:
    """Checked content, or everything wrong with it.

    tree     : the deck as read, with inclusions and overrides
    root     : type of the entire content
    convert  : (text, dimension) -> number in the deck's units, ValueError otherwise
    reported : marks of values that the reader has complained of; they are not reported again
    damaged  : marks of mappings that lack something the reader has complained of
    """
    content, errors = _checked(root, tree.data, convert)
    if content is not None:
        return content, []
    if errors is None:  # too many: what is wrong with the first items of the lists
        first = {
            key: value[: MOST_FAULTS + 1] if isinstance(value, list) else value for key, value in tree.data.items()
        }
        errors = _checked(root, first, convert)[1]
    if not errors:
        return None, [Fault(tree.place_of(tree.marks.own), "", TOO_MANY)]
    around = damaged | {mark for path in _paths_of(tree, reported) for mark in tree.marks_along(path)[:-1]}
    return None, first_faults(_faults(tree, root, errors, reported, around))


def _checked(root: type[Root], data: dict[str, Any], convert: Convert) -> tuple[Root | None, Sequence[Any] | None]:
    """Content, or what is wrong with it; nothing of either where that is too much."""
    try:
        return validator(root).validate_python(data, context={"convert": convert, WRONG: WrongValues()}), None
    except ValidationError as error:
        return None, error.errors(include_url=False, include_context=True)
    except TooManyWrongError:
        return None, None


def _faults(
    tree: Tree, root: type[BaseModel], errors: Sequence[Any], reported: set[int], around: set[int]
) -> Iterator[Fault]:
    """Faults without those that only follow from others; ``around``: marks of what holds something reported."""
    by_path: dict[KeyPath, Any] = {}
    lengths: dict[KeyPath, int] = {}
    for error in errors:
        path = _data_path(tree.data, error)
        if error["type"] == "missing" and isinstance(path[-1], int):  # items that a list lacks
            lengths[path[:-1]] = max(path[-1] + 1, lengths.get(path[:-1], 0))
        elif error["type"] == "too_long" and "max_length" in error["ctx"]:
            by_path.setdefault(path, error)
        else:
            by_path[path] = error  # of the branches of a number, the last knows most
    for path, length in lengths.items():
        found = len(_value_at(tree.data, path))
        yield tree.fault(path, Message("wrong-length", f"needs {length} items, has {found}"))
    for path, error in by_path.items():
        marks = tree.marks_along(path)
        if error["type"] == "reported" or not reported.isdisjoint(marks):
            continue
        if marks[-1] in around and error["type"] in ("rules", "missing", "too_short"):
            continue
        if error["type"] == "rules":
            for below, message in error["ctx"]["findings"]:
                yield tree.fault((*path, *below), message)
        else:
            message, at_key = _words(root, tree.data, path, error)
            yield tree.fault(path, message, at_key)


def _paths_of(tree: Tree, marks: set[int]) -> Iterator[KeyPath]:
    """Paths of the values that stand at given marks."""
    pending: list[tuple[KeyPath, Any]] = [((), tree.marks)] if marks else []
    while pending:
        path, node = pending.pop()
        if own_mark(node) in marks:
            yield path
        if isinstance(node, MappingMarks):
            pending += [((*path, key), below) for key, below in node.values.items()]
        elif isinstance(node, SequenceMarks):
            pending += [((*path, index), below) for index, below in enumerate(node.items)]


def _data_path(data: Any, error: Any) -> KeyPath:
    """Path in the deck of an error: the location without the names of union branches."""
    location = error["loc"]
    path: list[str | int] = []
    last = len(location) - 1
    for position, key in enumerate(location):
        absent = error["type"] == "missing" and position == last
        if isinstance(data, dict) and isinstance(key, str) and (key in data or absent):
            data = data.get(key)
        elif isinstance(data, list) and isinstance(key, int) and (key < len(data) or absent):
            data = None if absent else data[key]
        else:
            continue
        path.append(key)
    return tuple(path)


def _value_at(data: Any, path: KeyPath) -> Any:
    for key in path:
        data = data[key]
    return data


_MESSAGES = {
    "greater_than": Message("out-of-bounds", "must be > {gt:g}"),
    "greater_than_equal": Message("out-of-bounds", "must be >= {ge:g}"),
    "less_than": Message("out-of-bounds", "must be < {lt:g}"),
    "less_than_equal": Message("out-of-bounds", "must be <= {le:g}"),
    "bool_type": Message("wrong-type", "must be true or false"),
    "bool_parsing": Message("wrong-type", "must be true or false"),
    "list_type": Message("wrong-type", "must be a list: [...]"),
    "tuple_type": Message("wrong-type", "must be a list: [...]"),
    "dict_type": Message("wrong-type", "must be a mapping: {{key: value}}"),
    "model_type": Message("wrong-type", "must be a mapping: {{key: value}}"),
    "model_attributes_type": Message("wrong-type", "must be a mapping: {{key: value}}"),
    "string_too_long": Message("wrong-text", "has more than {max_length} characters"),
    "string_too_short": Message("wrong-text", "must not be empty"),
    "zero_vector": Message("zero-vector", "must not be the zero vector"),
    "finite_number": Message("not-a-number", "must be a finite number"),
    "reserved": Message("reserved-name", "means something else in expressions: choose another name"),
}
_BOUNDS = ("greater_than", "greater_than_equal", "less_than", "less_than_equal")
_TYPES = {
    "float_type": Message("not-a-number", "must be a number"),
    "int_type": Message("not-a-number", "must be an integer"),
    "string_type": Message("wrong-type", "must be a text"),
}


def _words(root: type[BaseModel], data: Any, path: KeyPath, error: Any) -> tuple[Message, bool]:
    """Message of an error, and whether it is about the key rather than the value."""
    kind, context = error["type"], error.get("ctx", {})
    value = error["input"]
    is_key = bool(error["loc"]) and error["loc"][-1] == "[key]"
    if kind == "missing":
        meaning = description(root, path)
        return Message("missing-key", "is missing" + (f": {meaning}" if meaning else "")), False
    if kind == "extra_forbidden":
        return Message("unknown-key", unknown("key", str(path[-1]), allowed_keys(root, path[:-1]))), True
    if kind in ("too_long", "too_short"):
        return Message("wrong-length", _length(context)), False
    if kind in _TYPES:
        quotes = kind == "string_type" and isinstance(value, (int, float))
        return _TYPES[kind].around(after=": write it in quotes" if quotes else ""), is_key
    if kind == "literal_error":
        allowed = [choice.strip("'") for choice in context["expected"].replace(" or ", ", ").split(", ")]
        hint = did_you_mean(value, allowed) if isinstance(value, str) and len(allowed) > 1 else ""
        return Message("unknown-choice", f"must be {listed(allowed)}{hint}"), False
    if kind == "string_pattern_mismatch":
        return Message("wrong-text", PATTERNS[context["pattern"]]), is_key
    if kind == "quantity":
        return context["reason"], is_key
    known = _MESSAGES.get(kind)
    if known is None:
        return Message("wrong-value", error["msg"]), is_key
    comes_to = _comes_to(data, path, value) if kind in _BOUNDS else ""
    return Message(known.identifier, known.format(**context) + comes_to), is_key


def _comes_to(data: Any, path: KeyPath, value: Any) -> str:
    """The number that an expression or a text with a unit gives, where that is out of bounds."""
    computed = isinstance(_value_at(data, path), str) and isinstance(value, (int, float))
    return f"; this is {value:.6g}" if computed else ""


def _length(context: Any) -> str:
    least, most, found = context.get("min_length"), context.get("max_length"), context.get("actual_length")
    if least is not None:
        return f"needs at least {least} item{'s' if least > 1 else ''}, has {found}"
    return f"needs {most} items, has {found}"
