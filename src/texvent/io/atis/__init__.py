"""Formats of ATIS recordings: .es and the .bin of N-MNIST."""
