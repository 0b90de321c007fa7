"""What a flown mission tells: the `Run` itself, its figures and its picture."""
