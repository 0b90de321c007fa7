"""What differs between flights in the plane and in three dimensions, chosen by the classes of their parts."""
