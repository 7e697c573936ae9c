"""Identification of a fleet, and bootstrap of one machine."""

from pathlib import Path

import numpy as np
import pytest

import abbe
import abbe.fleet

UR5 = (Path(__file__).parents[2] / "manipulators/specs/ur5.toml").read_text(encoding="utf-8")
ur5 = abbe.load("ur5")


def measured(folder, length, seed):
    """Simulate measurements of a UR5 with a longer upper arm. Return the file."""
    source = f"""
[[source]]
name = "upper arm"
class = "repeatable"
frame = "{ur5.frames[1]}"
dh = {{ a = "{length} mm" }}
"""
    abbe.load(text=UR5 + source).simulate("ur5", samples=60, seed=seed).report(folder)
    return folder / "measurements.csv"


@pytest.fixture(scope="module")
def fleet(tmp_path_factory):
    lengths = {"first": 0.2, "second": 0.5, "third": -0.3}
    files = {
        name: measured(tmp_path_factory.mktemp(name), length, seed)
        for seed, (name, length) in enumerate(lengths.items())
    }
    return lengths, files


def test_one_row_a_machine(fleet):
    lengths, files = fleet
    table = abbe.fleet.identify(ur5, files, "ur5")
    assert table["machine"] == list(lengths) and {len(column) for column in table.values()} == {3}
    # An error of `a` of the second frame is an error along its x axis.
    found, sd = np.array(table["e_x2"]), np.array(table["e_x2 sd"])
    assert (sd > 0).all() and (np.abs(found - list(lengths.values())) < 4 * sd).all()
    alone = ur5.identify(files["second"], "ur5")
    [parameter] = [parameter for parameter in alone.parameters if parameter.name == "e_x2"]
    assert parameter.value == table["e_x2"][1] and parameter.standard_deviation == table["e_x2 sd"][1]


def test_bootstrap(fleet):
    _, files = fleet
    table = abbe.fleet.bootstrap(ur5, files["first"], "ur5", repetitions=60)
    sd, drawn = np.array(table["sd"]), np.array(table["bootstrap sd"], dtype=float)
    # With 60 configurations and 60 repetitions, each standard deviation is uncertain by about 13 %.
    assert 0.6 < np.median(drawn / sd) < 1.6
    inside = [low <= value <= high for low, value, high in zip(table["2.5 %"], table["value"], table["97.5 %"], strict=True)]
    assert np.mean(inside) > 0.9
    again = [ur5.identify(files["first"], "ur5", resample=b).to_json() for b in (3, 3, 4)]
    assert again[0] == again[1] != again[2] and again[0] != ur5.identify(files["first"], "ur5").to_json()
    with pytest.raises(ValueError, match="from 2 on"):
        abbe.fleet.bootstrap(ur5, files["first"], "ur5", repetitions=1)


def without_errors(table):
    return {name: [value for value, error in zip(column, table["error"], strict=True) if error is None] for name, column in table.items() if name != "error"}


def test_a_bad_machine_is_a_row_with_its_message(fleet, tmp_path):
    _, files = fleet
    good = abbe.fleet.identify(ur5, files, "ur5")
    damaged = tmp_path / "damaged.csv"
    text = files["first"].read_text(encoding="utf-8")
    heading = next(line for line in text.splitlines() if not line.startswith("#"))
    column = heading.split(",")[2]
    damaged.write_text(text.replace(heading, heading.replace(column, "other")), encoding="utf-8")
    seen = []
    fleet_of = {"first": files["first"], "damaged": damaged, "second": files["second"], "missing": tmp_path / "no.csv", "third": files["third"]}
    table = abbe.fleet.identify(ur5, fleet_of, "ur5", progress=lambda *done: seen.append(done))
    assert table["machine"] == list(fleet_of) and seen[-1] == (5, 5)
    assert without_errors(table) == good
    assert f"`{column}`" in table["error"][1] and "no.csv" in table["error"][3]
    with pytest.raises(abbe.SpecError, match="there is no column"):
        abbe.fleet.identify(ur5, fleet_of, "ur5", on_error="raise")


