"""Paths, guidance and control for underwater vehicles: pure laws, and the thin nodes around them."""
