"""Migration of legacy seabed keywords to the new family, and the verification of equal meaning."""
