"""Forms of findings, one file each."""
