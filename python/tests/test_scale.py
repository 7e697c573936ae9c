"""Recipes of docs/scale.md on two cores: the same bytes as one run, also after the loss of a worker."""

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import abbe
import abbe.fleet

COMMAND = os.environ.get("ABBE")
CHAPTER = Path(__file__).parents[2] / "docs" / "scale.md"
FILES = dict(re.findall(r"^```\w+\n# (\S+)\n(.*?)^```$", CHAPTER.read_text(), re.M | re.S))

needs_command = pytest.mark.skipif(
    not COMMAND, reason="the environment variable ABBE does not name the abbe command"
)


def needs(module):
    there = importlib.util.find_spec(module) is not None
    return pytest.mark.skipif(not there, reason=f"{module} is not installed: pip install {module}")


@pytest.fixture
def folder(tmp_path):
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def expected(folder):
    return abbe.load("puma560").analyze(folder / "night.toml").to_json() + "\n"


def printed(folder, *arguments, **environment):
    return subprocess.run(
        arguments, cwd=folder, env={**os.environ, **environment}, check=True, capture_output=True, text=True, timeout=300
    ).stdout


@needs("ray")
def test_ray(folder):
    environment = dict(RAY_USAGE_STATS_ENABLED="0", RAY_DISABLE_IMPORT_WARNING="1")
    for count in "2", "7":
        assert printed(folder, sys.executable, "ray_tasks.py", "puma560", "night.toml", count, **environment).splitlines()[
            -1
        ] + "\n" == expected(folder)


@needs("distributed")
def test_dask(folder):
    assert printed(folder, sys.executable, "dask_parts.py", "puma560", "night.toml", "7") == expected(folder)


def measured(folder):
    """Simulate measurements of two machines. Return the CSV files, and their rows by name."""
    spec = (CHAPTER.parents[1] / "manipulators/specs/ur5.toml").read_text(encoding="utf-8")
    frame = abbe.load("ur5").frames[1]
    for name, length in ("a", "0.2 mm"), ("b", "-0.4 mm"):
        source = f'[[source]]\nname = "arm"\nclass = "repeatable"\nframe = "{frame}"\ndh = {{ a = "{length}" }}\n'
        abbe.load(text=f"{spec}\n{source}").simulate("ur5", samples=40, seed=2).report(folder / name)
        (folder / name / "measurements.csv").rename(folder / f"{name}.csv")


def test_fleet(folder):
    fleet = folder / "fleet"
    measured(fleet)
    lines = printed(folder, sys.executable, "fleet_table.py", "fleet").splitlines()
    assert [line.split("  ")[0] for line in lines] == ["a.csv", "b.csv"] and " e_x2 = -0.4" in lines[1]


@needs("pandas")
@needs("pyarrow")
@pytest.mark.parametrize("engine", ["local", pytest.param("ray", marks=needs("ray")), pytest.param("dask", marks=needs("distributed"))])
def test_fleet_in_parquet(folder, engine):
    import pandas

    fleet = folder / "fleet"
    measured(fleet)
    rows = [pandas.read_csv(fleet / f"{name}.csv").assign(machine=name) for name in "ab"]
    pandas.concat(rows).to_parquet(folder / "fleet.parquet")
    printed(folder, sys.executable, "fleet_parquet.py", "fleet.parquet", "table.parquet", engine, RAY_USAGE_STATS_ENABLED="0")
    found = pandas.read_parquet(folder / "table.parquet").to_dict("list")
    assert found == abbe.fleet.identify(abbe.load("ur5"), {name: fleet / f"{name}.csv" for name in "ab"}, "ur5")


# The first worker of each part ends its process, as if its computer were switched off.
LOST = """
import os, sys, pathlib
import abbe
{setup}
def part(i):
    mark = pathlib.Path(f"lost-{{i}}")
    if i == 2 and not mark.exists():
        mark.touch()
        os._exit(9)
    return abbe.load("puma560").analyze("night.toml", shard=(i, 3), threads=1, figures=False)
{run}
"""


