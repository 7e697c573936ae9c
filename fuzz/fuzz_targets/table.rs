//! Arbitrary bytes, read as measurements of a shipped machine. Valid ones are identified from.
#![no_main]

mod told;

use std::sync::LazyLock;

use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::measure::Measure;
use abbe_study::Machine;
use libfuzzer_sys::fuzz_target;

static MACHINE: LazyLock<Machine> = LazyLock::new(|| Machine::find("scara").expect("it is shipped"));

static MAP: LazyLock<Map> = LazyLock::new(|| {
    let joint = |variable: &abbe_spec::Variable| {
        format!(
            "{0} = {{ column = \"{0}\", unit = \"{1}\" }}\n",
            variable.name,
            match variable.kind {
                abbe::VariableKind::Revolute => "deg",
                abbe::VariableKind::Prismatic => "mm",
            }
        )
    };
    let joints: String = MACHINE.spec.variables.iter().map(joint).collect();
    let text = format!(
        "[data]\nuncertainty = \"0.02 mm\"\n[joints]\n{joints}[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n"
    );
    Map::parse("map.toml", &text, &MACHINE.spec).expect("the map is right")
});

fuzz_target!(|bytes: &[u8]| {
    let file = std::env::temp_dir().join(format!("abbe-fuzzed-table-{}.csv", std::process::id()));
    std::fs::write(&file, bytes).expect("temporary files can be written");
    let measured = Data::read(&file, &MAP).and_then(|data| {
        let (machine, map, accept) = (MACHINE.clone(), MAP.clone(), Acceptance::default());
        Measure { machine, map, data, accept }.run(&mut ())
    });
    if let Err(refused) = measured {
        told::told(&refused);
    }
});
