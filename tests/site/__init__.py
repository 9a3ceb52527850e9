"""Gates of the rendered book, in a real browser: `make check-site`."""
