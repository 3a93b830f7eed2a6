"""Recordings and clips for checks, fetched by package name and verified."""
