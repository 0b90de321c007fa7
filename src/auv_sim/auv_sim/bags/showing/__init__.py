"""Tables, pictures and the report page made of recordings."""
