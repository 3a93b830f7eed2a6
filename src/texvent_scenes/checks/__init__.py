"""Checks: a staged scene compared with the words of its sentence."""
