"""CSV files as spreadsheets, chart plotters and scripts write them."""

from __future__ import annotations

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions.waypoint_files import csv_table


def _points(text: str, encoding: str = "utf-8") -> list:
    return [shape.points[0] for shape in csv_table.read(text.encode(encoding)).shapes]


@pytest.mark.parametrize(
    "header",
    [
        "lat,lon", "LAT,LONG", "Latitude (deg),Longitude (deg)", "Latitude_DD,Longitude_DD",
        "lat_deg,lng_deg", "latitude [°],longitude [°]", '"Latitude","Longitude"', " lat , lon ",
        "Lat (decimal degrees),Long (decimal degrees)",
    ],
)  # fmt: skip
def test_headers_that_people_have_are_read(header):
    assert _points(f"{header}\n59.9,10.6\n") == [(59.9, 10.6)]


@pytest.mark.parametrize(
    ("text", "encoding"),
    [
        ("lat;lon\n59,9;10,6\n", "utf-8"),
        ("lat;lon\r\n59.9;10.6\r\n", "utf-8-sig"),
        ("lat\tlon\n59,9\t10,6\n", "utf-16"),
        ('lat,lon\n"59,9","10,6"\n', "utf-8"),
        ("Latitude (°);Longitude (°)\n59,9;10,6\n", "cp1252"),
        ("lat,lon,\n59.9,10.6,\n", "utf-8"),
    ],
)
def test_delimiters_decimal_commas_and_encodings(text, encoding):
    assert _points(text, encoding) == [(59.9, 10.6)]


def test_columns_that_are_not_taken_are_named():
    content = csv_table.read(b"Name,lat,lon,alt\nA,59.9,10.6,-5\n")
    assert content.notices == ["columns not taken: 'Name', 'alt'"]


@pytest.mark.parametrize("name", ["depth", "Depth (m)", "depth_m", "DEPTH [metres]"])
def test_a_depth_is_read_by_its_column(name):
    content = csv_table.read(f"lat,lon,{name}\n59.9,10.6,5\n59.9,10.7,\n".encode())
    assert content.shapes[0].heights == (5.0,)
    assert content.shapes[1].heights == ()
    assert content.shapes[0].is_down
    assert content.notices == []


def test_two_columns_of_depth_are_refused():
    with pytest.raises(ConfigurationError, match="2 columns of depth, expected one: delete the others"):
        csv_table.read(b"lat,lon,depth,depth_m\n59.9,10.6,5,5\n")


def test_a_depth_that_is_no_number_is_refused_with_its_point():
    with pytest.raises(ConfigurationError, match=r"point 2: found '59\.9, 10\.7, deep', expected three"):
        csv_table.read(b"lat,lon,depth\n59.9,10.6,5\n59.9,10.7,deep\n")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("lat,lon,north,east\n1,2,3,4\n", "both pairs of columns"),
        (
            "lat,latitude,lon\n1,2,3\n",
            "2 columns of latitude, expected one: delete the others of 'lat', 'latitude'",
        ),
        ("lat (ddmm),lon (ddmm)\n5954.0,1036.0\n", "the header 'lat (ddmm),lon (ddmm)'"),
        ("59.9,10.6\n59.8,10.6\n", "the header '59.9,10.6', expected a header"),
        ("lat,lon\n59,9,10,6\n", "point 1: found 4 values under 2 headings"),
        ("lat;lon\n1.234,5;3\n", "point 1: found"),
        ("lat;lon\n1_0;3\n", "point 1: found"),
        ("lat;lon\n59°54'N;3\n", "expected two numbers in decimal notation"),
    ],
)
def test_what_could_be_misread_is_refused(text, said):
    with pytest.raises(ConfigurationError) as caught:
        csv_table.read(text.encode())
    assert said in str(caught.value)
