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
