"""Whole waypoint files, each suffix with all that its reader looks at."""

from __future__ import annotations

import io
import json
import zipfile
from typing import Any

_PLACES = [(63.447, 10.399), (63.448, 10.401), (63.446, 10.403)]
_LON_LAT = [[lon, lat, -5.0] for lat, lon in _PLACES]
_RING = [*_LON_LAT, _LON_LAT[0]]
_TEXT = " ".join(f"{lon},{lat},0" for lat, lon in _PLACES)


def _item(command: int, place: tuple[float, float] = (0.0, 0.0), **more: Any) -> dict[str, Any]:
    return {
        "command": command,
        "frame": 3,
        "autoContinue": True,
        "params": [0, 1.2, 0, None, *place, -5],
    } | more


_POINTS = [_item(16, place) for place in _PLACES]
_SURVEY = {
    "type": "ComplexItem",
    "complexItemType": "survey",
    "polygon": _PLACES,
    "TransectStyleComplexItem": {"Items": [_POINTS[1], _item(2000), _POINTS[2]]},
}
_FENCES = {
    "polygons": [{"inclusion": True, "polygon": _PLACES}, {"inclusion": False, "polygon": _PLACES}],
    "circles": [{"inclusion": True, "circle": {"center": _PLACES[0], "radius": 9}}],
}
_PLAN = {
    "fileType": "Plan",
    "geoFence": _FENCES,
    "rallyPoints": {"points": [[*_PLACES[0], 0]]},
    "mission": {"items": [_item(22), _item(178), _POINTS[0], _SURVEY, _item(93), _item(20)], "version": 2},
}
_OLD_PLAN = {
    "plannedHomePosition": [*_PLACES[0], 0],
    "items": [_item(16, params=[0, 0, 0, None], coordinate=[*place, 9]) for place in _PLACES],
}


def _feature(kind: str, coordinates: Any, name: str = "a") -> dict[str, Any]:
    return {
        "type": "Feature",
        "properties": {"name": name},
        "geometry": {"type": kind, "coordinates": coordinates},
    }


_MULTI = _feature("MultiLineString", [_LON_LAT])


def _features(*features: Any) -> str:
    return json.dumps({"type": "FeatureCollection", "features": features})


def _kml(body: str) -> str:
    spaces = 'xmlns="http://www.opengis.net/kml/2.2" xmlns:gx="http://www.google.com/kml/ext/2.2"'
    return f'<?xml version="1.0"?><kml {spaces}><Document><name>d</name>{body}</Document></kml>'


def _placemark(body: str) -> str:
    return f"<Placemark><name>a</name>{body}</Placemark>"


_RING_KML = f"<LinearRing><coordinates>{_TEXT} 10.399,63.447,0</coordinates></LinearRing>"
_LINE_KML = f"<LineString><coordinates>{_TEXT}</coordinates></LineString>"
_TRACK = "".join(f"<gx:coord>{lon} {lat} 0</gx:coord>" for lat, lon in _PLACES)


def _gpx(kind: str) -> str:
    return "".join(f'<{kind} lat="{lat}" lon="{lon}"><ele>3</ele></{kind}>' for lat, lon in _PLACES)


def _wpl(*rows: tuple[int, int, float, float]) -> str:
    lines = (
        f"{k}\t0\t{frame}\t{command}\t3\t0\t0\t0\t{x}\t{y}\t0\t1"
        for k, (frame, command, x, y) in enumerate(rows)
    )
    return "\n".join(["QGC WPL 110", *lines]) + "\n"


#: Suffix -> texts.
TEXTS: dict[str, tuple[str, ...]] = {
    "geojson": (
        _features(_feature("LineString", _LON_LAT)),
        _features(_feature("Polygon", [_RING]), _feature("Point", _LON_LAT[0], "b")),
        _features(_feature("MultiPoint", _LON_LAT), {"geometry": None}),
        json.dumps({"type": "GeometryCollection", "geometries": [_MULTI["geometry"]]}),
    ),
    "kml": (
        _kml(_placemark(_LINE_KML)),
        _kml(_placemark(_LINE_KML.replace(",0", ",-6"))),
        _kml(_placemark(f"<MultiGeometry><Polygon><outerBoundaryIs>{_RING_KML}</outerBoundaryIs></Polygon></MultiGeometry>")),
        _kml(f"<Folder>{_placemark(f'<gx:Track>{_TRACK}</gx:Track>')}<NetworkLink/></Folder>"),
    ),
    "csv": (
        "name,latitude,longitude\n" + "".join(f"a,{lat},{lon}\n" for lat, lon in _PLACES),
        "# c\nLatitude (deg);Long_DD;depth\n"
        + "".join(f"{lat};{lon};3\n".replace(".", ",") for lat, lon in _PLACES),
        "north\teast\n0\t0\n50\t0\n50\t50\n",
        "north,east,depth_m\n0,0,5\n50,0,9\n50,50,7\n",
    ),
    "plan": (json.dumps(_PLAN), json.dumps({"mission": {"items": _POINTS}})),
    "mission": (json.dumps(_OLD_PLAN),),
    "gpx": (
        f"<gpx><rte><name>a</name>{_gpx('rtept')}</rte></gpx>",
        f'<gpx xmlns="http://www.topografix.com/GPX/1/1"><trk><trkseg>{_gpx("trkpt")}</trkseg></trk>{_gpx("wpt")}</gpx>',
    ),
    "waypoints": (
        _wpl((0, 16, 63.0, 10.0), (3, 178, 0, 0), *((3, 16, *place) for place in _PLACES), (3, 20, 0, 0)),
        _wpl(*((3, 5001, *place) for place in _PLACES)),
    ),
}  # fmt: skip


def files(suffix: str) -> list[bytes]:
    """Make whole files of a suffix, `kmz` among them."""
    if suffix != "kmz":
        return [text.encode() for text in TEXTS[suffix]]
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        # A fixed date: the same bytes at any time, and so the same spoiled files.
        archive.writestr(zipfile.ZipInfo("doc.kml"), TEXTS["kml"][0], zipfile.ZIP_DEFLATED)
        archive.writestr(zipfile.ZipInfo("images/pin.png"), bytes(range(256)))
    return [packed.getvalue()]
