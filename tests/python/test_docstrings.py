"""Examples in documentation strings run, and every public name has one."""
import doctest
import importlib
import inspect
import pkgutil

import hexwright


NEED_EXTRAS = ("_pyvista",)  # packages that need not be installed


def modules():
    yield hexwright
    for info in pkgutil.iter_modules(hexwright.__path__):
        if info.name not in ("_core", *NEED_EXTRAS):
            yield importlib.import_module(f"hexwright.{info.name}")


def test_examples_run():
    results = [doctest.testmod(module, extraglobs={"hexwright": hexwright}) for module in modules()]
    assert sum(result.failed for result in results) == 0
    assert sum(result.attempted for result in results) >= 8


def test_public_names_are_explained():
    for name in hexwright.__all__:
        thing = getattr(hexwright, name)
        if callable(thing):
            assert inspect.getdoc(thing), name
        for attribute, member in vars(thing).items() if inspect.isclass(thing) else ():
            is_ours = inspect.isfunction(member) or isinstance(member, property)
            if is_ours and not attribute.startswith("_"):
                assert inspect.getdoc(member), f"{name}.{attribute}"
