"""What the deck types say about a key path: which keys a mapping takes, and what a key means."""

from __future__ import annotations

from collections.abc import Iterator
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel

from mbla.errors import KeyPath


def allowed_keys(root: type[BaseModel], path: KeyPath) -> list[str]:
    """Keys that the mapping at a path may have; empty where names are free, or where there is no mapping."""
    return [key for section in sections_at(root, path) for key in section_keys(section)]


def sections_at(root: type[BaseModel], path: KeyPath) -> list[type[BaseModel]]:
    """Types of the mapping at a path; several where a value may have several shapes."""
    return [each for each in _types_at(root, path) if isinstance(each, type) and issubclass(each, BaseModel)]


def description(root: type[BaseModel], path: KeyPath) -> str:
    """What the types say about a key."""
    for section in sections_at(root, path[:-1]):
        for name, field in section.model_fields.items():
            if path[-1] == (field.alias or name):
                return field.description or ""
    return ""


def takes_names(root: type[BaseModel], path: KeyPath) -> bool:
    """Whether the keys of the mapping at a path are names that the deck's author chooses."""
    return any(get_origin(each) is dict for each in _types_at(root, path))


def annotations_at(root: type[BaseModel], path: KeyPath) -> list[Any]:
    """Type of the value at a path, with units and bounds; several where it may have several shapes."""
    found: list[Any] = [root]
    for key in path:
        found = [below for each in found for branch in branches(each) for below in _annotated_below(branch, key)]
    return found


def _annotated_below(annotation: Any, key: str | int) -> Iterator[Any]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        for name, field in annotation.model_fields.items():
            if key == (field.alias or name):
                yield Annotated[(field.annotation, *field.metadata)] if field.metadata else field.annotation
        return
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is dict and isinstance(key, str):
        yield arguments[1]
    elif origin in (list, tuple) and isinstance(key, int):
        yield arguments[min(key, len(arguments) - 1)]


def section_keys(section: type[BaseModel]) -> list[str]:
    """Keys of a section as the deck writes them."""
    return [field.alias or name for name, field in section.model_fields.items()]


def _types_at(root: type[BaseModel], path: KeyPath) -> list[Any]:
    return [branch for annotation in annotations_at(root, path) for branch in branches(annotation)]


def branches(annotation: Any) -> Iterator[Any]:
    """The types that an annotation stands for, without None and without metadata."""
    origin = get_origin(annotation)
    if origin is Annotated:
        yield from branches(get_args(annotation)[0])
    elif origin in (Union, UnionType):
        for argument in get_args(annotation):
            yield from branches(argument)
    elif annotation is not type(None):
        yield annotation
