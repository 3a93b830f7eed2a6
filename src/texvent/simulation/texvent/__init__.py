"""The paper's pixel model (Eqs. 5-7)."""
