"""A drive in a file: what may stand in it, how it is read, and how it is written."""

from gearpair.drive_file.entries import ENTRIES, GROUPS, Entry
from gearpair.drive_file.reading import DriveFile, read_drive_file, told_of
from gearpair.drive_file.writing import example, write_drive_file

__all__ = [
    "ENTRIES",
    "GROUPS",
    "DriveFile",
    "Entry",
    "example",
    "read_drive_file",
    "told_of",
    "write_drive_file",
]
