"""Functions of a machine: shapes, values and arguments."""

import pickle

import numpy as np
import pytest

import abbe

ARM = """
[manipulator]
name = "arm"
length = "mm"
[parameters]
reach = "450 mm"
[inputs]
payload = { value = "0 kg", range = ["0 kg", "5 kg"] }
[[frame]]
name = "column"
variable = { name = "d1", kind = "prismatic", limits = ["0 mm", "800 mm"] }
transform = "Tz(d1 + 200 mm)"
[[frame]]
name = "shoulder"
variable = { name = "q2", kind = "revolute", limits = ["-150 deg", "150 deg"] }
dh = { theta = "q2", d = 0, a = 400, alpha = 0 }
[tool]
transform = "Tx(reach)"
[[source]]
name = "sag"
class = "repeatable"
frame = "shoulder"
e_s = "3e-5/kg * payload"
"""


def samples(machine, count, seed=0):
    """Draw configurations within the limits."""
    lower, upper = np.clip(np.array(machine.limits).T, -10, 1e4)
    return np.random.default_rng(seed).uniform(lower, upper, (count, len(machine.variables)))


@pytest.mark.parametrize("name", abbe.shipped())
def test_shapes_and_batches(name):
    machine = abbe.load(name)
    n, nq, ns = len(machine.frames), len(machine.variables), len(machine.parameters)
    shapes = {
        "pose": (4, 4),
        "transforms": (n + 1, 4, 4),
        "error_jacobian": (6, 6 * n),
        "joint_jacobian": (6, nq),
        "parameter_jacobian": (6, ns),
        "generalized_errors": (n, 6),
        "predict": (6,),
        "source_displacements": (len(machine.sources), 6),
        "real_pose": (4, 4),
    }
    q = samples(machine, 70)
    for function, shape in shapes.items():
        function = getattr(machine, function)
        many = function(q)
        assert many.shape == (70, *shape) and many.flags.c_contiguous
        # Batches are evaluated in lanes, single configurations by scalar code, with different rounding.
        one = np.stack([function(each) for each in q])
        assert np.all(np.abs(many - one) <= 1e-13 * (1 + np.abs(one).max(initial=0)))
        # In lanes, the bits of a result depend neither on its position nor on the shape of the batch.
        assert np.array_equal(function(q[::-1]), many[::-1])
        assert np.array_equal(function(q.reshape(7, 10, nq)), many.reshape(7, 10, *shape))
        out = np.full_like(many, np.nan)
        assert function(q, out=out) is out and np.array_equal(out, many)


def test_the_jacobian_is_the_derivative_of_the_pose():
    machine = abbe.load("puma560")
    q, step = samples(machine, 20), 1e-6
    for joint, name in enumerate(machine.variables):
        moved = np.zeros(6)
        moved[joint] = step
        slope = (machine.pose(q + moved) - machine.pose(q - moved))[:, :3, 3] / (2 * step)
        assert np.allclose(machine.joint_jacobian(q)[:, :3, joint], slope, atol=1e-8), name


def test_derivatives_by_parameters():
    arm = abbe.load(text=ARM)
    q = np.array([[300.0, 0.5], [200.0, -0.3]])
    # ΔX is linear in the length of the arm.
    slope = arm.parameter_derivatives(q, payload=5)
    longer = arm.with_parameters(reach=451.0).predict(q, payload=5) - arm.predict(q, payload=5)
    assert slope.shape == (2, 1, 6) and np.allclose(slope[:, 0], longer, atol=1e-12) and np.any(slope)
    jacobian = arm.parameter_derivatives(q[0], "error_jacobian")
    expected = arm.with_parameters(reach=451.0).error_jacobian(q[0]) - arm.error_jacobian(q[0])
    assert jacobian.shape == (1, 6, 12) and np.allclose(jacobian[0], expected, atol=1e-10) and np.any(jacobian)
    with pytest.raises(ValueError, match='give "predict" or "error_jacobian"'):
        arm.parameter_derivatives(q, "pose")
    # Loops stay closed.
    arm = abbe.load("palletizer")
    name = next(iter(arm.parameters))
    ends = [arm.with_parameters(**{name: arm.parameters[name] + step}).error_jacobian(arm.home) for step in (-1e-3, 1e-3)]
    jacobian = arm.parameter_derivatives(arm.home, "error_jacobian")[0]
    assert np.allclose(jacobian, (ends[1] - ends[0]) / 2e-3, atol=1e-6) and np.any(jacobian)


