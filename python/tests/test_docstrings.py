"""Docstrings: every public name has one, and their examples print what they show."""

import doctest
import inspect
import re

import abbe


def documented():
    yield "abbe", abbe
    for name in abbe.__all__:
        each = getattr(abbe, name)
        yield name, each
        if inspect.isclass(each):
            yield from ((f"{name}.{member}", getattr(each, member)) for member in vars(each) if not member.startswith("_"))


def test_every_public_name_is_documented():
    assert not [name for name, each in documented() if name != "__version__" and not inspect.getdoc(each)]


FUNCTIONS = {
    "pose", "transforms", "error_jacobian", "joint_jacobian", "parameter_jacobian", "displacement", "covariance", "generalized_errors",
    "predict", "source_displacements", "real_pose", "passive", "displaced_pose", "leg_forces",
}  # fmt: skip


def test_functions_say_shape_frame_rows_and_units():
    # Functions with `out` return an array; their docstrings begin with its shape.
    assert FUNCTIONS == {name for name in vars(abbe.Machine) if "out=" in (getattr(getattr(abbe.Machine, name), "__text_signature__", None) or "")}
    for name in sorted(FUNCTIONS | {"inverse"}):
        doc = inspect.getdoc(getattr(abbe.Machine, name))
        assert re.match(r"\((…, )?[A-Za-z0-9, +]+,?\): ", doc), name
        assert "F_0" in doc or name in ("generalized_errors", "passive", "leg_forces"), name
        assert re.search(r"[Rr]ows|[Cc]olumns|each frame|for each|joints", doc), name
        assert re.search(r"length unit|coherent unit|units", doc), name


def test_examples():
    runner, parser = doctest.DocTestRunner(), doctest.DocTestParser()
    for name, each in documented():
        if name != "__version__":
            runner.run(parser.get_doctest(inspect.getdoc(each), {}, name, None, None))
    assert runner.tries > 8 and runner.failures == 0
