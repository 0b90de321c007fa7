"""The console's web server: its guard, its page, its socket."""