def test_a_table_of_all_machines_gives_the_same(fleet):
    _, files = fleet
    pandas = pytest.importorskip("pandas")
    frames = [pandas.read_csv(file, comment="#").assign(machine=name) for name, file in files.items()]
    table = pandas.concat(frames).sample(frac=1, random_state=1).sort_values(["machine"], kind="stable")
    table = table.sort_index(kind="stable")
    expected = abbe.fleet.identify(ur5, files, "ur5")
    for workers in (1, 3):
        found = abbe.fleet.identify(ur5, table, "ur5", by="machine", workers=workers)
        assert sorted(found["machine"]) == sorted(expected["machine"])
        for name in expected["machine"]:
            here, there = found["machine"].index(name), expected["machine"].index(name)
            assert all(found[column][here] == expected[column][there] for column in expected), name
    with pytest.raises(ValueError, match="no column `serial`"):
        abbe.fleet.identify(ur5, table, "ur5", by="serial")
    with pytest.raises(TypeError, match="as `by`"):
        abbe.fleet.identify(ur5, files["first"], "ur5")


def test_what_is_done_is_not_done_again(tmp_path):
    calls = []

    def job(item):
        calls.append(item)
        if item == "bad":
            raise RuntimeError("no reading")
        return {"size": len(item)}

    items = {"a": "one", "b": "three", "c": "bad"}
    expected = {"machine": ["a", "b", "c"], "size": [3, 5, None], "error": [None, None, "no reading"]}
    assert abbe.fleet.map(job, items, resume=tmp_path / "rows", workers=1) == expected
    assert sorted(calls) == ["bad", "one", "three"]
    # Killed while it wrote a line.
    kept = tmp_path / "rows" / "rows.jsonl"
    lines = kept.read_text(encoding="utf-8").splitlines(keepends=True)
    cut = [line for line in lines if '"b"' in line][0]
    kept.write_text("".join(line for line in lines if line != cut) + cut[:-9], encoding="utf-8")
    calls.clear()
    assert abbe.fleet.map(job, items, resume=tmp_path / "rows", workers=2) == expected
    assert sorted(calls) == ["bad", "three"]
    # Other data of a machine.
    calls.clear()
    found = abbe.fleet.map(job, items | {"a": "eleven", "c": "good"}, resume=tmp_path / "rows")
    assert found == {"machine": ["a", "b", "c"], "size": [6, 5, 4]} and sorted(calls) == ["eleven", "good"]
    with pytest.raises(ValueError, match="engine='spark'"):
        abbe.fleet.map(job, items, engine="spark")


def test_serial_numbers_are_names():
    rows = {"serial": np.array([1000001, 1000002, 1000001]), "x": [1.0, 2.0, 3.0]}
    found = abbe.fleet.map(lambda data: {"sum": float(data["x"].sum())}, rows, by="serial")
    assert found == {"machine": ["1000001", "1000002"], "sum": [4.0, 2.0]}
    rows["serial"] = [1.0, None, 2.5]
    with pytest.raises(ValueError, match="`serial` is empty in 1 of 3 rows"):
        abbe.fleet.map(len, rows, by="serial")


@pytest.mark.parametrize("engine", ["ray", "dask"])
def test_engines_give_the_same(engine, fleet):
    pytest.importorskip(engine if engine == "ray" else "distributed")
    _, files = fleet
    assert abbe.fleet.identify(ur5, files, "ur5", engine=engine, workers=2) == abbe.fleet.identify(ur5, files, "ur5")


def test_nothing_is_lost_or_mixed_up(tmp_path):
    # Serial numbers beyond the digits of a float, rows that name themselves, and arrays that are kept.
    rows = {"serial": np.array([2**60, 2**60 + 1]), "x": [1.0, 2.0]}
    job = lambda data: {"machine": "mine", "x": data["x"], "at": Path("here")}  # noqa: E731
    first = abbe.fleet.map(job, rows, by="serial", resume=tmp_path)
    again = abbe.fleet.map(job, rows, by="serial", resume=tmp_path)
    assert first["machine"] == again["machine"] == [str(2**60), str(2**60 + 1)]
    assert again["x"] == [[1.0], [2.0]] and again["at"] == ["here", "here"]


def test_other_options_and_machines_are_computed_anew(fleet, tmp_path):
    _, files = fleet
    for machine, options in ((ur5, {}), (ur5, {"robust": "huber"}), (ur5.scale("base encoder", 0.5), {}), (ur5, {})):
        kept = abbe.fleet.identify(machine, files, "ur5", resume=tmp_path, **options)
        assert kept == abbe.fleet.identify(machine, files, "ur5", **options), options
