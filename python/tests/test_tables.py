"""Tables: exported by reports to Arrow readers, and passed by users instead of CSV files."""

import csv
import gc
import importlib.util

import numpy as np
import pytest

import abbe

pps, ur5 = abbe.load("pps"), abbe.load("ur5")
REPORT = pps.analyze(figures=False)


def reader(name):
    return pytest.importorskip(name, reason=f"{name} is not installed")


def by_pandas(table):
    frame = reader("pandas").DataFrame
    # Before pandas 3, pyarrow reads the table.
    read = frame.from_arrow(table) if hasattr(frame, "from_arrow") else reader("pyarrow").table(table).to_pandas()
    return {name: [None if cell != cell else cell for cell in column] for name, column in read.to_dict("list").items()}


def by_duckdb(rows):
    found = reader("duckdb").sql("select * from rows")
    return dict(zip(found.columns, map(list, zip(*found.fetchall(), strict=True)), strict=True))


READERS = {
    "pandas": by_pandas,
    "polars": lambda table: reader("polars").DataFrame(table).to_dict(as_series=False),
    "pyarrow": lambda table: reader("pyarrow").table(table).to_pydict(),
    "duckdb": by_duckdb,
}


def test_some_reader_is_here():
    assert any(importlib.util.find_spec(name) for name in READERS)


@pytest.mark.parametrize("name", READERS)
@pytest.mark.parametrize("table", ["ledger.sources", "ledger.sums", "orientation.sources", "published"])
def test_readers(name, table):
    table = REPORT.table(table)
    read = READERS[name](table)
    expected = table.to_dict()
    assert list(read) == list(table.columns) == list(expected)
    assert all(list(read[column]) == expected[column] for column in expected)


def test_tables_are_the_fields():
    ledger = REPORT.table("ledger.sources").to_dict()
    assert ledger["name"] == [source.name for source in REPORT.ledger.sources]
    assert ledger["max"] == [source.max for source in REPORT.ledger.sources]
    sources = REPORT.table("sources").to_dict()
    assert sources["plain_max.norm"] == [source.plain_max.norm for source in REPORT.sources]
    assert sources["orientation"] == [source.orientation for source in REPORT.sources]
    assert set(REPORT.tables()) >= {"sources", "ledger.sources", "orientation.sources", "uncertainty.sources"}
    for name in REPORT.tables():
        assert len(REPORT.table(name)) > 0 and REPORT.table(name).columns
    assert len(REPORT.table("unreachable_reasons")) == 0
    with pytest.raises(ValueError, match="there is no table `nothing`; tables: sources, "):
        REPORT.table("nothing")
    assert "assembly" in REPORT.table("ledger.sources")._repr_html_()
    assert repr(REPORT.table("ledger.sums")).startswith("<abbe table of 4 rows")


def test_nothing_is_copied():
    arrow, polars = reader("pyarrow"), reader("polars")
    table = ur5.simulate("ur5", samples=1000).table("rows")
    first, second = arrow.table(table), arrow.table(table)
    address = [one["x_t"].chunk(0).buffers()[1].address for one in (first, second)]
    assert address[0] == address[1] == polars.DataFrame(table)["x_t"].to_arrow().buffers()[1].address
    # The table outlives the report.
    expected = table.to_dict()["x_t"]
    del table
    gc.collect()
    assert first["x_t"].to_pylist() == expected


def test_a_stream_may_be_left_unread():
    for _ in range(1000):
        table = REPORT.table("sources")
        table.__arrow_c_stream__(), table.__arrow_c_schema__(), table.__arrow_c_stream__(None)


MEASURED = ur5.simulate("ur5", samples=60, noise=0.05, seed=3).table("rows").to_dict()
KINDS = {
    "dict": lambda columns: columns,
    "arrays": lambda columns: {name: np.asarray(cells) for name, cells in columns.items()},
    "big-endian": lambda columns: {name: np.asarray(cells, dtype=">f8")[::1] for name, cells in columns.items()},
    "records": lambda columns: np.rec.fromarrays(list(columns.values()), names=list(columns)),
    "pandas": lambda columns: reader("pandas").DataFrame(columns),
    "pandas, nullable": lambda columns: reader("pandas").DataFrame(columns).convert_dtypes(),
    "polars": lambda columns: reader("polars").DataFrame(columns),
    "pyarrow": lambda columns: reader("pyarrow").table(columns),
}


