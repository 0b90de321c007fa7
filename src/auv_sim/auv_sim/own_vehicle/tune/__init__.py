"""Gains for a vehicle, or for all that its uncertain coefficients allow: search, margins, acceptance."""
