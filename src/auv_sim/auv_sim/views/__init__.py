"""Pictures of a flight: styles, panels, the overview."""
