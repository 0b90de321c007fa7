"""Particulars of the REMUS 100 of the Marine Systems Simulator: dimensions, water, mass and inertia."""

from __future__ import annotations

import math

LENGTH, DIAMETER = 1.6, 0.19  # m
#: Densities of the water in the published model: for body and strips; for added mass, lift and fins.
RHO_BODY, RHO = 1025.0, 1026.0
#: Semi-axes of the spheroid, m; it is a little larger than the hull.
A, B = 1.0096 * LENGTH / 2.0, 1.0096 * DIAMETER / 2.0
ZG = 0.02  # m, centre of gravity below the centre of buoyancy
_SINE = math.sin(math.radians(63.446827)) ** 2
GRAVITY = 9.7803253359 * (1.0 + 0.00193185265241 * _SINE) / math.sqrt(1.0 - 0.00669437999013 * _SINE)
MASS = 4.0 / 3.0 * math.pi * RHO_BODY * A * B * B
WEIGHT = MASS * GRAVITY
IX, IY = 0.4 * MASS * B * B, 0.2 * MASS * (A * A + B * B)  # kg m^2, about the centre of gravity
