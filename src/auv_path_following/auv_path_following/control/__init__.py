"""Heading control: the controllers behind one protocol and the autopilot that drives them."""
