"""Fields of reports: their types, configurations as arguments, copies and pickles, and words."""

import copy
import json
import pickle
import re
import signal
import time
import typing
from collections.abc import Mapping

import numpy as np
import pytest

import abbe
from abbe import _fields, reports

pps, ur5 = abbe.load("pps"), abbe.load("ur5")
DATA = ur5.simulate("ur5", samples=40, seed=2)
ANALYSIS = pps.analyze()


# An option of the command.
FLAG = re.compile(r"(?<![\w-])--[a-z]")


def rows():
    return DATA.table("rows").to_dict()


def all_reports():
    yield ANALYSIS
    yield pps.bound(boxes=50)
    yield pps.allocate()
    yield ur5.check()
    yield DATA
    yield ur5.measure(rows(), "ur5")
    yield ur5.identify(rows(), "ur5", folds=3, robust="tukey")
    yield ur5.plan("ur5", count=12, candidates=40)
    yield ur5.monitor([rows(), rows()], "ur5")
    yield abbe.load("machine3").with_parameters(temperature_rise="3 K").export("table", nodes=3, samples=20)
    yield abbe.import_dh({"theta": ["q1"], "d": [0], "a": [1], "alpha": [0], "lower": [-9], "upper": [9]}, convention="standard", units="mm,deg")
    yield abbe.positioning({"position (mm)": [0, 100], "1+ (um)": [1.0, 4.0], "1- (um)": [0.0, 2.0]}, reading_uncertainty="0.1 um")
    q = np.random.default_rng(1).uniform(-1, 1, (20, 6))
    yield ur5.doctor(q, ur5.pose(q)[:, :3, 3])


ALL = list(all_reports())


def fits(value, hint, path):
    """Assert that a value has the type of a hint."""
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if isinstance(hint, type) and issubclass(hint, _fields.Fields):
        assert type(value) is hint, path
        return fields(value, path)
    if origin is _fields.Named:
        assert type(value) is _fields.Named, path
        return [fits(each, arguments[0], f"{path}.{name}") for name, each in value.items()]
    if origin is list:
        assert isinstance(value, list), path
        return [fits(each, arguments[0], f"{path}[]") for each in value]
    if origin is typing.Literal:
        assert value in arguments, path
    elif arguments:
        for one in arguments:
            try:
                return fits(value, one, path)
            except AssertionError:
                pass
        raise AssertionError(f"{path} is {value!r}, not {hint}")
    else:
        # Infinite numbers are None.
        assert isinstance(value, (int, float, type(None)) if hint is float else hint), f"{path} is {value!r}, not {hint}"


def fields(group, path):
    hints = typing.get_type_hints(type(group))
    for name, hint in hints.items():
        fits(getattr(group, name), hint, f"{path}.{name}")


@pytest.mark.parametrize("report", ALL, ids=lambda report: type(report).__name__)
def test_fields_have_the_types_of_abbe_reports(report):
    assert type(report).__module__ == "abbe.reports" and isinstance(report, abbe.Report)
    fields(report, type(report).__name__)
    assert set(typing.get_type_hints(type(report))) <= {*dir(report), *(name for name in typing.get_type_hints(type(report)) if getattr(report, name) is None)}


def test_every_report_has_a_class():
    classes = {name for name, each in vars(reports).items() if isinstance(each, type) and issubclass(each, abbe.Report)} - {"Report"}
    assert classes == {type(report).__name__ for report in ALL}


def test_fields_that_do_not_apply_are_none():
    report = ur5.analyze(study_text='[study]\ntitle = "few"\n[workspace.joints]\nsamples = 5\n')
    assert report.tolerance is None and report.verdict is None
    assert report.ledger.sums[0].share_of_tolerance is None
    with pytest.raises(AttributeError, match="no field `nothing`"):
        report.nothing


def test_files_are_not_changed():
    text = ROBOT.replace("<robot", "<!--dh--><robot").replace('name="Elbow"', 'name="elbow --tip"')
    report = abbe.import_urdf(text=text)
    assert report.spec == report.to_dict()["spec"] and "elbow --tip" in report.spec


def test_messages_do_not_hide_the_notes_of_a_report():
    assert ur5.check().notes == ur5.check().to_dict()["notes"]
    assert isinstance(ur5.check().messages, list)


