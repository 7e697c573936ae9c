"""Jobs of a machine: the same reports as the command, and their execution."""

import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import abbe

COMMAND = os.environ.get("ABBE")
pps, ur5 = abbe.load("pps"), abbe.load("ur5")


def test_analyze():
    report = pps.analyze()
    first = max(report.sources, key=lambda source: source.plain_max.norm)
    assert first.name == "assembly" and report.configurations == 999
    assert report.to_dict()["combined"]["radius"] == report.combined.radius
    html = report._repr_html_()
    assert "tolerance 0.5 mm" in html.split("<pre")[0] and "max mm" in html and "Each source alone" in html.split("<details>")[1]
    assert "Each source alone" in report.full() and "sources" in dir(report)
    assert len(report.figures()) > 0 and all(figure.svg.startswith("<svg") for figure in report.figures().values())
    assert report.figure(next(iter(report.figures()))).svg.startswith("<svg")
    with pytest.raises(ValueError, match="there is no figure"):
        report.figure("nothing")
    with pytest.raises(AttributeError, match="no field `nothing`"):
        report.nothing


@pytest.mark.skipif(not COMMAND, reason="the environment variable ABBE does not name the abbe command")
def test_the_same_as_the_command():
    def printed(*arguments):
        return subprocess.run([COMMAND, *arguments], check=True, capture_output=True, text=True).stdout

    report = pps.analyze(monte_carlo=100, seed=3)
    asked = ["analyze", "pps", "--monte-carlo", "100", "--seed", "3"]
    assert report.to_json() + "\n" == printed(*asked, "--json") and report.full() == printed(*asked, "--full")
    changed = pps.with_parameters(x="25 mm").disable("assembly").analyze()
    assert changed.to_json() + "\n" == printed("analyze", "pps", "--set", "x=25mm", "--disable", "assembly", "--json")
    assert json.loads(printed("check", "scara", "--json")) == abbe.load("scara").check().to_dict()
    assert printed("generate", "scara", "--lang", "rust") == abbe.load("scara").generate()
    assert "int scara_pose(\n    const float q[ABBE_RESTRICT(4)]," in abbe.load("scara").generate("c", real="float")


@pytest.mark.skipif(not COMMAND, reason="the environment variable ABBE does not name the abbe command")
def test_print_shows_the_text_of_the_command(tmp_path):
    def printed(*arguments):
        return subprocess.run([COMMAND, *arguments], check=True, capture_output=True, text=True).stdout

    data = str(tmp_path / "data.csv")
    simulated = ur5.simulate("ur5", samples=60, seed=4)
    assert str(simulated) == printed("simulate", "ur5", "--map", "ur5", "--samples", "60", "--seed", "4")
    Path(data).write_text(str(simulated))
    assert printed("check", "ur5").startswith(str(ur5.check()))
    assert printed("measure", "ur5", data, "--map", "ur5").startswith(str(ur5.measure(data, "ur5")))
    assert printed("identify", "ur5", data, "--map", "ur5").startswith(str(ur5.identify(data, "ur5")))
    plan = ur5.plan("ur5", count=20, candidates=60)
    assert printed("plan", "ur5", "--map", "ur5", "--optimal", "20", "--candidates", "60").startswith(str(plan))
    dated = [str(tmp_path / f"2026-03-0{day}.csv") for day in (1, 2, 3)]
    for day in dated:
        Path(day).write_text(str(ur5.simulate("ur5", data=data, seed=int(day[-5]))))
    assert printed("monitor", "ur5", *dated, "--map", "ur5").startswith(str(ur5.monitor(dated, "ur5")))


def test_report(tmp_path):
    report = pps.analyze()
    written = report.report(tmp_path / "new")
    assert "report.html" in written and sorted(written) == sorted(os.listdir(tmp_path / "new"))
    with pytest.raises(FileExistsError):
        report.report(tmp_path / "new")
    report.report(tmp_path / "new", overwrite=True)
    with pytest.raises(ValueError, match="no pages"):
        pps.check().report(tmp_path)


SOURCES = """
[[source]]
name = "upper arm"
class = "repeatable"
frame = "shoulder lift"
dh = { a = "0.5 mm", theta = "0.4 mrad" }
"""


