"""What an evaluation gave, as rows and arrays with the names of the contract, and its output formats."""
