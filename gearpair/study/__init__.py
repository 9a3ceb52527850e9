"""The study around the library: its command line, its chapters and its book.

`chapters` reads what a chapter declares, `execution` runs one, `book` builds the site and `cli` is the command
``gearpair``. None of it is imported by ``import gearpair``.
"""
