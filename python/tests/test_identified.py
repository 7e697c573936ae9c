"""Identified machines: changes of the machine, files of tables, and the covariance of what was identified."""

import pickle
import sys

import numpy as np
import pytest

import abbe
from abbe.spec import DH, Frame, Manipulator, Source, Variable

ur5 = abbe.load("ur5")


def tracked(machine, **inputs):
    """Return a map of tool points, with the inputs."""
    angles = {name: {"column": name, "unit": "rad" if abs(low) < 10 else machine.length} for name, (low, _) in zip(machine.variables, machine.limits, strict=True)}
    return {"data": {"uncertainty": "0.01 mm"}, "joints": angles, "point": {"columns": ["x", "y", "z"], "unit": machine.length}} | inputs


def planar():
    frames = [
        Frame(name=name, variable=Variable(name=joint, kind="revolute", limits=["-150 deg", "150 deg"]), dh=DH(theta=joint, d=0, a=a, alpha="90 deg"))
        for name, joint, a in [("upper", "q1", "upper_length"), ("lower", "q2", 300), ("hand", "q3", 80)]
    ]
    sources = [
        Source(name="bent", class_="repeatable", frame="lower", e_z="load * 1e-5 m/kg"),
        Source(name="gear", class_="repeatable", joint="q2", error="2e-4"),
        Source(name="encoder", class_="random", distribution="normal", joint="q1", error="2e-5"),
    ]
    spec = Manipulator(name="planar", length="mm", frames=frames, parameters={"upper_length": "400 mm"}, inputs={"load": "10 kg"}, sources=sources)
    return spec.load()


CHANGES = {
    "disable": lambda machine: machine.disable(machine.sources[0]),
    "enable": lambda machine: machine.disable(*machine.sources[:2]).enable(machine.sources[1]),
    "scale": lambda machine: machine.scale(machine.sources[1], 0.5),
    "with_source": lambda machine: machine.with_source({"name": "more", "class": "repeatable", "frame": machine.frames[0], "e_y": 0.01}).disable("more"),
    "with_parameters": lambda machine: machine.with_parameters(**{name: 1.01 * value for name, value in machine.parameters.items()}),
    "several": lambda machine: machine.scale(machine.sources[0], 2).disable(machine.sources[1]).scale(machine.sources[0], 0.25),
}


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("name", ["planar", "ur5", "palletizer"])
def test_the_found_machine_keeps_the_changes(name, change, tmp_path):
    machine = planar() if name == "planar" else abbe.load(name)
    map = "ur5" if name == "ur5" else tracked(machine)
    rows = machine.simulate(map, samples=60, seed=1).table("rows")
    changed = CHANGES[change](machine)
    report = changed.identify(rows, map)
    assert report.report(tmp_path / "found") == ["report.html", "found.toml", "found.map.toml"]
    for found in (report.load(), abbe.load(tmp_path / "found" / "found.toml"), pickle.loads(pickle.dumps(report)).load()):
        assert found.sources[: len(changed.sources)] == changed.sources and len(found.sources) > len(changed.sources)
        assert (found.parameters, found.inputs) == (changed.parameters, changed.inputs)
        # Without what was found, it is the machine that was given.
        q = np.random.default_rng(2).uniform(*np.clip(np.array(machine.limits), -1, 1).T, (5, len(machine.variables))) + np.array(machine.home)
        given = found.disable(*found.sources[len(changed.sources) :])
        assert np.abs(given.predict(q) - changed.predict(q)).max() < 1e-12
    # What is found of a machine does not depend on how it was changed.
    again = abbe.load(text=changed.text).identify(rows, map)
    assert [parameter.value for parameter in again.parameters] == [parameter.value for parameter in report.parameters]


def test_inputs_that_are_changed(tmp_path):
    machine = planar()
    rows = machine.simulate(tracked(machine), samples=60, seed=1).table("rows")
    changed = machine.with_parameters(load="20 kg")
    assert changed.identify(rows, tracked(machine)).load().inputs == {"load": 20.0}


ARM = """
[manipulator]
name = "arm"
length = "mm"
[tables.warp]
file = "warp.csv"
x = { column = "q1", unit = "rad" }
y = { column = "error", unit = "mrad" }
interpolation = "linear"
[[frame]]
name = "turn"
variable = { name = "q1", kind = "revolute", limits = [-2.5, 2.5] }
dh = { theta = "q1", d = 0, a = 300, alpha = 0 }
[[source]]
name = "warp"
class = "repeatable"
joint = "q1"
error = "warp(q1)"
"""


