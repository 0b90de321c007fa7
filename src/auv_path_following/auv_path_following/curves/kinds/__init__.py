"""The kinds of segments, one a file."""
