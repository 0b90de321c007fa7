"""From recordings and a known vehicle to a vehicle file, tables and a picture."""