def written(columns, file):
    with open(file, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(columns)
        writer.writerows(["" if cell is None else repr(cell) for cell in row] for row in zip(*columns.values(), strict=True))
    return file


@pytest.mark.parametrize("kind", KINDS)
def test_tables_are_read_as_files(kind, tmp_path):
    table = KINDS[kind]({"beside": list(map(str, range(60))), **MEASURED})
    file = written(MEASURED, tmp_path / "data.csv")
    assert ur5.measure(table, "ur5").to_json() == ur5.measure(file, "ur5").to_json()
    if kind in ("dict", "polars"):
        found, expected = ur5.identify(table, "ur5", test=table), ur5.identify(file, "ur5", test=file)
        assert found.to_json() == expected.to_json()
        assert set(found.report(tmp_path / "found")) == {"report.html", "found.toml", "found.map.toml"}
        again, other = ur5.simulate("ur5", data=table), ur5.simulate("ur5", data=file)
        assert again.to_json() == other.to_json()


def test_compensate_takes_tables():
    joints = {name: [home, home + 0.01] for name, home in zip(pps.variables, pps.home, strict=True)}
    expected = pps.compensate(np.array(list(joints.values())).T).q
    for kind in ("dict", "pandas", "polars", "pyarrow"):
        assert np.array_equal(pps.compensate(KINDS[kind](joints)).q, expected)


def test_rows_that_cannot_be_used(tmp_path):
    columns = {name: list(cells) for name, cells in MEASURED.items()}
    columns["x_t"][7] = None
    columns["joint_2"][9] = float("inf")
    columns["y_t"][11] = 1e200
    said = [(row.line, row.reason) for row in ur5.identify(columns, "ur5").unusable]
    assert said == [(7, "`x_t` is missing"), (9, "`joint_2` is `inf`"), (11, "`y_t` is `1e200`; the maximum is 1e150")]
    # Lines of a file count from 1 and include the header.
    of_file = [(row.line - 2, row.reason) for row in ur5.identify(written(columns, tmp_path / "data.csv"), "ur5").unusable]
    assert of_file == said
    measured = ur5.measure(columns, "ur5")
    assert (measured.rows, measured.unusable) == (57, 3)
    assert measured.messages[0] == "\n".join(["data: 57 rows, 3 more that cannot be used:", *(f"  row {row}: {why}" for row, why in said)])
    columns["x_t"] = ["here"] * 60
    with pytest.raises(abbe.SpecError, match="no row can be used: row 0: `x_t` is `here`, not a number") as caught:
        ur5.measure(columns, "ur5")
    assert caught.value.file == "data"
    del columns["x_t"]
    with pytest.raises(abbe.SpecError, match="there is no column `x_t` in data"):
        ur5.measure(columns, "ur5")
    columns["x_t"] = [1.0]
    with pytest.raises(abbe.SpecError, match="`x_t` has 1 rows"):
        ur5.measure(columns, "ur5")


class Odd:
    """Table whose columns cannot be read."""

    columns = list(MEASURED)

    def __getitem__(self, name):
        raise OSError("not there")


def wrong():
    yield from [None, 3, 1.5, True, [], [1], np.zeros(3), np.zeros((3, 12)), object(), set(), lambda: 0, {}, {"x_t": []}, Odd()]
    yield {name: [] for name in MEASURED}
    for cells in [3, None, "text", [[1, 2]] * 60, np.zeros((60, 2)), [1j] * 60, [b"1"] * 60, np.zeros(60, "V8"), [object()] * 60]:
        yield {**MEASURED, "x_t": cells}
    for cells in [[np.nan] * 60, [None] * 60, [np.inf] * 60, [1e300] * 60, ["", *"a" * 59], ["\0"] * 60, ["\ud800"] * 60, [True] * 60]:
        yield {**MEASURED, "x_t": cells}
    yield {**MEASURED, "x_t": np.ma.masked_array(np.zeros(60), mask=[True] * 60)}
    yield {**MEASURED, "x_t": np.zeros(60, "M8[s]")}
    yield {**MEASURED, "x_t": np.zeros(60, "m8[s]")}
    yield {**MEASURED, "x_t": np.full(60, "NaT", "M8[ns]")}
    yield {name + " ": cells for name, cells in MEASURED.items()}
    yield {i: cells for i, cells in enumerate(MEASURED.values())}


def test_wrong_tables():
    calls = 0
    for table in wrong():
        for call in [
            lambda: ur5.measure(table, "ur5"),
            lambda: ur5.identify(table, "ur5"),
            lambda: ur5.identify(MEASURED, "ur5", test=3 if table is None else table),
            lambda: ur5.monitor(table, "ur5"),
            lambda: ur5.monitor([MEASURED, table], "ur5"),
        ]:
            with pytest.raises((TypeError, ValueError, OSError)):
                call()
            calls += 1
    assert calls > 150


def test_figures():
    report = pps.analyze()
    pareto = report.figure("pareto")
    assert pareto.svg.startswith("<svg") and pareto.title == "Share of each source"
    [panel] = pareto.scene["panels"]
    bars = panel["marks"][0]
    largest = dict(zip(report.table("ledger.sources").to_dict()["name"], report.table("ledger.sources").to_dict()["max"], strict=True))
    names = [name.splitlines()[0] for name in panel["x"]["scale"]["names"]]
    shares = [100 * largest[name] / sum(largest.values()) for name in names]
    assert bars["shape"] == "bars" and len(shares) == 7 and np.allclose([bar[1][1] for bar in bars["bars"]], shares)
    for name, figure in report.figures().items():
        scene = figure.scene
        assert scene["title"] == figure.title and scene["panels"] and all(panel["marks"] for panel in scene["panels"]), name
        assert figure._repr_svg_() == figure.svg
        shapes = {mark["shape"] for panel in scene["panels"] for mark in panel["marks"]}
        assert shapes <= {"lines", "points", "crosses", "band", "bars", "surface", "texts"}, name
