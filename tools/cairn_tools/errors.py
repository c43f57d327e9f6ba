"""The one kind of error that is the user's to mend: it ends the command with one line and exit code 2."""


class UserError(Exception):
    """A bad file, name or argument. The text is one line that says what is wrong and where."""
