"""MAVLink over UDP: datagrams, signatures, the peer and the link to it."""
