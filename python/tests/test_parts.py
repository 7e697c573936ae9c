"""Parts of an analysis: for any division, by Python or the command, the merged report is that of one run."""

import os
import pickle
import subprocess
from concurrent.futures import ThreadPoolExecutor

import pytest

import abbe

COMMAND = os.environ.get("ABBE")
STUDY = """
[study]
title = "Many"
tolerance = "5 mm"
[workspace.random]
samples = 20000
seed = 4
"""
pps = abbe.load("pps")


@pytest.mark.parametrize("count", [1, 2, 7, 64])
def test_any_division(count):
    machine = pps.with_parameters(x="25 mm", y=30.0).disable("assembly")
    asked = dict(study_text=STUDY, monte_carlo=200, seed=9)
    parts = [machine.analyze(shard=(i, count), **asked) for i in range(1, count + 1)]
    assert sum(part.configurations for part in parts) == 20000 and parts[0].unreachable == 0
    merged = abbe.merge(reversed(parts))
    expected = machine.analyze(**asked)
    assert merged.to_json() == expected.to_json() and str(merged) == str(expected)
    assert merged.figures() == expected.figures()


def test_parts_travel(tmp_path):
    part = pps.analyze(shard=(1, 2))
    assert repr(part) == "Part(1/2 of 'pps': 512 configurations)" and part.shard == (1, 2)
    copy = pickle.loads(pickle.dumps(part))
    other = pps.analyze(shard=(2, 2))
    other.save(tmp_path / "2.part")
    other.save(tmp_path / "2.part", overwrite=True)
    assert os.listdir(tmp_path) == ["2.part"]
    assert abbe.Part.load(tmp_path / "2.part").configurations == other.configurations
    assert abbe.merge([tmp_path / "2.part", copy]).to_json() == pps.analyze().to_json()


def test_threads():
    with ThreadPoolExecutor(4) as pool:
        parts = pool.map(lambda i: pps.analyze(shard=(i, 8), threads=1), range(1, 9))
        assert abbe.merge(parts).to_json() == pps.analyze().to_json()


@pytest.mark.skipif(not COMMAND, reason="the environment variable ABBE does not name the abbe command")
def test_the_command_makes_the_same_parts(tmp_path):
    def command(*arguments):
        return subprocess.run([COMMAND, *arguments], check=True, capture_output=True, text=True, cwd=tmp_path).stdout

    command("analyze", "pps", "--shard", "1/2", "--out", "1.part")
    pps.analyze(shard=(2, 2)).save(tmp_path / "2.part")
    expected = command("analyze", "pps", "--json")
    assert command("merge", "1.part", "2.part", "--json") == expected
    assert abbe.merge([tmp_path / "1.part", tmp_path / "2.part"]).to_json() + "\n" == expected


def test_what_does_not_belong_together(tmp_path):
    one, two = (pps.analyze(shard=(i, 2)) for i in (1, 2))
    for parts, says in [
        ([], "no part is given"),
        ([one], "missing: part 2/2"),
        ([one, two, two], "this is part 2/2"),
        ([one, pps.analyze(shard=(2, 3))], "one of 3 parts"),
        ([one, abbe.load("ur5").analyze(shard=(2, 2))], "the specs differ"),
        ([one, pps.analyze(shard=(2, 2), study_text=STUDY)], "the studies differ"),
    ]:
        with pytest.raises(abbe.SpecError, match=says):
            abbe.merge(parts)
    for parts in (None, 3, [None], [3.5]):
        with pytest.raises(TypeError):
            abbe.merge(parts)
    for shard in [(0, 2), (3, 2), (1, 0), (1, 100_001)]:
        with pytest.raises(ValueError, match="shard"):
            pps.analyze(shard=shard)
    for shard in [1, "1/2", (1,), (1.5, 2), (-1, 2)]:
        with pytest.raises((TypeError, ValueError, OverflowError)):
            pps.analyze(shard=shard)
    for text in [b"", b"nothing", b"abbe part 1\n", b"abbe part 1\n" + bytes(100)]:
        (tmp_path / "x").write_bytes(text)
        with pytest.raises(abbe.SpecError):
            abbe.Part.load(tmp_path / "x")
    with pytest.raises(abbe.SpecError, match="cannot read"):
        abbe.Part.load(tmp_path / "nowhere")
    with pytest.raises(OSError):
        one.save(tmp_path / "nowhere" / "1.part")
