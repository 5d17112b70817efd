"""Normal laws of elements: one file a law, value and tangent side by side.

A law's file is loaded only when some element has the law.
"""
