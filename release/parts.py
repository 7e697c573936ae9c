"""Parts of `release/build` that are the same on every system: tables of crates, archives with fixed bytes, links, checksums."""

import argparse
import gzip
import hashlib
import html
import io
import json
import os
import re
import shutil
import subprocess
import tarfile
import tomllib
import zipfile
from datetime import UTC, datetime
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parent.parent
EPOCH = int(os.environ.get("SOURCE_DATE_EPOCH", "0"))
# Of the headers and libraries for Windows, in Debian and its derivatives.
MINGW = Path("/usr/share/doc/mingw-w64-x86-64-dev/copyright")
LICENCE_FILE = re.compile(r"(?i)^(licen[cs]e|copying|copyright|notice|unlicense)")


def cargo(*arguments):
    command = [os.environ.get("CARGO", "cargo"), *arguments, "--locked"]
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout


def metadata():
    return json.loads(cargo("metadata", "--format-version", "1"))["packages"]


def linked(package, target):
    """Return what is compiled into a package for a target, sorted, without its own crates: those are under its licence."""
    tree = cargo("tree", "-p", package, "--target", target, "--edges", "normal,no-proc-macro", "--prefix", "none", "--format", "{p}")
    names = {tuple(line.split()[:2]) for line in tree.splitlines()}
    found = [one for one in metadata() if one["source"] and (one["name"], f"v{one['version']}") in names]
    return sorted(found, key=lambda one: (one["name"], one["version"]))


def order():
    """Print the crates that are published, each after those that it depends on."""
    packages = {one["name"]: one for one in metadata() if one["source"] is None and one["publish"] is None}
    done = []

    def visit(name):
        if name in done:
            return
        for dependency in sorted(packages[name]["dependencies"], key=lambda one: one["name"]):
            # Cargo removes dependencies of tests that have no version from what it publishes.
            if dependency["name"] in packages and (dependency["kind"] != "dev" or dependency["req"] != "*"):
                visit(dependency["name"])
        done.append(name)

    for name in sorted(packages):
        visit(name)
    print(*done, sep="\n")


def licences(package, target, file):
    """Write a table of the crates that are compiled in, and the texts of their licences, each once."""
    crates = linked(package, target)
    lines = ["Crates that are compiled in, beside the standard library of Rust (MIT OR Apache-2.0)", ""]
    if target.endswith("-musl") and package == "abbe-cli":
        lines[0] += " and musl libc (MIT)"
    if target.endswith("-windows-gnu"):
        lines[0] += ",\nthe runtime of mingw-w64 (ZPL-2.1, MIT, BSD and public domain) and that of GCC (GPL-3.0 WITH GCC-exception-3.1)"
    width = max(len(one["name"]) for one in crates)
    texts = {}
    for one in crates:
        licence = one["license"] or one["license_file"]
        lines.append(f"{one['name']:{width}}  {one['version']:12}  {licence}")
        folder = Path(one["manifest_path"]).parent
        for path in sorted(folder.iterdir()):
            if path.is_file() and LICENCE_FILE.match(path.name):
                text = path.read_text(encoding="utf-8", errors="replace").replace("\r\n", "\n").strip()
                texts.setdefault(text, []).append(f"{one['name']} {one['version']}")
    if target.endswith("-windows-gnu"):
        texts[mingw()] = ["runtime of mingw-w64"]
    for text, names in texts.items():
        lines += ["", "=" * 80, ", ".join(names), "=" * 80, "", text]
    write(file, "\n".join(lines) + "\n")


def mingw():
    """Return what the table of Debian says of the parts that are linked: the C runtime and the threads."""
    kept, licences = [], set()
    for paragraph in re.split(r"\n{2,}", MINGW.read_text(encoding="utf-8").strip()):
        names = {name for line in re.findall(r"(?m)^License: (.*)", paragraph) for name in line.split(" and ")}
        if re.match(r"Files: (\*|mingw-w64-crt/|mingw-w64-libraries/winpthreads/(?!tests))", paragraph):
            licences |= names
            kept.append(paragraph)
        elif paragraph.startswith("License: ") and names <= licences:
            kept.append(paragraph)
    return "\n\n".join(kept)


def sbom(package, target, file):
    """Write what is compiled in as CycloneDX 1.5."""
    lock = tomllib.loads((ROOT / "Cargo.lock").read_text(encoding="utf-8"))["package"]
    sums = {(one["name"], one["version"]): one.get("checksum") for one in lock}

    def component(one, kind="library"):
        purl = f"pkg:cargo/{one['name']}@{one['version']}"
        entry = {"type": kind, "bom-ref": purl, "name": one["name"], "version": one["version"], "purl": purl}
        if one["license"]:
            entry["licenses"] = [{"expression": one["license"].replace("/", " OR ")}]
        if checksum := sums.get((one["name"], one["version"])):
            entry["hashes"] = [{"alg": "SHA-256", "content": checksum}]
        return entry

    (own,) = (one for one in metadata() if one["name"] == package and one["source"] is None)
    crates = linked(package, target)
    properties = [{"name": "abbe:commit", "value": os.environ.get("ABBE_COMMIT", "unknown")}, {"name": "abbe:target", "value": target}]
    document = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {
            "timestamp": datetime.fromtimestamp(EPOCH, UTC).isoformat().replace("+00:00", "Z"),
            "component": component(own, "application"),
            "properties": properties,
        },
        "components": [component(one) for one in crates],
        "dependencies": [{"ref": f"pkg:cargo/{own['name']}@{own['version']}", "dependsOn": [component(one)["purl"] for one in crates]}],
    }
    write(file, json.dumps(document, indent=1) + "\n")


