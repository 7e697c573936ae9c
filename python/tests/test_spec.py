"""Specs, studies and sources from objects."""

import numpy as np
import pytest

import abbe
from abbe.spec import DH, Frame, Loop, Manipulator, Origin, Parameter, Source, Tool, Variable


def planar():
    first = Variable(name="q1", kind="revolute", limits=["-150 deg", "150 deg"], home="20 deg")
    second = Variable(name="q2", kind="revolute", limits=np.array([-2.5, 2.5]))
    return Manipulator(
        name="planar",
        length="mm",
        title="Two links",
        parameters={"upper": "400 mm", "reach": Parameter(value="0.25 m", description="of the probe")},
        frames=[
            Frame(name="upper arm", variable=first, dh=DH(theta="q1", d=0, a="upper", alpha=0)),
            Frame(name="lower arm", variable=second, dh=DH(theta="q2", d=0, a=300, alpha=0)),
        ],
        tool=Tool(transform="Tx(reach)"),
        sources=[Source(name="bent", class_="repeatable", frame="lower arm", e_z="-0.1 mm")],
    )


def test_a_machine_from_objects_is_that_of_its_text():
    spec = planar()
    machine = spec.load()
    assert (machine.name, machine.title, machine.variables, machine.sources) == ("planar", "Two links", ("q1", "q2"), ("bent",))
    assert machine.parameters == {"upper": 400.0, "reach": 250.0}
    text = spec.to_toml()
    assert "[[frame]]\nname = \"upper arm\"" in text and "[manipulator]\nname = \"planar\"" in text
    assert "class = \"repeatable\"" in text and "class_" not in text and "frames" not in text
    again = abbe.load(text=text)
    q = [[0.3, -0.4], [1.0, 2.0]]
    for other in (again, abbe.load(spec)):
        assert np.array_equal(machine.pose(q), other.pose(q)) and np.array_equal(machine.error_jacobian(q), other.error_jacobian(q))
    x = 400 * np.cos(0.3) + (300 + 250) * np.cos(-0.1)
    assert machine.pose(q[0])[0, 3] == pytest.approx(x)


def test_loops_and_origins():
    spec = Manipulator(
        name="linkage",
        length="m",
        frames=[
            Frame(name="crank", variable=Variable(name="q1", kind="revolute", home=1.0), transform="Rz(q1) Tx(0.04)"),
            Frame(name="coupler", variable=Variable(name="p1", kind="revolute", passive=True, home=-0.7), transform="Rz(p1) Tx(0.12)"),
            Frame(name="post", parent="base", origin=Origin(xyz=[0.1, 0, 0])),
            Frame(name="rocker", parent="post", variable=Variable(name="p2", kind="revolute", passive=True, home=1.1), transform="Rz(p2) Tx(0.08)"),
        ],
        loops=[Loop(name="knee", frames=["coupler", "rocker"], closes=["x", "y"])],
        tool=Tool(frame="coupler", transform="Ty(0.03)"),
    )
    assert spec.load().pose([1.0]).shape == (4, 4)


def test_mistakes_have_their_place_and_remedy():
    spec = planar()
    spec.frames[1].dh.theta = "q3"
    with pytest.raises(abbe.SpecError) as mistake:
        spec.load()
    line = spec.to_toml().splitlines()[mistake.value.line - 1]
    assert "q3" in str(mistake.value) and "q3" in line
    with pytest.raises(TypeError, match="legs"):
        Manipulator(name="a", length="mm", frames=[], legs=[])
    with pytest.raises(abbe.SpecError, match="class"):
        planar().load().with_source(Source(name="a", class_="systematic", frame="upper arm", e_x=0.1))


def test_one_more_source():
    machine = planar().load().with_parameters(upper=500).disable("bent")
    more = machine.with_source(Source(name="encoder", class_="random", distribution="normal", joint="q1", error="20e-6"))
    assert machine.sources == () and more.sources == ("encoder",) and more.parameters["upper"] == 500
    again = machine.with_source({"name": "encoder", "class": "random", "distribution": "normal", "joint": "q1", "error": "20e-6"})
    assert again.text == more.text


def test_a_study_as_a_dict_and_configurations_as_an_array():
    machine = planar().load()
    study = {"study": {"title": "Everywhere", "tolerance": "0.3 mm"}, "workspace": {"random": {"samples": 50, "seed": 1}}}
    report = machine.analyze(study)
    text = '[study]\ntitle = "Everywhere"\ntolerance = "0.3 mm"\n[workspace.random]\nsamples = 50\nseed = 1\n'
    assert report.to_json() == machine.analyze(study_text=text).to_json()
    q = np.random.default_rng(1).uniform(-2, 2, (30, 2))
    report = machine.analyze(q=q, tolerance="1 mm")
    assert report.configurations == 30
    largest = np.linalg.norm(machine.predict(q)[:, :3], axis=1).max()
    assert np.linalg.norm(report.combined.repeatable) == pytest.approx(largest)
    table = machine.analyze(q={"q1": q[:, 0], "q2": q[:, 1]}, tolerance="1 mm")
    assert table.to_json() == report.to_json()
    assert machine.analyze(q=q[0]).configurations == 1
    for wrong in (np.zeros((0, 2)), np.zeros((3, 3)), [[0.0, np.nan]], np.zeros((2, 2, 2))):
        with pytest.raises(ValueError, match="`q`"):
            machine.analyze(q=wrong)
    with pytest.raises(ValueError, match="give one of them"):
        machine.analyze(q=q, shard=(1, 2))


def test_tables_of_reports_are_tables():
    ur5 = abbe.load("ur5")
    rows = ur5.simulate("ur5", samples=40, seed=1).table("rows")
    name = rows.columns[0]
    assert rows[name].dtype == np.float64 and len(rows[name]) == 40
    with pytest.raises(KeyError, match="no such"):
        rows["no such"]
    assert ur5.identify(rows, "ur5").parameters