@needs("ray")
def test_ray_makes_a_lost_part_again(folder):
    setup = "import ray\nray.init(log_to_driver=False, num_cpus=2)\n@ray.remote(max_retries=3)"
    run = "print(abbe.merge(ray.get([part.remote(i) for i in (1, 2, 3)])).to_json())"
    # Ray workers start in the folder of the driver.
    text = LOST.format(setup=setup, run=run).replace('"night.toml"', repr(str(folder / "night.toml")))
    (folder / "lost.py").write_text(text.replace('f"lost-{i}"', f'"{folder}/lost-2"'))
    out = printed(folder, sys.executable, "lost.py", RAY_USAGE_STATS_ENABLED="0")
    assert out.splitlines()[-1] + "\n" == expected(folder) and (folder / "lost-2").exists()


@needs("distributed")
def test_dask_makes_a_lost_part_again(folder):
    run = """
if __name__ == "__main__":
    from dask.distributed import Client
    with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        print(abbe.merge(client.gather(client.map(part, [1, 2, 3], retries=3))).to_json())
"""
    (folder / "lost.py").write_text(LOST.format(setup="", run=run))
    out = printed(folder, sys.executable, "lost.py")
    assert out == expected(folder) and (folder / "lost-2").exists()


def command_on_path(folder):
    (folder / "bin").mkdir()
    (folder / "bin" / "abbe").symlink_to(Path(COMMAND).resolve())
    return f"{folder / 'bin'}:{os.environ['PATH']}"


@needs_command
def test_slurm_array(folder):
    for name in "parts.sh", "merge.sh":
        subprocess.run(["bash", "-n", folder / name], check=True)
        lines = FILES[name].splitlines()
        # sbatch reads its options from the comment lines before the first command.
        assert lines[0] == "#!/usr/bin/env bash"
        options = dict(re.fullmatch(r"#SBATCH --([a-z-]+)(?:=(\S+))?", line).groups() for line in lines[1 : lines.index("set -euo pipefail")])
        assert re.fullmatch(r"\d\d:\d\d:\d\d", options["time"]) and options["job-name"]
        if name == "parts.sh":
            assert options["array"] == "1-64" and int(options["cpus-per-task"]) > 0 and "requeue" in options
    path = command_on_path(folder)
    count = 5
    for task in range(1, count + 1):
        task = dict(SLURM_ARRAY_TASK_ID=str(task), SLURM_ARRAY_TASK_MAX=str(count), SLURM_CPUS_PER_TASK="2")
        printed(folder, "bash", "parts.sh", PATH=path, **task)
    # A lost task is repeated.
    (folder / "parts" / "3.part").unlink()
    again = dict(SLURM_ARRAY_TASK_ID="3", SLURM_ARRAY_TASK_MAX="3", SHARDS=str(count))
    printed(folder, "bash", "parts.sh", PATH=path, **again)
    assert printed(folder, "bash", "merge.sh", PATH=path) == expected(folder)


@needs_command
@needs("yaml")
def test_kubernetes_indexed_job(folder):
    import yaml

    job = yaml.safe_load(FILES["job.yaml"])
    assert (job["apiVersion"], job["kind"]) == ("batch/v1", "Job")
    spec = job["spec"]
    assert spec["completionMode"] == "Indexed" and spec["backoffLimitPerIndex"] > 0
    pod = spec["template"]["spec"]
    # A back-off limit per index requires this restart policy.
    assert pod["restartPolicy"] == "Never"
    [container] = pod["containers"]
    [mount], [volume] = container["volumeMounts"], pod["volumes"]
    assert mount["name"] == volume["name"] and container["workingDir"] == mount["mountPath"]
    count, [script] = spec["completions"], container["args"]
    assert f"/{count}\"" in script
    path = command_on_path(folder)
    for index in range(count):
        printed(folder, *container["command"], script, PATH=path, JOB_COMPLETION_INDEX=str(index))
    parts = sorted(str(part) for part in (folder / "parts").iterdir() if part.suffix == ".part")
    assert len(parts) == count
    assert printed(folder, "abbe", "merge", *parts, "--json", PATH=path) == expected(folder)
