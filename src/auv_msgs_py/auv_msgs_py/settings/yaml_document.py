"""Build plain Python objects from untrusted YAML, within bounds on depth, size and expanded aliases."""

from __future__ import annotations

import re
from typing import Any

import yaml
from yaml.events import (
    AliasEvent,
    DocumentStartEvent,
    MappingEndEvent,
    MappingStartEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
    StreamEndEvent,
)

#: Deepest nesting of lists and mappings.
MOST_DEPTH = 64
#: Most values in a document, aliases expanded; a text counts once for each 64 characters.
MOST_NODES = 200_000
_MOST_DIGITS = 40
_CHARACTERS = 64

_PARSER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_CORE = "tag:yaml.org,2002:"
_NULL = ("", "~", "null", "Null", "NULL")
_BOOL = {"true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}
#: Whole numbers of YAML 1.2 in decimal. With a leading zero it is text: parsers disagree on octal.
_INT = re.compile(r"[-+]?(?:0|[1-9][0-9]*)")
FLOAT = re.compile(
    r"^[-+]?(?:(?:[0-9]+\.[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?|[0-9]+[eE][-+]?[0-9]+"
    r"|\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN))$"
)
_NOT_TEXT = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")
_MERGE = object()


def build(text: str) -> Any:
    """Build the objects of one document: None, booleans, numbers, text, lists and mappings.

    Scalars follow YAML 1.2 where 1.1 surprises: `off` is text, `1e-3` a number, `12:30` text. Anchors,
    aliases and merge keys (``<<``) work; tags other than the core schema's are refused.

    Raises:
        yaml.YAMLError: not YAML, a key twice, or beyond a bound; with the place.
    """
    return _Builder(text).document()


class _Builder:
    def __init__(self, text: str) -> None:
        self._parser = _PARSER(text)
        self._anchors: dict[str, tuple[Any, int]] = {}
        self._nodes = 0

    def document(self) -> Any:
        try:
            self._next()  # the stream's start
            if isinstance(self._next(), StreamEndEvent):
                return None
            value = self._value(self._next(), 0)
            self._next()  # the document's end
            after = self._next()
            if isinstance(after, DocumentStartEvent):
                raise _problem("a second document", after)
            return value
        finally:
            self._parser.dispose()

    def _next(self) -> Any:
        return self._parser.get_event()

    def _count(self, nodes: int, event: Any) -> None:
        self._nodes += nodes
        if self._nodes > MOST_NODES:
            raise _problem(f"more than {MOST_NODES} values, aliases expanded", event)

    def _value(self, event: Any, depth: int) -> Any:
        if isinstance(event, AliasEvent):
            if event.anchor not in self._anchors:
                raise _problem(f"the alias {event.anchor!r} without its anchor before it", event)
            value, nodes = self._anchors[event.anchor]
            self._count(nodes, event)
            return value
        before = self._nodes
        self._count(1, event)
        if isinstance(event, ScalarEvent):
            value = self._scalar(event)
        elif depth >= MOST_DEPTH:
            raise _problem(f"more than {MOST_DEPTH} lists and mappings inside each other", event)
        elif isinstance(event, SequenceStartEvent):
            value = self._list(event, depth)
        else:
            value = self._mapping(event, depth)
        if event.anchor is not None:
            self._anchors[event.anchor] = value, self._nodes - before
        return value

    def _list(self, event: SequenceStartEvent, depth: int) -> list[Any]:
        _check_tag(event, "seq")
        items = []
        while not isinstance(item := self._next(), SequenceEndEvent):
            items.append(self._value(item, depth + 1))
        return items

    def _mapping(self, event: MappingStartEvent, depth: int) -> dict[Any, Any]:
        _check_tag(event, "map")
        merged: dict[Any, Any] = {}
        own: dict[Any, Any] = {}
        while not isinstance(key_event := self._next(), MappingEndEvent):
            key = self._key(key_event, depth)
            value_event = self._next()
            value = self._value(value_event, depth + 1)
            if key is _MERGE:
                for part in value if isinstance(value, list) else [value]:
                    if not isinstance(part, dict):
                        raise _problem("<< with something other than mappings", value_event)
                    merged = part | merged
            elif key in own:
                raise _problem(f"the key {key!r} stands there twice", key_event)
            else:
                own[key] = value
        return merged | own

    def _key(self, event: Any, depth: int) -> Any:
        if isinstance(event, ScalarEvent) and event.value == "<<" and event.implicit[0]:
            return _MERGE
        key = self._value(event, depth + 1)
        if isinstance(key, (list, dict)):
            raise _problem("a list or mapping as key", event)
        return key

    def _scalar(self, event: ScalarEvent) -> Any:
        text, tag = event.value, event.tag
        self._count(len(text) // _CHARACTERS, event)
        if (wrong := _NOT_TEXT.search(text)) is not None:
            raise _problem(f"the control character U+{ord(wrong[0]):04X} in a text", event)
        if tag in (None, "!"):
            return _resolved(event) if event.implicit[0] else text
        kind = tag.removeprefix(_CORE)
        if kind == "str":
            return text
        value = _resolved(event)
        if kind == "float" and type(value) is int:
            return float(value)
        if kind != {type(None): "null", bool: "bool", int: "int", float: "float"}.get(type(value)):
            raise _problem(f"the tag {tag!r} on {text[:40]!r}", event)
        return value


def _resolved(event: ScalarEvent) -> Any:
    """Return the value of a plain scalar by its form."""
    text = event.value
    if text in _NULL:
        return None
    if text in _BOOL:
        return _BOOL[text]
    if text[0] not in "-+.0123456789":
        return text
    whole = _INT.fullmatch(text)
    if not whole and not FLOAT.fullmatch(text):
        return text
    if len(text) > _MOST_DIGITS:
        raise _problem(f"a number of {len(text)} characters", event)
    if whole:
        return int(text)
    return float(text.replace(".inf", "inf").replace(".nan", "nan") if text[-1].isalpha() else text)


def _check_tag(event: SequenceStartEvent | MappingStartEvent, kind: str) -> None:
    if event.tag not in (None, "!", _CORE + kind):
        raise _problem(f"the tag {event.tag!r}", event)


def _problem(problem: str, event: Any) -> yaml.MarkedYAMLError:
    return yaml.MarkedYAMLError(problem=problem, problem_mark=event.start_mark)
