"""What a scene hands to the evaluator besides normal laws per unit length, a module for each subject.

They are imported only when a deck asks for them.
"""
