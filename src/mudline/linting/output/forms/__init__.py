"""One module a form of findings: `SUMMARY` says what it is, `write` makes its text. A module is a form by being here.

A form has the name of its module. The module is imported when somebody asks for the form.
"""
