"""Digits: networks trained on simulated recordings, tested on those of a real sensor."""
