"""The wire contract: topics, frames, QoS, stamps, and messages to values and back."""
