"""The assignments are graded by `make teach`; the tests of the book's notebooks leave them out."""

collect_ignore_glob = ["*"]
