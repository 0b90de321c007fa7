"""What the console shows of a vehicle: rows, health, alarms, events, readiness."""