def test_products_of_the_jacobian():
    machine = abbe.load("general6r")
    q, errors = samples(machine, 50), np.random.default_rng(1).normal(size=(50, 36)) * 1e-3
    jacobian = machine.error_jacobian(q)
    assert np.allclose(machine.displacement(q, errors), np.einsum("nij,nj->ni", jacobian, errors), atol=1e-15)
    assert np.array_equal(machine.displacement(q, errors[0])[7], machine.displacement(q[7:8], errors[:1])[0])
    assert machine.displacement(q[0], errors).shape == (50, 6)
    covariance = np.einsum("nij,j,nkj->nik", jacobian, errors[0] ** 2, jacobian)
    assert np.allclose(machine.covariance(q, np.abs(errors[0])), covariance, atol=1e-17)
    repeatable = machine.generalized_errors(q).reshape(50, 36)
    assert np.allclose(machine.predict(q), np.einsum("nij,nj->ni", jacobian, repeatable), atol=1e-15)


def test_inputs():
    arm = abbe.load(text=ARM)
    assert arm.inputs == {"payload": 0.0} and arm.parameters == {"reach": 450.0}
    q = np.array([[300.0, 0.5], [300.0, 0.5], [300.0, 0.5]])
    full = arm.predict(q[0], payload=5)
    assert full[2] == pytest.approx(-450 * 3e-5 * 5)  # a spin about Y lowers what stands along X
    assert np.array_equal(arm.predict(q[0], payload="5000 g"), full)
    assert np.allclose(arm.predict(q, payload=[0.0, 2.5, 5.0]), np.outer([0, 0.5, 1], full))
    assert np.array_equal(arm.with_parameters(payload=5).predict(q[0]), full)
    with pytest.raises(ValueError, match="outside its range"):
        arm.predict(q, payload=[0.0, 2.5, 5.1])
    with pytest.raises(TypeError, match="no input `load`; inputs: payload"):
        arm.predict(q, load=1)
    with pytest.raises(ValueError, match=r"`payload` has shape \(2,\)"):
        arm.predict(q, payload=[1, 2])
    with pytest.raises(abbe.SpecError, match="must be a mass"):
        arm.predict(q, payload="3 mm")


def test_named_columns():
    arm = abbe.load(text=ARM)
    q = np.array([[100.0, 0.1], [200.0, 0.2]])
    columns = {"measured": [1, 2], "q2": q[:, 1], "d1": q[:, 0]}
    expected = arm.pose(q)
    assert np.array_equal(arm.pose(columns), expected)
    assert np.array_equal(arm.pose(columns | {"d1": 100.0})[0], expected[0])
    records = np.array([(0.1, 100.0), (0.2, 200.0)], dtype=[("q2", float), ("d1", float)])
    assert np.array_equal(arm.pose(records), expected)
    with pytest.raises(ValueError, match="no column q2"):
        arm.pose({"d1": [1.0]})
    for module, table in [("pandas", "DataFrame"), ("polars", "DataFrame"), ("pyarrow", "table")]:
        try:
            module = __import__(module)
        except ImportError:
            continue
        assert np.array_equal(arm.pose(getattr(module, table)(columns)), expected)


