"""Read XML of other programs; document types are refused, because their entities can grow without bound."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree

from auv_msgs_py.values.errors import ConfigurationError

#: Bytes fed to the parser at a time, so that it stops soon after a document type.
_PIECE = 65536


#: Most elements of a file: each takes about 200 bytes of memory.
_MOST_ELEMENTS = 400_000


class _BoundedTree(ElementTree.TreeBuilder):
    def __init__(self) -> None:
        super().__init__()
        self._elements = 0

    def start(self, tag: str, attributes: dict[str, str], /) -> ElementTree.Element:
        self._elements += 1
        if self._elements > _MOST_ELEMENTS:
            raise ConfigurationError("", f"more than {_MOST_ELEMENTS} XML elements", "a smaller file")
        return super().start(tag, attributes)

    def doctype(self, *_: Any) -> None:
        raise ConfigurationError("", "a document type (<!DOCTYPE>)", "XML without one")


def parse(data: bytes, what: str, roots: tuple[str, ...]) -> ElementTree.Element:
    """Parse XML.

    Args:
        data: the file.
        what: the format, for messages.
        roots: local names that the outermost element may have.

    Raises:
        ConfigurationError: it has a document type, is not XML, or is another format.
    """
    parser = ElementTree.XMLParser(target=_BoundedTree())  # noqa: S314 - without a document type no entities
    try:
        for begin in range(0, len(data), _PIECE):
            parser.feed(data[begin : begin + _PIECE])
        found: ElementTree.Element = parser.close()
    except (ElementTree.ParseError, LookupError, ValueError) as error:
        raise ConfigurationError("", f"text that is not XML ({error})", what) from None
    if local(found) not in roots:
        expected = f"{what}, which has <{roots[0]}>"
        raise ConfigurationError("", f"XML with the root <{local(found)[:40]}>", expected)
    return found


def local(element: ElementTree.Element) -> str:
    """Return an element's name without its namespace."""
    return str(element.tag).rsplit("}", 1)[-1]


def text_of(element: ElementTree.Element, child: str) -> str:
    """Return the text of a child; empty where there is none."""
    return (element.findtext(f"{{*}}{child}") or "").strip()
