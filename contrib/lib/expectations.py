"""What a test expects, printed statement by statement."""


class Expectations:
    """Print each statement with the word right or WRONG, and count the wrong ones."""

    def __init__(self):
        self.wrong = 0

    def __call__(self, what, is_right):
        self.wrong += not is_right
        print("right" if is_right else "WRONG", what, flush=True)

    def status(self):
        """Return the exit status of the test."""
        return 1 if self.wrong else 0
