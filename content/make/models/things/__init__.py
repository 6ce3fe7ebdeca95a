"""Loose things that hands pick up and throw, one to a module."""
