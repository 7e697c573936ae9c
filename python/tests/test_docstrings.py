"""What the examples in docstrings print."""

import doctest
import inspect

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


def test_examples():
    runner, parser = doctest.DocTestRunner(), doctest.DocTestParser()
    for name, each in documented():
        if name != "__version__":
            runner.run(parser.get_doctest(inspect.getdoc(each), {}, name, None, None))
    assert runner.tries > 8 and runner.failures == 0
