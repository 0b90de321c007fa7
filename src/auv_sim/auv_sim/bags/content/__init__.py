"""What a recording contains: its mission, configuration, events and topics."""
