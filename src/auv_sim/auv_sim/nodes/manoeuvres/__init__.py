"""The node that flies manoeuvres for identification."""
