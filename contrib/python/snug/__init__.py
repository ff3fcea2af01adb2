"""Drive the contact shape optimization program Snug: evaluate designs, and read results."""

from .errors import DesignFailed, Died, InputError, RequestError, SnugError
from .model import Model, Result
from .modes import heights
from .reader import Run, read

__all__ = ["DesignFailed", "Died", "InputError", "Model", "RequestError", "Result", "Run",
           "SnugError", "heights", "read"]