def test_from_measurements_to_corrected_commands(tmp_path):
    spec = (Path(__file__).parents[2] / "manipulators/specs/ur5.toml").read_text(encoding="utf-8")
    real = abbe.load(text=spec + SOURCES.replace("shoulder lift", ur5.frames[1]))
    assert real.simulate("ur5", samples=80, seed=1).report(tmp_path) == ["measurements.csv"]
    data = tmp_path / "measurements.csv"
    measured = ur5.measure(data, "ur5")
    assert measured.rows == 80 and measured.errors[3].name == "norm" and measured.errors[3].mean > 0.1
    identified = ur5.identify(data, "ur5")
    assert identified.fit.after.mean < 0.05 < identified.fit.before.mean and "fit" in str(identified)
    identified.report(tmp_path / "found")
    found = abbe.load(tmp_path / "found/found.toml")
    assert found.measure(data, tmp_path / "found/found.map.toml").explained.left_mean < 0.06
    command = ur5.home
    q = found.compensate(command).q
    asked = ur5.pose(command)[:3, 3]
    assert np.linalg.norm(real.real_pose(q)[:3, 3] - asked) < np.linalg.norm(real.real_pose(command)[:3, 3] - asked) / 3
    plan = ur5.plan("ur5", count=20, candidates=60)
    assert plan.rows == 20 and plan.report(tmp_path / "plan") == ["plan.csv"]


def test_inverses_are_all_joints_of_a_pose():
    ur5 = abbe.load("ur5")
    q = np.array([0.3, -1.2, 1.1, 0.4, 0.8, 0.1])
    found = ur5.inverses(ur5.pose(q), q)
    assert found.shape == (8, 6) and np.allclose(found[0], q, atol=1e-9)
    assert np.allclose(ur5.pose(found), ur5.pose(q), atol=1e-6)
    assert len({tuple(np.round(each, 6)) for each in found}) == 8
    with pytest.raises(ValueError, match="give poses"):
        ur5.inverses([500.0, 0, 0])
    with pytest.raises(ValueError, match="out of reach"):
        ur5.inverses(np.array([[1, 0, 0, 5000], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]]))


def test_commands():
    q = ur5.inverse(ur5.pose([0.3, -1.2, 1.1, 0.4, 0.8, 0.1]), [0.2, -1.1, 1, 0.3, 0.7, 0])
    assert np.allclose(ur5.pose(q), ur5.pose([0.3, -1.2, 1.1, 0.4, 0.8, 0.1]), atol=1e-6)
    with pytest.raises(ValueError, match="out of reach"):
        ur5.inverse([5000.0, 0, 0])
    asked = np.tile(pps.home, (5, 1)) + np.arange(5)[:, None] * [10, 10, 10, 0.05, 0.01, 0.01]
    before = np.linalg.norm((pps.real_pose(asked) - pps.pose(asked))[:, :3, 3], axis=1)
    found = pps.compensate(asked)
    after = np.linalg.norm((pps.real_pose(found.q) - pps.pose(asked))[:, :3, 3], axis=1)
    assert found.q.shape == (5, 6) and found.left.shape == (5, 6) and before.min() > 0.1
    assert all((reason is None) == (left < 0.001) for reason, left in zip(found.reason, after, strict=True))
    assert pps.compensate(asked[0]).q.shape == (6,)
    # At its limits of 3 degrees the machine cannot turn on: less of both together is left if 1 rad weighs as 1 m.
    at_limits = pps.home + np.array([[10, 10, 10, 0.3, turn, turn] for turn in (0.0523, -0.0523)])
    size = [
        np.hypot(*(np.linalg.norm(part, axis=1) for part in (left[:, :3], 1e3 * left[:, 3:])))
        for left in (pps.compensate(at_limits).left, pps.compensate(at_limits, weight="1 m").left)
    ]
    assert np.all(size[1] <= size[0] + 1e-9) and np.any(size[1] < size[0] - 1e-8), size
    with pytest.raises(ValueError, match="configuration 3: d1 is commanded"):
        pps.compensate(np.where(np.arange(5)[:, None] == 3, 1e5, asked))


def test_progress_and_warnings():
    heard = []
    pps.analyze(monte_carlo=0, progress=lambda done, total: heard.append((done, total)))
    assert heard[-1] == (999, 999)

    def refuse(done, total):
        raise KeyError("enough")

    with pytest.raises(KeyError, match="enough"):
        pps.analyze(progress=refuse)


LARGE = """
[study]
title = "Much"
[workspace.joints]
samples = 50_000_000
"""


def test_ctrl_c():
    begin = time.monotonic()
    # Shells make background processes ignore SIGINT.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        with pytest.raises(KeyboardInterrupt):
            ur5.analyze(study_text=LARGE, figures=False)
            time.sleep(5)
    finally:
        signal.signal(signal.SIGINT, before)
    assert time.monotonic() - begin < 30


