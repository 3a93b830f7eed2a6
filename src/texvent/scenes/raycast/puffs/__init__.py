"""Translucent puffs of smoke, steam, mist and flame."""
