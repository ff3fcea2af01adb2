"""Errors of the program, by what the caller can do about them."""


class SnugError(Exception):
    """Base of all errors; `kind` is the kind of the error in the protocol."""

    kind = "internal"


class RequestError(SnugError, ValueError):
    """The request is wrong (form, name, size or bound), and nothing was computed."""

    kind = "request"


class InputError(SnugError, ValueError):
    """The model is wrong: `file`, `line`, `entry`, `value`, `allowed` and `suggestion`, None where
    unknown."""

    kind = "input"
    file = line = entry = value = allowed = suggestion = None


class DesignFailed(SnugError):
    """The design has no value: its mesh is tangled, or its state was not solved."""

    kind = "solve"


class Died(SnugError):
    """The process ended, with the exit status `status` and the last lines `log` of its log."""

    kind = "died"

    def __init__(self, message, status, log):
        super().__init__(message)
        self.status, self.log = status, log


def error_of(part):
    """Return the exception of the member `error` of an answer."""
    kinds = {"request": RequestError, "input": InputError, "tangled": DesignFailed,
             "solve": DesignFailed}
    error = kinds.get(part["kind"], SnugError)(part["message"])
    error.__dict__.update((key, value) for key, value in part.items() if key != "message")
    return error