def test_another_machine():
    arm = abbe.load(text=ARM)
    longer = arm.with_parameters(reach="0.5 m")
    assert longer.parameters["reach"] == 500 and arm.parameters["reach"] == 450
    assert np.allclose(arm.scale("sag", 0.5).predict(arm.home), 0.5 * arm.predict(arm.home))
    assert arm.disable("sag").sources == () and arm.disable("sag").enable("sag").sources == ("sag",)
    again = pickle.loads(pickle.dumps(longer))
    q = samples(arm, 5)
    assert np.array_equal(again.pose(q), longer.pose(q)) and repr(again) == repr(longer)


def test_spec_errors(tmp_path):
    file = tmp_path / "arm.toml"
    file.write_text(ARM.replace("Tx(reach)", "Tx(raech)"))
    with pytest.raises(abbe.SpecError) as caught:
        abbe.load(file)
    error = caught.value
    assert (error.file, error.line, error.column) == (str(file), 18, 17)
    assert error.help == "did you mean `reach`?" and "^^^^^" in str(error)
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.line, again.help) == (str(error), error.line, error.help)
    with pytest.raises(abbe.SpecError, match="did you mean `ur5`") as caught:
        abbe.load("ur55")
    with pytest.raises(abbe.SpecError, match="there is no source"):
        abbe.load("ur5").enable("wind")
    with pytest.raises(abbe.SpecError) as caught:
        abbe.load(tmp_path / "missing.toml")
    assert caught.value.file == str(tmp_path / "missing.toml") and caught.value.line is None


def test_singular_rows_have_a_place():
    machine = abbe.load("pps")
    q = np.tile(machine.home, (100, 1))
    q[77, machine.variables.index("q5")] = np.pi / 2
    machine.pose(q)
    with pytest.raises(ValueError, match="configuration 77: Euler angles are singular"):
        machine.error_jacobian(q)


LINKAGE = """
[manipulator]
name = "linkage"
length = "mm"
[[frame]]
name = "crank"
variable = { name = "q1", kind = "revolute", limits = ["-170 deg", "170 deg"], home = "60 deg" }
transform = "Rz(q1) Tx(40)"
[[frame]]
name = "coupler"
variable = { name = "p1", kind = "revolute", passive = true, home = "-30 deg" }
transform = "Rz(p1) Tx(120)"
[[frame]]
name = "rocker"
parent = "base"
variable = { name = "p2", kind = "revolute", passive = true, home = "80 deg" }
transform = "Tx(100) Rz(p2) Tx(80)"
[[loop]]
name = "knee"
frames = ["coupler", "rocker"]
closes = ["x", "y"]
[tool]
frame = "coupler"
transform = "Ty(30)"
"""


def test_loops_close():
    """Coupler and rocker meet, in batches as one by one; errors move the tool as J_e says."""
    machine = abbe.load(text=LINKAGE)
    q = samples(machine, 50)
    p = machine.passive(q)
    assert p.shape == (50, 2) and len(machine.passive_variables) == 2 and abbe.load("ur5").passive_variables == ()
    assert np.allclose(p[7], machine.passive(q[7]), atol=1e-12)
    crank, knee, rocker = q[:, 0], q[:, 0] + p[:, 0], p[:, 1]
    meets = [40 * f(crank) + 120 * f(knee) - 80 * f(rocker) for f in (np.cos, np.sin)]
    assert np.allclose(meets[0], 100, atol=1e-9)
    assert np.allclose(meets[1], 0, atol=1e-9)
    errors = np.zeros((3, 6))
    assert np.allclose(machine.displaced_pose(q, errors), machine.pose(q), atol=1e-9)
    errors[2, 0] = 1e-4
    moved = (machine.displaced_pose(q, errors) - machine.pose(q))[:, :3, 3]
    assert np.allclose(moved, machine.displacement(q, errors)[:, :3], atol=1e-6)
    arm = abbe.load(text=ARM)
    with pytest.raises(ValueError, match="no closed loops"):
        arm.passive(arm.home)


