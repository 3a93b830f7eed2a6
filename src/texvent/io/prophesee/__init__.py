"""Prophesee formats: EVT 2, 2.1 and 3, DAT, HDF5 with ECF."""
