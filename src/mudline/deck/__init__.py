"""One file as models: reading and writing the keyword text, JSON and YAML."""
