"""One module a form of result files, with the name of the suffix. A module is a form by being here.

It holds what `mudline.cli.evaluate_outputs.ResultFile` says, and is imported when somebody asks for the form.
"""
