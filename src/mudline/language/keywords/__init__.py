"""Keywords: a module for each in `library`, with the declaration of its fields; reading and writing of any keyword."""
