"""The paper flown, measured and judged claim by claim, and the studies that go past it."""