@pytest.mark.skipif(not hasattr(os, "fork"), reason="nothing forks here")
def test_a_forked_process_works():
    pps.analyze()
    code = "import abbe, os; m = abbe.load('pps'); m.analyze(); pid = os.fork(); r = m.analyze().combined.radius; "
    code += "pid and exit(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))"
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)


def test_mistakes_of_jobs(tmp_path):
    for call in [
        lambda: pps.analyze("nowhere.toml"),
        lambda: pps.analyze(study_text="[study]\ntitle = 3"),
        lambda: ur5.measure("nowhere.csv", "nowhere.toml"),
        lambda: ur5.identify("nowhere.csv", "ur5"),
        lambda: ur5.plan("nowhere"),
        lambda: ur5.simulate("nowhere"),
        lambda: ur5.monitor(["nowhere.csv"], "nowhere"),
    ]:
        with pytest.raises(abbe.SpecError) as caught:
            call()
        assert caught.value.file
        pickle.loads(pickle.dumps(caught.value))
    for call in [
        lambda: ur5.identify("a", "b", terms="wind"),
        lambda: ur5.identify("a", "b", robust="very"),
        lambda: ur5.identify("a", "b", prior=-1),
        lambda: ur5.identify("a", "b", folds=0),
        lambda: ur5.identify("a", "b", time=float("nan")),
        lambda: ur5.plan("a", criterion="w"),
        lambda: ur5.plan("a", count=0),
        lambda: ur5.simulate("a", noise=-1),
        lambda: ur5.simulate("a", noise=float("nan")),
        lambda: ur5.simulate("a", outliers=2),
        lambda: ur5.monitor(["a"], "b", false_alarm=1),
        lambda: ur5.monitor("a", "b"),
        lambda: ur5.generate("cobol"),
        lambda: ur5.generate("rust", real="float"),
        lambda: ur5.generate("c", real="half"),
        lambda: ur5.inverse(np.zeros((3, 2))),
        lambda: ur5.inverse([np.nan, 0, 0]),
        lambda: ur5.inverse([1, 0, 0], [1, 2]),
        lambda: ur5.compensate([1, 2]),
        lambda: ur5.compensate(ur5.home, tolerance="3 kg"),
    ]:
        with pytest.raises((TypeError, ValueError)):
            call()


def test_live_pages_are_shown_in_a_frame_and_saved(tmp_path):
    machine = abbe.load("pps")
    page = machine.explore()
    assert repr(page) == "<abbe page: NPTC patient positioning system>"
    assert "Content-Security-Policy" in page.html and page.html.count('class="abbe-panel"') == 1
    shown = page._repr_html_()
    assert shown.startswith("<iframe") and 'sandbox="allow-scripts"' in shown and "<script" not in shown
    page.save(tmp_path / "pps.html")
    assert (tmp_path / "pps.html").read_text(encoding="utf-8") == page.html
    with pytest.raises(FileExistsError):
        page.save(tmp_path / "pps.html")
    page.save(tmp_path / "pps.html", overwrite=True)
    assert 'class="abbe-panel"' in machine.analyze().explore().html
    with pytest.raises(ValueError, match="no page"):
        machine.check().explore()


def test_pages_of_texts_have_a_panel_without_a_command():
    """No command can name what a program gave as a text or as rows."""
    ur5 = abbe.load("ur5")
    arm = abbe.load(text='[manipulator]\nname = "arm"\nlength = "mm"\n[[frame]]\nname = "turn"\nvariable = { name = "q1", kind = "revolute", limits = ["-90 deg", "90 deg"] }\n'
        'transform = "Rz(q1) Tx(300)"\n[[source]]\nname = "gear"\nclass = "random"\ndistribution = "normal"\njoint = "q1"\nerror = "1 mrad"\n'
    )
    few = '[study]\ntitle = "few"\n[workspace.joints]\nsamples = 5\n'
    for page, spec in [
        (ur5.analyze().explore(), "ur5"),
        (ur5.analyze(study_text=few).explore(), ""),
        (ur5.analyze(q=[ur5.home]).explore(), ""),
        (ur5.explore(study_text=few), ""),
        (arm.analyze().explore(), ""),
        (arm.explore(), ""),
    ]:
        assert page.html.count('class="abbe-panel"') == 1
        assert f'{{"spec":"{spec}",' in page.html
