"""Cases whose answers stand in textbooks or are found on a sheet of paper."""

import pathlib
import re

PROJECT = pathlib.Path(__file__).parents[2]

CANTILEVER = """
[manipulator]
name = "cantilever"
length = "m"
gravity = [0, 0, "-10 m/s^2"]
[[frame]]
name = "tip"
transform = "Tx(1)"
[[source]]
name = "sag"
class = "repeatable"
frame = "tip"
beam = { length = 1, EI_y = "1000 N*m^2", EI_z = "1000 N*m^2", GJ = "500 N*m^2" WEIGHT }
LOAD
"""
F, EI, GJ = 100.0, 1000.0, 500.0  # N, N m², N m²; the beam is 1 m long

# Name; mass per length; the load; e_z, e_s (about +y: the tip turns down) and e_p (about the beam) at the tip.
BEAMS = [
    ("load at the tip", "", 'mass = "10 kg"', -F / (3 * EI), F / (2 * EI), 0.0),
    ("load in the middle", "", 'mass = "10 kg"\npoint = [-0.5, 0, 0]', -5 * F / (48 * EI), F / (8 * EI), 0.0),
    ("load at the clamp", "", 'mass = "10 kg"\npoint = [-1, 0, 0]', 0.0, 0.0, 0.0),
    ("own weight", ', mass_per_length = "10 kg/m"', "", -F / (8 * EI), F / (6 * EI), 0.0),
    ("end force", "", 'force = [0, 0, "-100 N"]', -F / (3 * EI), F / (2 * EI), 0.0),
    ("end moment", "", 'moment = [0, "100 N*m", 0]', -F / (2 * EI), F / EI, 0.0),
    ("torque", "", 'moment = ["100 N*m", 0, 0]', 0.0, 0.0, F / GJ),
    ("load beside the beam", "", 'mass = "10 kg"\npoint = [-0.5, 0.2, 0]', -5 * F / (48 * EI), F / (8 * EI), -0.2 * F * 0.5 / GJ),
]


def beams(comparison, folder):
    for name, weight, load, e_z, e_s, e_p in BEAMS:
        comparison.attempt(beam, folder, name, weight, load, [0, 0, e_z, e_s, 0, e_p])


def beam(comparison, folder, name, weight, load, expected):
    load = f'[[load]]\nframe = "tip"\n{load}' if load else ""
    file = folder / "cantilever.toml"
    file.write_text(CANTILEVER.replace("WEIGHT", weight).replace("LOAD", load))
    errors = comparison.abbe("jacobian", str(file))["generalized_errors"]
    comparison.numbers(f"beam, {name}", expected, errors, F / EI)


def arm(comparison, folder):
    """The arm of the chapter "In your program", stretched out: 400 mm and 450 mm from the shoulder to the tool point."""
    text = (PROJECT / "docs/in-your-program.md").read_text()
    [spec] = [block for block in re.findall(r"```toml\n(.*?)```", text, re.S) if 'name = "arm"' in block]
    file, study = folder / "arm.toml", folder / "home.toml"
    file.write_text(spec)
    study.write_text('[study]\ntitle = "at home"\nset = { payload = "5 kg" }\n[workspace.grid]\nq2 = [0]\n')
    report = comparison.abbe("analyze", str(file), "--study", str(study))
    norms = {source["name"]: source["plain_max"]["norm"] for source in report["sources"]}
    comparison.numbers("In your program, encoder", 20e-6 * (400 + 450), norms["shoulder encoder"])
    comparison.numbers("In your program, sag", 3e-5 * 5 * 450, norms["arm sags under its load"])

