"""A mission in Foxglove, over its own SDK."""
