"""The command line: words in, calls to the library, tables and files out."""
