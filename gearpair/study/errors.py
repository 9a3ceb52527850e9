"""What can go wrong with a chapter, said in one sentence."""


class StudyError(Exception):
    """A chapter, a parameter or a build that cannot be; its text is what the user is told."""
