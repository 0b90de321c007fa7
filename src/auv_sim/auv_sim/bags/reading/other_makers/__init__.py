"""Messages of other makers: numbers and vectors of any type, velocities and odometry in other frames."""
