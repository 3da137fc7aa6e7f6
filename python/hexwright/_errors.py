"""What can go wrong, as exceptions (``InvalidMesh`` is beside the mesh it holds). Messages name the place and the remedy."""


class HexwrightError(Exception):
    """Of all errors of this package.

    Attributes
    ----------
    where : str
        The file and line, the argument or the option that the message is about; empty when there is none.
    """

    where: str = ""


class BadInput(HexwrightError, ValueError):
    """An argument, an option or a file is not what it must be."""


class BadGeometry(HexwrightError, ValueError):
    """The input is well formed but cannot be meshed: empty, flat, not overlapping."""


class OutOfResources(HexwrightError, MemoryError):
    """A budget of cells or hexes, or the memory, does not suffice."""


class Cancelled(HexwrightError):
    """``progress`` returned False."""


class HexwrightWarning(UserWarning):
    """A mesh was made but misses the gate; its ``failures`` say why."""
