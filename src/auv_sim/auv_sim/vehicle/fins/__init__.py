"""Servos of the fins."""
