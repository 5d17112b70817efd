"""Force-embedment curves."""
