"""The measurements of the benchmark, and the processes that are measured."""
