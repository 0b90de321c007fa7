"""KML and KMZ: OGC KML 2.2 and Google's tracks."""

from __future__ import annotations

import io
import zipfile
import zlib
from collections import Counter
from collections.abc import Iterator
from xml.etree.ElementTree import Element

from auv_msgs_py.settings.user_files import MOST_BYTES
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions.waypoint_files.content import (
    Content,
    FileShape,
    bounded,
    decimal,
    listed,
    shape,
    shown,
)
from auv_path_following.missions.waypoint_files.xml_tree import local, parse, text_of

#: Geometries without waypoints, and links to other files: counted, not followed.
_NOT_TAKEN = {"Model": "3D model", "GroundOverlay": "image overlay", "NetworkLink": "network link"}
#: A file may also be a fragment.
_ROOTS = ("kml", "Document", "Folder", "Placemark")
#: Values of altitudeMode in which an altitude below 0 is a depth; files without one are taken as meant so.
_ABOVE_THE_SEA = ("", "absolute")
#: Compression methods of KMZ.
_METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)


def read(data: bytes) -> Content:
    """Read every geometry of a KML file.

    Raises:
        ConfigurationError: it is not KML, or a geometry cannot be used.
    """
    content, left_out = Content(), Counter[str]()
    waiting: list[tuple[str, Element]] = [("", parse(data, "KML", _ROOTS))]
    while waiting:
        name, element = waiting.pop()
        kind = local(element)
        if kind == "Placemark":
            name = text_of(element, "name")
        if kind in _NOT_TAKEN:
            left_out[_NOT_TAKEN[kind]] += 1
            continue
        found = list(_shapes(kind, name, element))
        content.add(found)
        if not found:
            waiting.extend((name, child) for child in reversed(element))
    content.notices += [f"{count} {what}(s) not taken" for what, count in left_out.items()]
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
                names = listed(shown(info.filename) for info in roots)
                found_kml = f"{len(roots)} .kml files inside ({names})" if roots else "no .kml file inside"
                raise ConfigurationError("", found_kml, "a KMZ with one doc.kml")
            if roots[0].compress_type not in _METHODS:
                raise ConfigurationError("", "a compression other than deflate", "an ordinary KMZ")
            with archive.open(roots[0]) as file:
                document = file.read(MOST_BYTES + 1)
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError, RuntimeError, ValueError) as error:
        raise ConfigurationError("", f"an archive that cannot be read ({error})", "KMZ") from None
    if len(document) > MOST_BYTES:
        raise ConfigurationError("", f"a document of more than {MOST_BYTES:,} bytes", "a smaller one")
    return read(document)


def _shapes(kind: str, name: str, element: Element) -> Iterator[FileShape]:
    mode = text_of(element, "altitudeMode")
    reference = "" if mode in _ABOVE_THE_SEA else f"in altitudeMode {shown(mode)}"
    try:
        if kind in ("LineString", "LinearRing"):
            yield shape("line", name, _places(element), 0, reference)
        elif kind == "Track":
            places = [_place(at.text or "", None) for at in bounded(element.findall("{*}coord"))]
            yield shape("line", name, places, 0, reference)
        elif kind == "Point":
            yield from (shape("point", name, [place], 0, reference) for place in _places(element))
        elif kind == "Polygon":
            holes = len(element.findall("{*}innerBoundaryIs/{*}LinearRing"))
            for outer in element.findall("{*}outerBoundaryIs/{*}LinearRing"):
                yield shape("polygon", name, _places(outer), holes, reference)
    except (IndexError, ValueError) as error:
        where = f"placemark {shown(name)}" if name else ""
        found = f"coordinates that cannot be read ({error})"
        raise ConfigurationError(where, found, "longitude,latitude and spaces between positions") from None


def _places(element: Element) -> list[list[float]]:
    return [_place(part, ",") for part in bounded((element.findtext("{*}coordinates") or "").split())]


def _place(text: str, separator: str | None) -> list[float]:
    """longitude, latitude, height -> [latitude, longitude, height]."""
    parts = text.split(separator)
    if not 2 <= len(parts) <= 3:  # more: positions without a space between them
        raise ValueError(f"{len(parts)} numbers in {text!r:.40}")
    longitude, latitude, *height = map(decimal, parts)
    return [latitude, longitude, *height]
