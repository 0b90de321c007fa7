"""Waypoint files of other programs: one reader for each format, one choice of what is taken."""

from auv_path_following.missions.waypoint_files.choice import Chosen, Use, choose
from auv_path_following.missions.waypoint_files.content import Content, FileShape
from auv_path_following.missions.waypoint_files.file_depths import check_depths, kept
from auv_path_following.missions.waypoint_files.reading import SUFFIXES, read

__all__ = ["SUFFIXES", "Chosen", "Content", "FileShape", "Use", "check_depths", "choose", "kept", "read"]