def test_tables_in_files_go_with_the_machine(tmp_path, monkeypatch):
    (tmp_path / "specs").mkdir()
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "specs/warp.csv").write_text("q1,error\n-3,0\n0,0.1\n3,0.3\n", encoding="utf-8")
    (tmp_path / "specs/arm.toml").write_text(ARM, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    arm = abbe.load("specs/arm.toml")
    monkeypatch.chdir(tmp_path / "elsewhere")
    expected = arm.predict([1.0])
    assert np.array_equal(pickle.loads(pickle.dumps(arm)).predict([1.0]), expected)
    assert np.array_equal(abbe.load(text=arm.text).predict([1.0]), expected)
    more = arm.with_source({"name": "bent", "class": "repeatable", "frame": "turn", "e_z": 0.1})
    assert np.allclose(more.predict([1.0]) - expected, [0, 0, 0.1, 0, 0, 0])
    report = arm.identify(arm.simulate(tracked(arm), samples=30, seed=1).table("rows"), tracked(arm))
    report.report(tmp_path / "found")
    for found in (report.load(), abbe.load(tmp_path / "found/found.toml")):
        assert np.array_equal(found.disable(*found.sources[1:]).predict([1.0]), expected)


@pytest.mark.skipif(sys.version_info < (3, 11), reason="tomllib comes with Python 3.11")
def test_the_covariance_is_that_of_the_spec():
    import tomllib

    report = ur5.identify(ur5.simulate("ur5", samples=60, seed=1).table("rows"), "ur5")
    written = tomllib.loads(report.load().text)["covariance"]
    table = report.table("covariance")
    assert np.array_equal(report.covariance, written["rows"]) and "covariance" in report.tables()
    frames = {None: 0} | {name: number for number, name in enumerate(ur5.frames, 1)}
    names = [f"{one['error']}{frames[one.get('frame')]}" for one in written["of"]]
    assert table["error"] == names and list(table.columns) == ["error", *names]
    assert np.array_equal(pickle.loads(pickle.dumps(report)).covariance, report.covariance)
    # The part of the errors of frames, propagated to the tool.
    known = [name for name in names if name in ur5.columns]
    places = [names.index(name) for name in known]
    jacobian = ur5.error_jacobian(ur5.home)[:, [ur5.columns.index(name) for name in known]]
    assert np.linalg.eigvalsh(jacobian @ report.covariance[np.ix_(places, places)] @ jacobian.T).min() > -1e-12
    with pytest.raises(AttributeError, match="no field `covariance`"):
        ur5.measure(ur5.simulate("ur5", samples=20).table("rows"), "ur5").covariance


def test_errors_at_each_configuration(tmp_path):
    pps = abbe.load("pps")
    report = pps.disable("assembly").analyze()
    rows = report.table("configurations")
    machine = pps.disable("assembly")
    assert len(rows) == report.configurations == 999 and rows.columns[:2] == ("configuration", "d1")
    xyz = lambda what: np.stack([rows[f"{what} {axis}"] for axis in "xyz"], axis=-1)  # noqa: E731
    # The rows are configurations of the machine; the study varies the tool point, too.
    for place in (0, 500, 998):
        at = machine.with_parameters(**{name: rows[name][place] for name in ("x", "y", "z")})
        q = [rows[name][place] for name in machine.variables]
        assert np.abs(xyz("ideal")[place] - at.pose(q)[:3, 3]).max() < 1e-9
        assert np.abs(xyz("repeatable")[place] - at.predict(q)[:3]).max() < 1e-9
    for source in report.sources:
        assert np.linalg.norm(xyz(source.name), axis=1).max() == pytest.approx(source.plain_max.norm)
    q = np.random.default_rng(1).uniform(-1, 1, (7, 6))
    of_q = ur5.analyze(q=q).table("configurations")
    assert np.array_equal(ur5.pose(of_q), ur5.pose(q)) and np.array_equal(np.stack([of_q[name] for name in ur5.variables], axis=-1), q)
    restored = pickle.loads(pickle.dumps(report))
    assert restored.tables() == report.tables() and restored.table("configurations").to_dict() == rows.to_dict()
    part = pps.analyze(shard=(1, 1))
    assert "configurations" not in abbe.merge([part]).tables()


def test_candidates_are_rows_to_choose_from(tmp_path):
    q = np.random.default_rng(1).uniform(-2, 2, (60, 6))
    chosen = ur5.plan("ur5", count=20, candidates=q)
    rows = chosen.table("rows")
    joints = np.radians(np.stack([rows[name] for name in rows.columns[:6]], axis=-1))
    assert chosen.rows == 20 and all(np.abs(q - row).max(axis=1).min() < 1e-9 for row in joints)
    assert str(chosen).splitlines()[0] == str(ur5.plan("ur5", count=20, candidates=dict(zip(ur5.variables, q.T, strict=True)))).splitlines()[0]
    assert ur5.plan("ur5", candidates=q).rows == 50
    # Inputs are columns.
    machine = planar()
    map = tracked(machine, inputs={"load": {"column": "load", "unit": "kg"}})
    table = dict(zip(machine.variables, q.T, strict=False)) | {"load": np.repeat([0.0, 8.0], 30)}
    rows = machine.plan(map, count=10, candidates=table).table("rows")
    assert set(rows["load"]) <= {0.0, 8.0}
    for wrong in (np.zeros((0, 6)), np.zeros((3, 5)), np.zeros(6), q + np.nan, "q", {"q1": [1.0]}, ["a"]):
        with pytest.raises((TypeError, ValueError), match="`candidates`"):
            ur5.plan("ur5", candidates=wrong)
    with pytest.raises(ValueError, match="`sets` or rows of `candidates`"):
        ur5.plan("ur5", sets="plan.toml", candidates=q)
