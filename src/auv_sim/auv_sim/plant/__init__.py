"""The vehicle that is simulated: hull, rudder, water."""
