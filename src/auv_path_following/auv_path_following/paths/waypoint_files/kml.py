"""KML and KMZ: OGC KML 2.2 and Google's tracks."""

from __future__ import annotations

import io
import zipfile
import zlib
from collections.abc import Iterator
from xml.etree.ElementTree import Element

from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.user_files import MOST_BYTES
from auv_path_following.paths.waypoint_files.content import Content, Shape, shape, shown
from auv_path_following.paths.waypoint_files.xml_tree import local, parse, text_of

#: Geometries without waypoints, and links to other files: reported, not followed.
_NOT_TAKEN = {"Model": "3D model", "GroundOverlay": "image overlay", "NetworkLink": "link to another file"}
#: Compression methods of KMZ.
_METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)


def read(data: bytes) -> Content:
    """Read every geometry of a KML file.

    Raises:
        ConfigurationError: it is not KML, or a geometry cannot be used.
    """
    content = Content()
    waiting: list[tuple[str, Element]] = [("", parse(data, "KML", "kml"))]
    while waiting:
        name, element = waiting.pop()
        kind = local(element)
        if kind == "Placemark":
            name = text_of(element, "name")
        if kind in _NOT_TAKEN:
            content.notices.append(f"{_NOT_TAKEN[kind]} {shown(text_of(element, 'name') or name)} not taken")
            continue
        found = list(_shapes(kind, name, element))
        content.shapes.extend(found)
        if not found:
            waiting.extend((name, child) for child in reversed(element))
    return content


def read_zipped(data: bytes) -> Content:
    """Read the document of a KMZ: `doc.kml`, else the only .kml.

    Raises:
        ConfigurationError: it is not a KMZ, or its document cannot be used.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            found = [info for info in archive.infolist() if info.filename.lower().endswith(".kml")]
            roots = [info for info in found if info.filename.lower() == "doc.kml"] or found
            if len(roots) != 1:
                raise ConfigurationError("", f"{len(roots)} .kml files inside", "a KMZ with one doc.kml")
            if roots[0].compress_type not in _METHODS:
                raise ConfigurationError("", "a compression other than deflate", "an ordinary KMZ")
            with archive.open(roots[0]) as file:
                document = file.read(MOST_BYTES + 1)
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError, RuntimeError, ValueError) as error:
        raise ConfigurationError("", f"an archive that cannot be read ({error})", "KMZ") from None
    if len(document) > MOST_BYTES:
        raise ConfigurationError("", f"a document of more than {MOST_BYTES:,} bytes", "a smaller one")
    return read(document)


def _shapes(kind: str, name: str, element: Element) -> Iterator[Shape]:
    try:
        if kind in ("LineString", "LinearRing"):
            yield shape("line", name, _places(element))
        elif kind == "Track":
            yield shape("line", name, [_place(at.text or "", None) for at in element.findall("{*}coord")])
        elif kind == "Point":
            yield from (shape("point", name, [place]) for place in _places(element))
        elif kind == "Polygon":
            outer = element.find("{*}outerBoundaryIs/{*}LinearRing")
            if outer is None:
                raise ValueError("no outerBoundaryIs")
            holes = len(element.findall("{*}innerBoundaryIs/{*}LinearRing"))
            yield shape("polygon", name, _places(outer), holes)
    except (IndexError, ValueError) as error:
        where = f"placemark {shown(name)}" if name else ""
        found = f"coordinates that are not numbers ({error})"
        raise ConfigurationError(where, found, "longitude,latitude as KML has it") from None


def _places(element: Element) -> list[list[float]]:
    return [_place(part, ",") for part in (element.findtext("{*}coordinates") or "").split()]


def _place(text: str, separator: str | None) -> list[float]:
    """longitude, latitude, height -> [latitude, longitude, height]."""
    longitude, latitude, *height = (float(part) for part in text.split(separator)[:3])
    return [latitude, longitude, *height]