def test_configurations_are_arguments():
    worst = ANALYSIS.combined.worst
    assert isinstance(worst, Mapping) and dict(worst) == ANALYSIS.to_dict()["combined"]["worst"] and list(worst) == list(dict(worst))
    q = [worst[name] for name in pps.variables]
    assert np.array_equal(pps.pose(worst), pps.pose(q)) and np.array_equal(pps.predict(worst), pps.predict(q))
    assert worst.q4 == worst["q4"] and "q4" in worst and len(worst) == len(q) + len(pps.inputs)
    for copied in (copy.deepcopy(worst), copy.copy(worst), pickle.loads(pickle.dumps(worst))):
        assert copied == worst and type(copied) is type(worst)
    assert copy.deepcopy(ANALYSIS.combined) == ANALYSIS.combined


@pytest.mark.parametrize("report", ALL, ids=lambda report: type(report).__name__)
def test_reports_are_pickled(report, tmp_path):
    restored = pickle.loads(pickle.dumps(report))
    assert type(restored) is type(report) and restored.to_json() == report.to_json()
    assert str(restored) == str(report) and restored.full() == report.full() and restored._repr_html_() == report._repr_html_()
    assert restored.messages == report.messages and restored.tables() == report.tables() and restored.figures() == report.figures()
    for name in report.tables():
        assert restored.table(name).to_dict() == report.table(name).to_dict()
        assert pickle.loads(pickle.dumps(report.table(name))).to_dict() == report.table(name).to_dict()
    try:
        report.report(tmp_path / "one")
    except ValueError as error:
        with pytest.raises(ValueError, match=str(error)):
            restored.report(tmp_path / "two")
    else:
        names = restored.report(tmp_path / "two")
        assert all((tmp_path / "one" / name).read_text() == (tmp_path / "two" / name).read_text() for name in names)


def test_commands_are_pickled():
    commands = pps.compensate(np.tile(pps.home, (2, 1)))
    restored = pickle.loads(pickle.dumps(commands))
    assert np.array_equal(restored.q, commands.q) and np.array_equal(restored.left, commands.left) and restored.reason == commands.reason


def texts(value):
    if isinstance(value, str):
        yield value
    elif isinstance(value, _fields.Fields):
        for each in value.values() if not isinstance(value, reports.Chart) else dict(value).values():
            yield from texts(each)
    elif isinstance(value, list):
        for each in value:
            yield from texts(each)


@pytest.mark.parametrize("report", ALL, ids=lambda report: type(report).__name__)
def test_words_are_those_of_python(report):
    shown = [str(report), report.full(), report._repr_html_(), *report.messages]
    for name in typing.get_type_hints(type(report)):
        shown += texts(getattr(report, name))
    assert not [text for text in shown if FLAG.search(text)]
    assert 2 <= len(str(report).splitlines()) <= 45 and report._repr_html_().startswith("<div><strong>")


ROBOT = '''<robot name="arm"><link name="base"/><link name="hand"/><joint name="Elbow" type="revolute"><parent link="base"/>
<child link="hand"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>'''

ERRORS = [
    (lambda: ur5.identify({**rows(), "x_t": ["x"] * 40}, "ur5"), "x_t"),
    (lambda: ur5.measure(rows(), "[joints]\n"), "--> map"),
    (lambda: ur5.measure(rows(), "no such map"), "--> map"),
    (lambda: ur5.plan("ur5", count=12, candidates=3), "candidates"),
    (lambda: ur5.plan("ur5", sets="nothing"), "--> sets"),
    (lambda: pps.with_parameters(nothing="2 mm"), "--> with_parameters"),
    (lambda: pps.disable("nothing"), "--> disable"),
    (lambda: abbe.load("pp"), "pps"),
    (lambda: abbe.load(text='<robot name="r"/>'), "import_urdf"),
    (lambda: abbe.import_urdf(text=ROBOT, tip="b"), "`tip`: there is no link"),
    (lambda: abbe.import_dh(text="theta,d,a,alpha\nq1,1,0,0\n", convention="standard"), "units="),
    (lambda: pps.export("dh"), "to="),
    (lambda: abbe.merge([pps.analyze(shard=(1, 2))]), "shard=(2, 2)"),
]


