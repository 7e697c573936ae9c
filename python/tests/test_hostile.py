"""Invalid arguments raise exceptions and do nothing worse."""

import threading

import numpy as np
import pytest

import abbe

machine = abbe.load("ur5")
HOME = np.array(machine.home)
FUNCTIONS = ["pose", "transforms", "error_jacobian", "joint_jacobian", "predict", "source_displacements", "real_pose"]


class Broken:
    def __array__(self, *_, **__):
        raise OSError("no numbers here")

    def __float__(self):
        raise ZeroDivisionError


def wrong():
    """Invalid arrays of joints."""
    for shape in [(), (0,), (5,), (7,), (6, 5), (1, 7), (0, 5), (2, 3, 4), (6, 0), (6, 1)]:
        yield np.zeros(shape)
        yield np.zeros(shape, dtype=">f8")
        yield np.zeros(shape, dtype=np.int8)
        yield np.asfortranarray(np.zeros(shape))
    for value in [np.nan, np.inf, -np.inf]:
        for place in range(6):
            for count in [None, 1, 5, 63, 64, 65]:
                q = np.tile(HOME, (count or 1, 1))
                q[-1, place] = value
                yield q if count else q[0]
    for dtype in [object, complex, bool, "U3", "S3", "M8[s]", "m8[s]", "V8"]:
        yield np.zeros(6, dtype=dtype)
        yield np.zeros((3, 6), dtype=dtype)
    yield from [None, "q", b"q", 3, 1.5, True, object(), {}, {"q1": 1}, set(), Broken(), [Broken()] * 6, [[1], [1, 2]], [[]], []]
    yield from [[None] * 6, ["1"] * 6, [1j] * 6, range(5), iter(range(6)), type, np.float64, lambda: 0]
    yield np.ma.masked_array(np.zeros(6), mask=[0, 0, 1, 0, 0, 0])
    yield {name: np.zeros(3 + i) for i, name in enumerate(machine.variables)}
    yield {name: "x" for name in machine.variables}


def test_wrong_joints():
    calls = 0
    for q in wrong():
        for function in FUNCTIONS:
            with pytest.raises((TypeError, ValueError, OSError)):
                getattr(machine, function)(q)
            calls += 1
    assert calls > 1000


def test_wrong_room():
    q = np.tile(HOME, (3, 1))
    read_only = np.empty((3, 4, 4))
    read_only.flags.writeable = False
    shared = np.zeros(3 * 16)
    unaligned = np.frombuffer(bytearray(3 * 16 * 8 + 1), dtype=np.uint8)[1:].view(np.float64).reshape(3, 4, 4)
    rooms = [
        *(np.empty(shape) for shape in [(), (3,), (4, 4), (3, 4, 3), (1, 3, 4, 4), (0, 4, 4), (2, 4, 4)]),
        *(np.empty((3, 4, 4), dtype=dtype) for dtype in [">f8", "f4", "i8", object, complex]),
        *(np.empty((3, 4, 8))[:, :, ::2], np.empty((3, 4, 4), order="F"), np.empty((4, 4, 3)).T),
        *(read_only, unaligned, np.broadcast_to(np.zeros((4, 4)), (3, 4, 4))),
        *("out", 3, [[0.0]], object(), np.float64(1)),
    ]
    for out in rooms:
        with pytest.raises((TypeError, ValueError)):
            machine.pose(q, out=out)
    with pytest.raises(ValueError, match="overlaps"):
        machine.pose(shared[: 3 * 6].reshape(3, 6), out=shared.reshape(3, 4, 4))


def test_wrong_errors_and_inputs():
    q = np.tile(HOME, (3, 1))
    errors = [np.zeros(n) for n in (0, 6, 7, 41, 43)] + [np.zeros((3, 41)), np.zeros((2, 42)), np.full(42, np.nan), None, "e", {}]
    for function in (machine.displacement, machine.covariance):
        for given in errors:
            with pytest.raises((TypeError, ValueError)):
                function(q, given)
    for name in ["", "payload", "q1", "ΔX", "out ", "\0"]:
        with pytest.raises(TypeError):
            machine.predict(q, **{name: 1})
    for spec in ["", "\0", "/", "/dev/null", "nowhere/at/all.toml", "x" * 10_000, "\ud800", b"ur5\xff", 3, None]:
        with pytest.raises((TypeError, ValueError)):
            abbe.load(spec)
    for text in ["", "\0", "[" * 10_000, "a" * 100_000, "[manipulator]\nname = 3"]:
        with pytest.raises(abbe.SpecError):
            abbe.load(text=text)
    for values in [{"a2": 1}, {"x": "1 mm"}, {"": 1}, {"x": None}, {"x": float("nan")}, {"x=1\ny": 2}]:
        with pytest.raises((TypeError, ValueError)):
            machine.with_parameters(**values)


def test_what_is_only_unusual_works():
    q = np.tile(HOME, (4, 1))
    expected = machine.pose(q)
    for same in [q.astype(">f8"), np.asfortranarray(q), q.tolist(), np.repeat(q, 2, axis=0)[::2], np.broadcast_to(HOME, (4, 6))]:
        assert np.array_equal(machine.pose(same), expected)
    assert np.array_equal(machine.pose(np.zeros(6, dtype=np.float32)), machine.pose([0] * 6))
    assert machine.pose(np.empty((0, 6))).shape == (0, 4, 4)
    assert machine.error_jacobian(np.empty((3, 0, 6))).shape == (3, 0, 6, 36)


def test_threads():
    q = np.random.default_rng(0).uniform(-3, 3, (5000, 6))
    expected, found = machine.error_jacobian(q), {}

    def work(i):
        found[i] = abbe.load("ur5").error_jacobian(q) if i % 2 else machine.error_jacobian(q)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 8 and all(np.array_equal(each, expected) for each in found.values())


def test_one_array_is_written_by_one_call():
    q = np.random.default_rng(0).uniform(-3, 3, (20_000, 6))
    out, refused = np.empty((20_000, 6, 36)), []

    def work():
        try:
            machine.error_jacobian(q, out=out)
        except ValueError as error:
            refused.append(str(error))

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all("another call" in error for error in refused) and len(refused) < 8
    assert np.array_equal(out, machine.error_jacobian(q))
