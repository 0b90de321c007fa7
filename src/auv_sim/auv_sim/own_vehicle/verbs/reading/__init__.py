"""Recordings as the identification takes them, and the units of their fins."""