def write(file, text):
    Path(file).write_text(text, encoding="utf-8", newline="\n")


def pack(folder, file):
    """Pack a folder: sorted, without owners, with the time of the commit."""
    folder = Path(folder)
    paths = sorted([folder, *folder.rglob("*")], key=lambda path: path.as_posix())
    named = [(path, path.relative_to(folder.parent).as_posix()) for path in paths]

    def mode(path, name):
        return 0o755 if path.is_dir() or "/bin/" in name else 0o644

    if file.endswith(".zip"):
        when = datetime.fromtimestamp(EPOCH, UTC).timetuple()[:6]
        with zipfile.ZipFile(file, "w") as archive:
            for path, name in named:
                if path.is_file():
                    entry = zipfile.ZipInfo(name, when)
                    entry.compress_type, entry.create_system = zipfile.ZIP_DEFLATED, 3
                    entry.external_attr = (0o100000 | mode(path, name)) << 16
                    archive.writestr(entry, path.read_bytes(), compresslevel=9)
        return
    with open(file, "wb") as raw, gzip.GzipFile("", "wb", 9, raw, EPOCH) as packed, tarfile.open(fileobj=packed, mode="w", format=tarfile.GNU_FORMAT) as archive:
        for path, name in named:
            entry = tarfile.TarInfo(name)
            entry.mtime, entry.mode = EPOCH, mode(path, name)
            entry.uname = entry.gname = "root"
            if path.is_dir():
                entry.type = tarfile.DIRTYPE
                archive.addfile(entry)
            else:
                content = path.read_bytes()
                entry.size = len(content)
                archive.addfile(entry, io.BytesIO(content))


class Links(HTMLParser):
    """The links of a page."""

    def __init__(self):
        super().__init__()
        self.found = set()

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.found.add(value)


def generated(folder):
    """Move pages of generated code to `generated` of their crate: rustdoc names them by the path of the build."""
    folder = Path(folder)
    for build in sorted((folder / "src").glob("*/**/build/*/out")):
        crate, *path = build.relative_to(folder / "src").parts
        build.rename(folder / "src" / crate / "generated")
        shutil.rmtree(folder / "src" / crate / path[0])
        for page in sorted(folder.rglob("*.html")):
            text = page.read_text(encoding="utf-8").replace(f"/{'/'.join(path)}/", "/generated/")
            if page.parent == folder / "src" / crate / "generated":
                text = text.replace("../" * (len(path) + 2), "../" * 3)
            write(page, text)


def links(folder):
    """Copy what the book links to from the repository, write an index, and fail if a link leads nowhere."""
    folder = Path(folder).resolve()
    tracked = set(subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines())
    write(
        folder / "index.html",
        '<!doctype html>\n<meta charset="utf-8">\n<title>abbe</title>\n<h1>abbe</h1>\n<ul>\n<li><a href="docs/index.html">The book</a></li>\n'
        '<li><a href="api/abbe/index.html">API reference of the crates</a></li>\n</ul>\n',
    )
    broken = []
    for page in sorted((folder / "docs").rglob("*.html")):
        parser = Links()
        parser.feed(page.read_text(encoding="utf-8"))
        for link in sorted(parser.found):
            target = unquote(link.split("#")[0].split("?")[0])
            if not target or re.match(r"[a-z]+:", target) or page.name == "404.html":
                continue
            path = Path(os.path.normpath(page.parent / target))
            if path.exists():
                continue
            name = path.relative_to(folder).as_posix() if path.is_relative_to(folder) else ".."
            source = name if name in tracked else name.removesuffix(".html") + ".md"
            below = [one for one in tracked if one.startswith(name + "/")]
            path.parent.mkdir(parents=True, exist_ok=True)
            if name in tracked:
                shutil.copyfile(ROOT / name, path)
            elif name.endswith(".html") and source in tracked:
                text = html.escape((ROOT / source).read_text(encoding="utf-8"))
                write(path, f'<!doctype html>\n<meta charset="utf-8">\n<title>{source}</title>\n<pre>{text}</pre>\n')
            elif below:
                for one in below:
                    (folder / one).parent.mkdir(parents=True, exist_ok=True)
                    shutil.copyfile(ROOT / one, folder / one)
            else:
                broken.append(f"{page.relative_to(folder)}: {link}")
    if broken:
        raise SystemExit("links that lead nowhere:\n" + "\n".join(broken))


def sums(folder):
    """Write SHA256SUMS of everything in a folder."""
    folder = Path(folder)
    files = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file() and path.name != "SHA256SUMS")
    write(folder / "SHA256SUMS", "".join(f"{hashlib.sha256((folder / name).read_bytes()).hexdigest()}  {name}\n" for name in files))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    commands = parser.add_subparsers(required=True)
    for function, names in [
        (order, ()),
        (licences, ("package", "target", "file")),
        (sbom, ("package", "target", "file")),
        (pack, ("folder", "file")),
        (links, ("folder",)),
        (generated, ("folder",)),
        (sums, ("folder",)),
    ]:
        command = commands.add_parser(function.__name__, help=function.__doc__)
        for name in names:
            command.add_argument(name)
        command.set_defaults(function=function)
    arguments = vars(parser.parse_args())
    arguments.pop("function")(**arguments)


main()
