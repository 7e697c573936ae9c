"""Builds wheels with maturin, and adds the commit to the version of those of no release: 0.4.0.dev0+0123456789ab."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import maturin
from maturin import build_sdist, get_requires_for_build_sdist, get_requires_for_build_wheel

__all__ = ["build_sdist", "build_wheel", "get_requires_for_build_sdist", "get_requires_for_build_wheel"]

PACKAGE = Path(__file__).resolve().parent
# The package is compiled from all crates; tests and documents do not change it.
OTHERS = [":(exclude)../.ci", ":(exclude)../*.md", ":(exclude)../*/tests", ":(exclude)../benches", ":(exclude)../docs", ":(exclude)../tests"]


def _git(*arguments):
    command = ["git", "--no-optional-locks", *arguments]
    output = subprocess.run(command, cwd=PACKAGE, capture_output=True, text=True, check=False)
    return output.stdout.strip() if output.returncode == 0 else None


def _commit():
    """Return the commit, marked if what is compiled differs from it; None outside a checkout of this project."""
    given = os.environ.get("ABBE_COMMIT")
    if given:
        return given
    try:
        if _git("ls-files", "--error-unmatch", "build_backend.py") is None:
            return None
        commit = _git("rev-parse", "--short=12", "HEAD")
        changed = _git("status", "--porcelain", "--untracked-files=no", "--", "..", *OTHERS)
    except OSError:
        return None
    return f"{commit} modified" if commit and changed else commit


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Build a wheel, whose version names the commit unless it is that of a release."""
    del metadata_directory  # Written anew, because the version changes.
    commit = _commit()
    if commit is None:
        return maturin.build_wheel(wheel_directory, config_settings)
    # Read by `src/lib.rs` while it is compiled.
    os.environ["ABBE_COMMIT"] = commit
    with tempfile.TemporaryDirectory() as folder:
        built = Path(folder, maturin.build_wheel(folder, config_settings))
        if ".dev" not in built.name and "modified" not in commit:
            return Path(shutil.move(built, wheel_directory)).name
        return _renamed(built, commit.replace(" ", "."), wheel_directory)


def _renamed(wheel, local, directory):
    """Write the wheel anew with a local version, and return its name."""

    def tool(*arguments):
        subprocess.run([sys.executable, "-m", "wheel", *arguments], check=True, stdout=subprocess.DEVNULL)

    tool("unpack", "--dest", str(wheel.parent), str(wheel))
    name, version = wheel.name.split("-")[:2]
    folder = wheel.parent / f"{name}-{version}"
    information = (folder / f"{name}-{version}.dist-info").rename(folder / f"{name}-{version}+{local}.dist-info")
    metadata = information / "METADATA"
    text = metadata.read_text(encoding="utf-8")
    metadata.write_text(re.sub(r"(?m)^Version: .*$", rf"\g<0>+{local}", text, count=1), encoding="utf-8")
    before = set(Path(directory).glob("*.whl"))
    tool("pack", "--dest-dir", str(directory), str(folder))
    (packed,) = set(Path(directory).glob("*.whl")) - before
    return packed.name