def displacements(errors):
    """Return E_i of six errors each, as matrices: R_y(e_s) R_z(e_r) R_x(e_p)."""
    (s, r, p), found = np.moveaxis(errors[..., 3:], -1, 0), np.zeros((*errors.shape[:-1], 4, 4))
    zero, one = np.zeros_like(s), np.ones_like(s)
    about = [
        [[np.cos(s), zero, np.sin(s)], [zero, one, zero], [-np.sin(s), zero, np.cos(s)]],
        [[np.cos(r), -np.sin(r), zero], [np.sin(r), np.cos(r), zero], [zero, zero, one]],
        [[one, zero, zero], [zero, np.cos(p), -np.sin(p)], [zero, np.sin(p), np.cos(p)]],
    ]
    y, z, x = (np.moveaxis(np.array(rotation), (0, 1), (-2, -1)) for rotation in about)
    found[..., :3, :3], found[..., :3, 3], found[..., 3, 3] = y @ z @ x, errors[..., :3], 1
    return found


BRANCHES = """
[manipulator]
name = "branches"
length = "mm"
[[frame]]
name = "post"
variable = { name = "q1", kind = "revolute" }
transform = "Rz(q1) Tz(100)"
[[frame]]
name = "lamp"
transform = "Tx(50)"
[[frame]]
name = "arm"
parent = "post"
variable = { name = "q2", kind = "revolute" }
transform = "Rx(q2) Ty(200)"
[tool]
frame = "arm"
transform = "Tz(30)"
"""


@pytest.mark.parametrize("name", ["ur5", "pps", "wam", "branches"])
def test_pose_with_errors_is_the_product_of_the_chain(name):
    machine = abbe.load(text=BRANCHES) if name == "branches" else abbe.load(name)
    random, n = np.random.default_rng(4), len(machine.frames)
    q = np.array(machine.home) + random.uniform(-0.5, 0.5, (40, len(machine.variables)))
    errors = random.normal(0, 0.1, (40, n, 6))
    transforms, moved = machine.transforms(q), displacements(errors)
    expected = np.broadcast_to(np.eye(4), (40, 4, 4))
    for i in [i for i in range(n) if name != "branches" or machine.frames[i] != "lamp"]:
        expected = expected @ transforms[:, i] @ moved[:, i]
    expected = expected @ transforms[:, n]
    found = machine.displaced_pose(q, errors)
    assert np.abs(found - expected).max() < 1e-9 and np.array_equal(found, machine.displaced_pose(q, errors.reshape(40, -1)))
    assert np.abs(machine.displaced_pose(q[3], errors[3]) - expected[3]).max() < 1e-9
    assert np.abs(machine.displaced_pose(q, 0 * errors) - machine.pose(q)).max() < 1e-9
    # One set of errors for all configurations, and many for one.
    assert np.array_equal(machine.displaced_pose(q, errors[5])[5], found[5]) and machine.displaced_pose(q[5], errors).shape == (40, 4, 4)
    errors[7, 0, 0] = np.nan
    with pytest.raises(ValueError, match="configuration 7"):
        machine.displaced_pose(q, errors)
    with pytest.raises(ValueError, match="finite"):
        machine.displaced_pose(q[7], errors[7])


def test_pose_with_errors_is_the_real_pose():
    bent = {"class": "repeatable", "e_x": 0.3, "e_s": "0.02 rad", "e_p": "0.1 rad * sin(q2)"}
    machine = abbe.load("ur5").with_source(bent | {"name": "bent", "frame": "elbow"}).with_source(bent | {"name": "more", "frame": "wrist 2"})
    q = np.random.default_rng(4).uniform(-2, 2, (40, 6))
    assert np.abs(machine.displaced_pose(q, machine.generalized_errors(q)) - machine.real_pose(q)).max() < 1e-9


@pytest.mark.parametrize("name", ["displacement", "displaced_pose"])
def test_errors_that_are_not_finite_are_named(name):
    pps = abbe.load("pps")
    errors = np.zeros((3, len(pps.columns)))
    errors[1, 7] = np.nan
    with pytest.raises(ValueError, match="at configuration 1: generalized error `e_y2` is not a finite number"):
        getattr(pps, name)(pps.home, errors)
