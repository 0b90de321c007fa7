"""What ends a dive, and the ascent that follows it."""
