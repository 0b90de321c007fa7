"""The processes of a mission: loading, starting, placing, finding each other, ending."""
