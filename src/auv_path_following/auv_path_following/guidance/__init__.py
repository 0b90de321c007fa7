"""Guidance: virtual point, line-of-sight laws, subpath switching, current observer, mission state."""
