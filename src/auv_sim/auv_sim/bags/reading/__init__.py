"""Reading any recording, damaged or foreign, into memory and as columns of numbers."""
