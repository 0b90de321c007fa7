"""Waypoint files of other programs: one reader for each format, one choice of what is taken."""

from auv_path_following.missions.waypoint_files.choice import Taken, Use, choose
from auv_path_following.missions.waypoint_files.content import Content, Shape
from auv_path_following.missions.waypoint_files.reading import SUFFIXES, read

__all__ = ["SUFFIXES", "Content", "Shape", "Taken", "Use", "choose", "read"]
