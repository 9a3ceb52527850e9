"""Measurements of the engine, printed by ``make bench``."""
