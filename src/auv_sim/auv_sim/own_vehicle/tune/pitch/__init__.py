"""Tuning of the stern planes."""
