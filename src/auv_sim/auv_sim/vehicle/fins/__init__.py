"""Servos of fins beside the usual one."""
