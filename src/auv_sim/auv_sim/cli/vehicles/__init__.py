"""Commands about one vehicle: its driver checked, its description made."""
