"""Playing a recording into a live graph."""
