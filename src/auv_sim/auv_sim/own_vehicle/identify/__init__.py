"""Identify a hull from its manoeuvres: coefficients, rudder, delays and current, with intervals."""
