"""Import, export and doctor: the same results as the command, also for data in memory."""

import json
import os
import subprocess

import numpy as np
import pytest

import abbe

COMMAND = os.environ.get("ABBE")
ur5 = abbe.load("ur5")

CELL = """<robot name="cell">
  <link name="floor"/> <link name="carriage"/> <link name="arm"/> <link name="tool"/>
  <joint name="lift" type="prismatic">
    <parent link="floor"/> <child link="carriage"/> <axis xyz="0 0 1"/> <limit lower="0" upper="0.8" effort="1" velocity="1"/>
  </joint>
  <joint name="Shoulder" type="revolute">
    <parent link="carriage"/> <child link="arm"/> <origin rpy="0.3 0 -1.5708" xyz="0.1 0 0.4"/> <axis xyz="0 0.6 0.8"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/>
  </joint>
  <joint name="flange" type="fixed"> <parent link="arm"/> <child link="tool"/> <origin xyz="0.4 0 0"/> </joint>
</robot>
"""
FOUND = """
[[source]]
name = "found"
class = "repeatable"
frame = "Shoulder"
e_x = "0.7 mm"
e_p = "-0.4 mrad"
"""
# A shoulder with offset q1 + 30° about z, and an elbow q2 with a perpendicular axis.
DH = {"theta": ["q1 + 30", "q2"], "d": [0.0, 50.0], "a": [400.0, 300.0], "alpha": [90.0, 0.0]}


def printed(*arguments):
    return subprocess.run([COMMAND, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def planar(q1, q2):
    """Compute the tool point of DH by hand: Rz(q1 + 30°) Tx(400) Rx(90°) Rz(q2) Tz(50) Tx(300)."""
    t = q1 + np.pi / 6
    along, up = 400 + 300 * np.cos(q2), 300 * np.sin(q2)
    return [along * np.cos(t) + 50 * np.sin(t), along * np.sin(t) - 50 * np.cos(t), up]


def test_a_urdf_is_imported_from_a_file_and_from_text(tmp_path):
    file = tmp_path / "cell.urdf"
    file.write_text(CELL)
    report, told = abbe.import_urdf(file, tip="tool"), abbe.import_urdf(text=CELL)
    cell = report.load()
    assert cell.variables == ("lift", "shoulder") and report.largest_difference < 1e-12
    assert abbe.load(text=report.spec).text == cell.text and "cell: from floor to tool" in str(report)
    # Rodrigues' formula: the arm turns about (0, 0.6, 0.8) through its origin.
    roll, turn = np.cos(0.3), -1.5708
    rx = np.array([[1, 0, 0], [0, roll, -np.sin(0.3)], [0, np.sin(0.3), roll]])
    rz = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    axis = np.array([0, 0.6, 0.8])
    cross = np.array([[0, -0.8, 0.6], [0.8, 0, 0], [-0.6, 0, 0]])
    q = 0.9
    joint = np.cos(q) * np.eye(3) + np.sin(q) * cross + (1 - np.cos(q)) * np.outer(axis, axis)
    tool = np.array([0.1, 0, 0.4 + 0.25]) + rz @ rx @ joint @ [0.4, 0, 0]
    for machine in (cell, told.load()):
        assert np.allclose(machine.pose([0.25, q])[:3, 3], tool, atol=1e-12)
    assert report.report(tmp_path / "out") == ["cell.toml"] and (tmp_path / "out/cell.toml").read_text() == report.spec
    folded = abbe.import_urdf(file, fold=True).load()
    assert len(folded.frames) == 2 and len(cell.frames) == 3


@pytest.mark.skipif(not COMMAND, reason="the environment variable ABBE does not name the abbe command")
def test_the_same_as_the_command(tmp_path):
    file, table, rows = tmp_path / "cell.urdf", tmp_path / "arm.csv", tmp_path / "rows.csv"
    file.write_text(CELL)
    assert abbe.import_urdf(file).to_json() + "\n" == printed("import", file, "--json")
    table.write_text("theta,d,a,alpha\nq1 + 30,0,400,90\nq2,50,300,0\n")
    with pytest.warns(UserWarning, match="no limits"):
        imported = abbe.import_dh(table, convention="standard", units="mm,deg")
    assert imported.to_json() + "\n" == printed("import", table, "--dh", "standard", "--units", "mm,deg", "--json")
    with pytest.warns(UserWarning, match="no limits"):
        in_memory = abbe.import_dh(DH, convention="standard", units="mm,deg")
    assert in_memory.load().pose([0.1, 0.2]).tolist() == imported.load().pose([0.1, 0.2]).tolist()
    q = np.degrees(some_rows(10))
    heading = ",".join([*ur5.variables, "x", "y", "z"])
    np.savetxt(rows, np.hstack([q, ur5.pose(np.radians(q))[:, :3, 3]]), delimiter=",", header=heading, comments="")
    found = ur5.doctor(rows)
    assert found.to_json() + "\n" == printed("doctor", "ur5", rows, "--json") and printed("doctor", "ur5", rows).startswith(str(found))
    asked = ["export", "machine3", "--to", "linuxcnc", "--nodes", "5", "--set", "temperature_rise=3K", "--json"]
    exported = abbe.load("machine3").with_parameters(temperature_rise="3 K").export("linuxcnc", nodes=5)
    assert json.loads(printed(*asked)) == exported.to_dict() and len(exported.files) == 3


@pytest.mark.filterwarnings("ignore:the joint")
def test_a_table_of_denavit_hartenberg_numbers():
    tables = [DH, {name: np.array(cells) for name, cells in DH.items()}]
    for table in tables:
        arm = abbe.import_dh(table, convention="standard", units="mm,deg").load()
        for q in ([0.0, 0.0], [0.4, -1.1]):
            assert np.allclose(arm.pose(q)[:3, 3], planar(*q), atol=1e-9)
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    arm = abbe.import_dh(pandas.DataFrame(DH), convention="standard", units="mm,deg").load()
    assert np.allclose(arm.pose([0.4, -1.1])[:3, 3], planar(0.4, -1.1), atol=1e-9) and arm.length == "mm"
    # Without names every row is a revolute joint. Numbers survive the conversion to text and back.
    numbers = {"theta": [0.1, 0.2], "d": [0.1 + 0.2, 0.0], "a": [1 / 3, 0.25], "alpha": [0.0, 0.0]}
    arm = abbe.import_dh(numbers, convention="modified", units="m,rad").load()
    assert arm.pose([0, 0])[2, 3] == 0.1 + 0.2 and arm.length == "m"


def some_rows(count):
    return np.random.default_rng(5).uniform(-2, 2, (count, 6))


def as_quaternion(rotation):
    w = np.sqrt(1 + np.trace(rotation)) / 2
    return np.array([w, *(np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]]) / (4 * w))])