@pytest.mark.parametrize(("call", "says"), ERRORS, ids=[says for _, says in ERRORS])
def test_errors_speak_python(call, says):
    with pytest.raises(ValueError) as caught:
        call()
    text = str(caught.value) + str(getattr(caught.value, "file", "")) + str(getattr(caught.value, "help", ""))
    assert says in text and not FLAG.search(text), text


def test_inverse_refuses_what_is_no_pose():
    pose = ur5.pose([0.3, -1.2, 1.1, 0.4, 0.8, 0.1])
    with pytest.raises(ValueError, match="transposed"):
        ur5.inverse(pose.T)
    mirrored = pose.copy()
    mirrored[:3, 0] *= -1
    scaled = pose.copy()
    scaled[:3, :3] *= 1.001
    for wrong in (mirrored, scaled):
        with pytest.raises(ValueError, match="rotation matrix"):
            ur5.inverse(wrong)
    assert np.allclose(ur5.pose(ur5.inverse(pose, [0.2, -1.1, 1, 0.3, 0.7, 0])), pose, atol=1e-6)


def test_columns_of_inputs_are_used():
    machine = abbe.load("machine3")
    [name, *_] = machine.inputs
    q = {variable: np.full(3, value) for variable, value in zip(machine.variables, machine.home)}
    values = machine.inputs[name] + np.arange(3.0)
    assert np.array_equal(machine.predict({**q, name: values}), machine.predict(q, **{name: values}))
    assert not np.array_equal(machine.predict({**q, name: values}), machine.predict(q))
    assert np.array_equal(machine.predict({**q, name: values}, **{name: values[0]}), machine.predict(q, **{name: values[0]}))


def test_warnings_name_the_line_of_the_caller():
    with pytest.warns(UserWarning, match="boxes and time") as caught:
        pps.bound(boxes=50)
    assert all(warning.filename == __file__ for warning in caught)


def test_maps_are_dicts_or_texts(tmp_path):
    text = (
        '[data]\nuncertainty = "0.1 mm"\n[joints]\n'
        + "".join(f'{name} = {{ column = "{name}", unit = "rad" }}\n' for name in ur5.variables)
        + '[point]\ncolumns = ["x", "y", "z"]\nunit = "mm"\n'
    )
    named = {
        "data": {"uncertainty": "0.1 mm"},
        "joints": {name: {"column": name, "unit": "rad"} for name in ur5.variables},
        "point": {"columns": ["x", "y", "z"], "unit": "mm"},
    }
    (tmp_path / "map.toml").write_text(text)
    seen = {name: ur5.simulate(each, samples=5, seed=3).to_json() for name, each in [("file", tmp_path / "map.toml"), ("text", text), ("dict", named)]}
    assert seen["file"] == seen["text"] == seen["dict"]
    with pytest.raises(abbe.SpecError, match="unit"):
        ur5.simulate({**named, "point": {"columns": ["x", "y", "z"], "unit": "mn"}})
    with pytest.raises(TypeError, match="texts, numbers, lists and dicts"):
        ur5.simulate({"data": None})


def test_generated_files_are_whole(tmp_path):
    files = abbe.load("scara").generate_files("c")
    assert list(files) == ["scara.h", "scara.c"] and "".join(files.values()) == abbe.load("scara").generate("c")


def test_displacement_takes_generalized_errors():
    for q in (pps.home, np.tile(pps.home, (3, 1))):
        errors = pps.generalized_errors(q)
        assert np.allclose(pps.displacement(q, errors), pps.predict(q))
        assert np.array_equal(pps.displacement(q, errors), pps.displacement(q, errors.reshape(*errors.shape[:-2], -1)))


def test_units_of_parameters():
    for machine in (pps, abbe.load("machine3")):
        assert set(machine.units) == {*machine.parameters, *machine.inputs}
    assert pps.units["x"] == "mm"


def test_standard_deviations_are_not_a_covariance():
    sigma = np.full(36, 0.1)
    with pytest.raises(ValueError, match="error_jacobian"):
        ur5.covariance(ur5.home, np.diag(sigma**2))
    with pytest.raises(ValueError, match="negative"):
        ur5.covariance(ur5.home, -sigma)
    assert ur5.covariance(np.tile(ur5.home, (36, 1)), np.tile(sigma, (36, 1)) * np.arange(1, 37)[:, None]).shape == (36, 6, 6)


