"""Results of an evaluation as rows and arrays with documented names, and their output formats."""