def test_the_doctor_reads_arrays_and_tables(tmp_path):
    q = some_rows(14)
    pose = ur5.pose(q)
    q, pose = q[np.trace(pose[:, :3, :3], axis1=1, axis2=2) > -0.9], pose[np.trace(pose[:, :3, :3], axis1=1, axis2=2) > -0.9]
    report = ur5.doctor(np.degrees(q), pose)
    [first, *others] = report.found
    assert report.fits and not others and first.interpretation.joints_in_degrees is True and first.interpretation.layout.homogeneous.by_rows is True
    assert ur5.doctor(q, pose.swapaxes(1, 2)).found[0].interpretation.layout.homogeneous.by_rows is False
    # Metres, the second joint with the opposite sign, a scalar-first quaternion.
    turned = q * [1, -1, 1, 1, 1, 1]
    four = np.array([as_quaternion(each[:3, :3]) for each in pose])
    seen = np.hstack([pose[:, :3, 3] / 1000, four])
    report = ur5.doctor(turned, seen)
    first = report.found[0].interpretation
    assert first.lengths_in == "m" and first.layout.quaternion.scalar_first is True and [change.reversed for change in first.changes] == [[1]]
    # The written map reads the same rows.
    table = dict(zip(ur5.variables, turned.T)) | {f"seen_{k + 1}": column for k, column in enumerate(seen.T)}
    assert ur5.doctor(table).map == report.map and "sign = -1" in report.map
    assert report.report(tmp_path) == ["doctor.map.toml"]
    assert ur5.measure(table, tmp_path / "doctor.map.toml").errors[3].rms < 1e-6
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    assert ur5.doctor(pandas.DataFrame(table)).to_json() == ur5.doctor(table).to_json()


PALLETIZER = """
[manipulator]
name = "palletizer"
length = "mm"
[[frame]]
name = "column"
variable = { name = "q1", kind = "revolute", limits = [-3, 3] }
dh = { theta = "q1", d = 650, a = 200, alpha = "90 deg" }
[[frame]]
name = "upper arm"
variable = { name = "q2", kind = "revolute", limits = [-0.4, 2] }
dh = { theta = "q2", d = 0, a = 900, alpha = 0 }
[[frame]]
name = "forearm"
variable = { name = "q3", kind = "revolute", limits = [-2.6, 0.5] }
dh = { theta = "q3", d = 0, a = 850, alpha = 0 }
[tool]
transform = "Ty(-180)"
"""


def test_the_doctor_corrects_a_spec(tmp_path):
    arm = abbe.load(text=PALLETIZER)
    q = np.random.default_rng(4).uniform([-2.6, 0.7, -2.2], [2.6, 1.9, -0.4], (10, 3))
    # The third column is the angle of the forearm to the horizontal.
    shown = q + q[:, [1]] * [0, 0, 1]
    report = arm.doctor(shown, arm.pose(q)[:, :3, 3])
    assert report.of_spec == ["q3 is coupled: it means q3 − q2"]
    assert np.abs(report.load().pose(shown) - arm.pose(q)).max() < 1e-9
    assert report.report(tmp_path) == ["doctor.map.toml", "doctor.spec.toml"]
    # No corrected spec if the map describes everything.
    with pytest.raises(ValueError, match="a report of doctor has no spec"):
        arm.doctor(q, arm.pose(q)[:, :3, 3]).load()