def test_missing_files_are_file_not_found(tmp_path):
    with pytest.raises(FileNotFoundError) as caught:
        abbe.load(tmp_path / "nothing.toml")
    assert isinstance(caught.value, abbe.SpecError) and caught.value.file == str(tmp_path / "nothing.toml")
    with pytest.raises(FileNotFoundError):
        ur5.measure(tmp_path / "nothing.csv", "ur5")
    with pytest.raises(FileNotFoundError):
        ur5.measure(rows(), tmp_path / "nothing.toml")
    part = pps.analyze(shard=(1, 2), figures=False)
    part.save(tmp_path / "1.part")
    with pytest.raises(FileExistsError):
        part.save(tmp_path / "1.part")
    part.save(tmp_path / "1.part", overwrite=True)
    with pytest.raises(ValueError):
        abbe.load(text="nothing")


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="this platform has no timer signals")
def test_signals_end_an_evaluation():
    q = np.tile(ur5.home, (1_500_000, 1))
    out = np.empty((len(q), 6, 6))
    begin = time.perf_counter()
    ur5.joint_jacobian(q, out=out)
    whole = time.perf_counter() - begin

    def stop(*_):
        raise InterruptedError("stopped")

    before = signal.signal(signal.SIGALRM, stop)
    try:
        begin = time.perf_counter()
        signal.setitimer(signal.ITIMER_REAL, whole / 10)
        with pytest.raises(InterruptedError):
            ur5.joint_jacobian(q, out=out)
        assert time.perf_counter() - begin < 0.7 * whole
    finally:
        signal.signal(signal.SIGALRM, before)


def test_text_has_the_changes():
    for name in abbe.shipped():
        machine = abbe.load(name)
        changed = machine.with_parameters(**{one: 1.25 * value + 0.5 for one, value in machine.parameters.items()})
        changed = changed.disable(*machine.sources[:2])
        restored = abbe.load(text=changed.text)
        assert restored.parameters == changed.parameters and restored.sources == changed.sources != machine.sources, name
        assert restored.enable(*machine.sources[:2]).sources == machine.sources and machine.text == abbe.load(name).text
    warm = abbe.load("machine3").with_parameters(temperature_rise="3 K", tool_length="0.2 m")
    restored = abbe.load(text=warm.text)
    assert restored.inputs == warm.inputs == {"temperature_rise": 3.0} and restored.parameters["tool_length"] == 200
    assert np.array_equal(restored.predict(restored.home), warm.predict(warm.home))


def test_errors_name_values():
    machine = abbe.load("machine3")
    for call, says in [
        (lambda: ur5.pose(np.where(np.arange(6) == 2, np.nan, ur5.home)), "joint variable `q3` is not a finite number"),
        (lambda: machine.predict(machine.home, temperature_rise=1e9), "input `temperature_rise` is 1000000000, outside its range -15 … 15"),
        (lambda: ur5.displacement(ur5.home, np.where(np.arange(36) == 9, np.inf, 0)), "generalized error `e_s2` is not a finite number"),
    ]:
        with pytest.raises(ValueError, match=re.escape(says)):
            call()


def test_json_is_that_of_the_fields():
    assert json.loads(ANALYSIS.to_json())["combined"]["radius"] == ANALYSIS.combined.radius


def test_joints_named_like_methods() -> None:
    names = ["keys", "items", "values", "get", "update"]
    frames = "".join(
        f'[[frame]]\nname = "f{i}"\nvariable = {{ name = "{name}", kind = "revolute", limits = [-1, 1] }}\n'
        f'transform = "Rz({name}) Tx(1)"\n[[source]]\nname = "s{i}"\nclass = "repeatable"\njoint = "{name}"\nerror = "1 mrad"\n'
        for i, name in enumerate(names)
    )
    machine = abbe.load(text=f'[manipulator]\nname = "arm"\nlength = "m"\n{frames}')
    report = machine.analyze()
    worst = report.combined.worst
    assert list(worst) == names and len(dict(worst)) == len(names)
    assert machine.pose(worst).shape == (4, 4)
    assert all(dict(worst)[name] == worst[name] for name in names)
