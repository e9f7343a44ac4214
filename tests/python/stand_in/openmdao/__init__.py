"""A small stand-in for OpenMDAO, which is not in Debian."""