def test_the_doctor_says_that_none_fits(tmp_path):
    q = some_rows(10)
    report = abbe.load("puma560").doctor(q, ur5.pose(q))
    assert not report.fits and report.map is None and report.found == [] and report.report(tmp_path) == []


def test_what_is_exported(tmp_path):
    found = abbe.load(text=ur5.text + FOUND.replace("Shoulder", ur5.frames[1]))
    axes = abbe.load("machine3").with_parameters(temperature_rise="3 K")
    exports = [(found, "dh", 1), (found, "ur-calibration", 1), (axes, "table", 1), (axes, "isg-csv", 1), (axes, "linuxcnc", 3)]
    for machine, to, files in exports:
        report = machine.export(to)
        assert len(report.files) == files and sorted(report.report(tmp_path / to)) == sorted(os.listdir(tmp_path / to))
        assert all((tmp_path / to / file.name).read_text() == file.text for file in report.files)
        assert report.remains.position.largest < report.before.position.largest and "\nSign      " in report.full()
    cell = tmp_path / "cell.urdf"
    cell.write_text(CELL)
    nominal = abbe.import_urdf(cell, tip="tool").load()
    found = abbe.load(text=nominal.text + FOUND)
    report = found.export("urdf", urdf=cell, tip="tool")
    calibrated = abbe.import_urdf(text=report.files[0].text, tip="tool").load()
    # Without a file of the robot, from the frames alone.
    frames = abbe.import_urdf(text=found.export("urdf").files[0].text).load()
    q = np.random.default_rng(2).uniform([0, -2], [0.8, 2], (50, 2))
    assert np.abs(frames.pose(q) - found.real_pose(q)).max() < 1e-9
    assert np.abs(calibrated.pose(q) - found.real_pose(q)).max() < 1e-9 < 1e-4 < np.abs(nominal.pose(q) - found.real_pose(q)).max()


def test_a_spec_that_was_found_is_loaded():
    # With the identified sources it predicts the measurements.
    real = abbe.load(text=ur5.text + FOUND.replace("Shoulder", ur5.frames[1]))
    rows = real.simulate("ur5", samples=60, seed=1).table("rows").to_dict()
    found = ur5.identify(rows, "ur5").load()
    assert found.variables == ur5.variables and len(found.sources) > len(ur5.sources)
    with pytest.raises(ValueError, match="no pages"):
        ur5.check().load()
    with pytest.raises(ValueError, match="a report of simulate has no spec"):
        real.simulate("ur5", samples=3).load()


@pytest.mark.filterwarnings("ignore:this spec has no repeatable source")
def test_mistakes(tmp_path):
    q = some_rows(10)
    for call in [
        lambda: abbe.import_urdf(tmp_path / "nowhere.urdf"),
        lambda: abbe.import_urdf(text="<robot"),
        lambda: abbe.import_urdf(text=CELL, tip="nowhere"),
        lambda: abbe.import_dh(text="theta,d,a,alpha\n0,0,0,much\n", convention="standard"),
        lambda: abbe.import_dh({"theta": [0.0]}, convention="standard"),
        lambda: abbe.import_dh({}, convention="standard"),
        lambda: ur5.doctor(tmp_path / "nowhere.csv"),
        lambda: ur5.doctor(q[:2], ur5.pose(q[:2])),
        lambda: ur5.doctor(q, np.zeros((10, 5))),
        lambda: ur5.doctor({"q1": q[:, 0]}),
        lambda: ur5.export("urdf", urdf=tmp_path / "nowhere.urdf"),
        lambda: ur5.export("isg-csv"),
        lambda: abbe.load("puma560").export("urdf"),
    ]:
        with pytest.raises(abbe.SpecError) as caught:
            call()
        assert caught.value.file and "error: " in str(caught.value)
    for call in [
        lambda: abbe.import_urdf(),
        lambda: abbe.import_urdf("a.urdf", text=CELL),
        lambda: abbe.import_dh(convention="standard"),
        lambda: abbe.import_dh(DH, convention="classic"),
        lambda: abbe.import_dh(DH, convention="standard", units="furlong"),
        lambda: abbe.import_dh(3, convention="standard"),
        lambda: abbe.import_dh({"theta": [0.0, 1.0], "d": [0.0]}, convention="standard"),
        lambda: ur5.doctor(q),
        lambda: ur5.doctor(q[:, :5], ur5.pose(q)),
        lambda: ur5.doctor(q, ur5.pose(q)[:9]),
        lambda: ur5.doctor(q, q[0]),
        lambda: ur5.doctor(q, ur5.pose(q), within=-1),
        lambda: ur5.doctor(q, ur5.pose(q), within="3 kg"),
        lambda: ur5.export("step"),
        lambda: ur5.export("dh", urdf="robot.urdf"),
        lambda: ur5.export("dh", nodes=7),
        lambda: ur5.export("table", nodes=1),
        lambda: ur5.export("dh", samples=0),
    ]:
        with pytest.raises((TypeError, ValueError)):
            call()
