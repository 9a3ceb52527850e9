"""What makes and checks the book, from a checkout: no part of what ``pip install`` brings."""
