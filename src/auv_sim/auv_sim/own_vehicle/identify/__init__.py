"""Identify a hull from recordings of its manoeuvres: coefficients, rudder, delays, current, with intervals."""
