"""The parts of a compiled flight that depend on its kind, each chosen by the class of its first argument."""

from __future__ import annotations

from auv_msgs_py.values.pure import dispatched
from auv_msgs_py.values.types import Current, Navigation, SpatialCurrent, SpatialNavigation
from auv_path_following.comparators.peer_pilot import (
    PeerPilot,
    peer_begun,
    peer_largest_angle,
    peer_reply,
    peer_stop,
)
from auv_path_following.curves.rows import PathRows
from auv_path_following.curves.spatial.spatial_rows import SpatialRows
from auv_path_following.pilot import Pilot, begun
from auv_path_following.spatial_pilot import SpatialPilot, spatial_begun
from auv_sim.flight.batch.kinds import planar_kind as planar
from auv_sim.flight.batch.kinds import spatial_kind as spatial
from auv_sim.flight.batch.track_row import fill_row, fill_spatial_row
from auv_sim.vehicle.at_sea import Seen
from auv_sim.vehicle.diving.ideal_diver import SpatialSeen
from auv_sim.vehicle.hulls.rigid_body import BodyState
from auv_sim.vehicle.hulls.spatial_plant import SpatialPlant
from auv_sim.vehicle.remus import Plant, PlantState

#: First state of a vehicle and the constant current, from rows of numbers.
start_from = dispatched({Plant: planar.planar_start, SpatialPlant: spatial.spatial_start})
#: State of a mission that has just been started: (pilot, approach) -> state.
begins = dispatched({Pilot: begun, SpatialPilot: spatial_begun, PeerPilot: peer_begun})
#: The command of a vehicle at rest.
at_rest = dispatched({Pilot: planar.planar_stop, SpatialPilot: spatial.spatial_stop, PeerPilot: peer_stop})
#: (pilot, path, state, seen, now, dt) -> (state, navigation, estimate, guidance's output, command).
reply = dispatched({Pilot: planar.planar_answer, SpatialPilot: spatial.spatial_reply, PeerPilot: peer_reply})
#: Largest angle of the rudder, rad.
largest_angle = dispatched(
    {
        Pilot: planar.planar_largest_angle,
        SpatialPilot: spatial.spatial_largest_angle,
        PeerPilot: peer_largest_angle,
    }
)
#: (path, outlines, nearest, i, motion, covered) -> (nearest, distance, how far below the path), m.
off_followed = dispatched({PathRows: planar.planar_off, SpatialRows: spatial.spatial_off})
#: (path, outlines, i, motion) -> (distance, how far below) of the subpaths before and after subpath i, m.
off_beside = dispatched({PathRows: planar.planar_beside, SpatialRows: spatial.spatial_beside})
#: Whether the motion of a vehicle is finite.
is_finite = dispatched({PlantState: planar.planar_is_finite, BodyState: spatial.spatial_is_finite})
#: (estimate, current) -> squared error.
squared_error = dispatched(
    {Current: planar.planar_squared_error, SpatialCurrent: spatial.spatial_squared_error}
)
#: Counts what only one kind has: (path, whole, subpaths, i, elapsed, calm, motion, how far below) -> whether
#: the vehicle is at a corner.
count_extras = dispatched({PathRows: planar.planar_extras, SpatialRows: spatial.spatial_extras})
#: Counts a step: (seen, seen before, subpaths, i, dt) -> distance covered, m.
count_motion = dispatched({Seen: planar.planar_after, SpatialSeen: spatial.spatial_after})
#: Marks the cells that a step passes: (path, cells, flown, s, motion before, motion after).
mark_cells = dispatched({PathRows: planar.planar_pass, SpatialRows: spatial.spatial_pass})
#: Writes the last position: (motion, end).
write_end = dispatched({PlantState: planar.planar_end, BodyState: spatial.spatial_end})
#: Writes an odometry: (navigation, row, number, seen, guidance's output, estimate, command).
write_row = dispatched({Navigation: fill_row, SpatialNavigation: fill_spatial_row})
