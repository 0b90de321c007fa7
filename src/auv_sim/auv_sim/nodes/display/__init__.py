"""The display node: a mission as markers and transforms, for RViz and Foxglove."""
