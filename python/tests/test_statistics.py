"""Statistics as arrays, and many targets at once."""

import sys
import warnings

import numpy as np
import pytest

import abbe

ur5 = abbe.load("ur5")


def test_many_targets_are_each_as_one():
    q = np.random.default_rng(1).uniform(-2, 2, (4, 30, 6))
    poses = ur5.pose(q)
    found = ur5.inverse(poses)
    assert found.shape == q.shape and np.abs(ur5.pose(found) - poses).max() < 1e-6
    assert np.array_equal(found[1, 2], ur5.inverse(poses[1, 2]))
    points = poses[..., :3, 3]
    assert np.abs(ur5.pose(ur5.inverse(points))[..., :3, 3] - points).max() < 1e-6
    several = ur5.inverses(poses[0])
    alone = [ur5.inverses(pose) for pose in poses[0]]
    assert several.shape == (30, max(map(len, alone)), 6)
    for rows, expected in zip(several, alone, strict=True):
        assert np.array_equal(rows[: len(expected)], expected) and np.isnan(rows[len(expected) :]).all()


def test_targets_out_of_reach_are_not_a_number_and_said():
    poses = ur5.pose(np.zeros((3, 6)) + 0.3)
    poses[1, :3, 3] = 1e5
    with pytest.warns(UserWarning, match="1 of 3 targets are not reached: their rows are NaN"):
        found = ur5.inverse(poses)
    assert np.isnan(found[1]).all() and np.isfinite(found[[0, 2]]).all()
    with pytest.warns(UserWarning, match="1 of 3 targets"):
        assert np.isnan(ur5.inverses(poses)[1]).all()
    with pytest.raises(ValueError, match="reach"):
        ur5.inverse(poses[1])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert ur5.inverse(np.zeros((0, 4, 4))).shape == (0, 6)
    for wrong in (np.zeros((5, 4)), np.zeros((2, 3, 4))):
        with pytest.raises(ValueError, match="`target` has shape"):
            ur5.inverse(wrong)
    with pytest.raises(ValueError, match="tool points"):
        ur5.inverses([0.0, 0.0, 0.0])


@pytest.mark.skipif(sys.version_info < (3, 11), reason="tomllib comes with Python 3.11")
def test_covariance_of_the_tool_is_that_of_the_errors():
    import tomllib

    machine = ur5.identify(ur5.simulate("ur5", samples=60, seed=1).table("rows"), "ur5").load()
    covariance = tomllib.loads(machine.text)["covariance"]
    names = {name: number for number, name in enumerate(machine.frames, 1)}
    assert all(set(one) <= {"frame", "error"} and one.get("frame", "base") for one in covariance["of"]), covariance["of"]
    q = np.random.default_rng(2).uniform(-2, 2, (20, 6))
    jacobian = machine.error_jacobian(q)[:, :3]
    at_base = base_columns(machine, q)
    columns = [
        jacobian[:, :, machine.columns.index(f"{one['error']}{names[one['frame']]}")] if "frame" in one else at_base[one["error"]]
        for one in covariance["of"]
    ]
    of_errors = np.stack(columns, axis=-1)
    expected = of_errors @ np.array(covariance["rows"]) @ of_errors.swapaxes(1, 2)
    random = [name for name in machine.sources if "encoder" in name or "not identified" in name]
    found = machine.disable(*random).tool_covariance(q)
    assert found.shape == (20, 3, 3) and np.array_equal(found, found.swapaxes(1, 2))
    # The Jacobian of the real machine differs from that of the ideal one to first order in its errors.
    assert np.abs(found - expected).max() < 0.02 * np.abs(expected).max()
    more = machine.tool_covariance(q)
    assert (np.linalg.eigvalsh(more - found) > -1e-12).all() and more.trace(axis1=1, axis2=2).min() > found.trace(axis1=1, axis2=2).min()
    assert np.array_equal(machine.tool_covariance(q[3]), more[3])
    with pytest.raises(ValueError, match="no \\[covariance\\]"):
        ur5.tool_covariance(q)


def base_columns(machine, q):
    """Return the columns of errors of F_0, by their names."""
    points = machine.pose(q)[:, :3, 3]
    axes = dict(zip("prs", np.eye(3)[[0, 2, 1]], strict=True))
    moved = {f"e_{axis}": np.broadcast_to(direction, points.shape) for axis, direction in zip("xyz", np.eye(3), strict=True)}
    return moved | {f"e_{axis}": np.cross(direction, points) for axis, direction in axes.items()}


def test_residuals_are_rows():
    found = ur5.identify(ur5.simulate("ur5", samples=60, seed=1).table("rows"), "ur5")
    rows = found.table("rows")
    assert len(rows) == 60 and rows.columns[0] == "line" and not rows["test"].any()
    for names, figures in ((["x before", "y before", "z before"], found.fit.base_and_tool), (["x", "y", "z"], found.fit.after)):
        sizes = np.linalg.norm([rows[name] for name in names], axis=0)
        assert np.sqrt(np.mean(sizes**2)) == pytest.approx(figures.rms) and sizes.max() == pytest.approx(figures.max)
