"""iniVation formats: AEDAT 2, 3.1 and 4."""
