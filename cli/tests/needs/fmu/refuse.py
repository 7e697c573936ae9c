"""What a functional mock-up unit must not take: refuse.py UNIT. It has an input u.heat with a range."""

import os
import re
import sys

import fmpy
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

from simulate import compiled

unit = fmpy.extract(compiled(sys.argv[1], "cc"))
description = fmpy.read_model_description(unit)
is_2 = description.fmiVersion == "2.0"
references = {variable.name: variable.valueReference for variable in description.modelVariables}


def instance(token):
    made = (FMU2Slave if is_2 else FMU3Slave)(guid=token, modelIdentifier=description.coSimulation.modelIdentifier, unzipDirectory=unit)
    made.instantiate()
    return made


def refused(call, *arguments):
    try:
        call(*arguments)
    except FMICallException as exception:
        assert exception.status == 3, exception
        return
    raise AssertionError(f"{call.__name__}{arguments} went well")


def begun():
    made = instance(description.guid)
    if is_2:
        made.setupExperiment()
        made.enterInitializationMode()
    else:
        made.enterInitializationMode()
    return made


try:
    instance("{00000000-0000-0000-0000-000000000000}")
    raise AssertionError("a description of another machine was taken")
except Exception as exception:
    assert "instantiate" in str(exception), exception

# Everything that FMPy's headers declare is there.
header = os.path.join(os.path.dirname(fmpy.__file__), "c-code", f"fmi{description.fmiVersion[0]}FunctionTypes.h")
with open(header) as file:
    declared = re.findall(r"\b(fmi\d[A-Za-z0-9]+)TYPE *\(", file.read())
library = instance(description.guid).dll
assert len(declared) > 40 and all(hasattr(library, name) for name in declared)

unit_ = begun()
get, put = (unit_.getReal, unit_.setReal) if is_2 else (unit_.getFloat64, unit_.setFloat64)
output = references["displacement.x"]
assert get([output]) == [2e-5]
refused(put, [output], [1.0])
refused(put, [references["time"]], [1.0])
refused(get, [9999])
unit_.exitInitializationMode()
for wrong in [10.0, float("nan")]:
    put([references["u.heat"]], [wrong])
    refused(get, [output])
    refused(unit_.doStep, 0.0, 1.0)
put([references["u.heat"]], [3.0])
unit_.doStep(0.0, 1.0)
assert get([output]) == [2e-5 * 3.0], get([output])
# Another source has the same identifier.
put([references["magnitude.growth____heat_"], references["magnitude.growth____heat__2"]], [-2.0, 0.5])
unit_.doStep(1.0, 1.0)
assert get([output, references["displacement.z"], references["time"]]) == [-2e-5 * 3.0 * 2.0, 1e-5 * 3.0 * 0.5, 2.0], get([output])
unit_.reset()
assert get([output]) == [2e-5]
unit_.freeInstance()
