"""Library of keywords: one module per subject, which declares the blocks of its keywords."""
