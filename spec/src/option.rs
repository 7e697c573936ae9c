//! Options and commands in sentences, in the words of the front end that the reader uses.

use std::borrow::Cow;
use std::fmt::{self, Display};
use std::sync::atomic::{AtomicBool, Ordering};

static IS_PYTHON: AtomicBool = AtomicBool::new(false);

/// Words sentences for Python from now on: `folds=5` where the command has `--folds 5`.
pub fn word_for_python() {
    IS_PYTHON.store(true, Ordering::Relaxed);
}

/// An option in a sentence, perhaps with a value: `--robust tukey`, in Python `robust="tukey"`. A
/// value in capitals stands for any.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedOption {
    name: &'static str,
    value: Option<Cow<'static, str>>,
}

/// Returns an option with a value.
pub fn option(name: &'static str, value: impl Display) -> NamedOption {
    NamedOption { name, value: Some(value.to_string().into()) }
}

/// Defines the options that sentences name, each with a fixed value or without one.
macro_rules! options {
    ($($constant:ident = $name:literal $(, $value:literal)?;)*) => {$(
        #[doc = concat!("`--", $name $(, " ", $value)?, "`")]
        pub const $constant: NamedOption =
            NamedOption { name: $name, value: options!(@ $($value)?) };
    )*};
    (@) => { None };
    (@ $value:literal) => { Some(Cow::Borrowed($value)) };
}

options! {
    ACCEPT = "accept";
    AXES = "axes";
    BASE = "base";
    BASE_LINK = "base", "LINK";
    BOXES = "boxes";
    CANDIDATES = "candidates";
    CORRECTED_SPEC = "corrected", "SPEC";
    DH = "dh";
    DH_MODIFIED = "dh", "modified";
    DH_STANDARD = "dh", "standard";
    DISABLE = "disable";
    DISABLE_NAME = "disable", "NAME";
    ENABLE = "enable";
    FOLD = "fold";
    FRAME = "frame";
    FROM = "from";
    FULL = "full";
    MAP = "map";
    MAP_FILE = "map", "FILE";
    MODEL_ERROR_LENGTH = "model-error", "LENGTH";
    MONTE_CARLO = "monte-carlo";
    NAME = "name";
    NODES = "nodes";
    ONLY = "only";
    ONLY_PLACEMENT = "only", "placement";
    POSES = "poses";
    PRIOR = "prior";
    Q = "q";
    READING_UNCERTAINTY = "reading-uncertainty";
    REAL_FLOAT = "real", "float";
    ROBUST_TUKEY = "robust", "tukey";
    ROUND_ANGLES = "round-angles";
    SAMPLES = "samples";
    SCALE = "scale";
    SCALE_GEAR = "scale", "gear=0.5";
    SCALE_UNCERTAINTY = "scale-uncertainty";
    SET = "set";
    SETS = "sets";
    SETS_FILE = "sets", "FILE";
    SET_X = "set", "x=250mm";
    SHARD_NUMBER = "shard", "I/N";
    SINCE = "since";
    STATION_NEW = "station", "new";
    STUDY = "study";
    STUDY_FILE = "study", "FILE";
    TEMPLATE_MACHINE_TOOL = "template", "machine-tool";
    TERMS = "terms";
    TEST = "test";
    TEST_FILE = "test", "FILE";
    TIME = "time";
    TIP = "tip";
    TIP_LINK = "tip", "LINK";
    TOLERANCE = "tolerance";
    TO_LINUXCNC = "to", "linuxcnc";
    TO_LINUXCNC_GENHEXKINS = "to", "linuxcnc-genhexkins";
    TO_TABLE = "to", "table";
    TO_URDF = "to", "urdf";
    UNITS_MM_DEG = "units", "mm,deg";
    WITHIN = "within";
    WEIGHT_ONE_METRE = "weight", "1m";
}

impl Display for NamedOption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, value } = self;
        if IS_PYTHON.load(Ordering::Relaxed) {
            return f.write_str(&in_python(name, value.as_deref()));
        }
        match value {
            Some(value) if value.contains(' ') => write!(f, "--{name} \"{value}\""),
            Some(value) => write!(f, "--{name} {value}"),
            None => write!(f, "--{name}"),
        }
    }
}

/// Formats an option as an argument of a Python function, or as the method that replaces it.
fn in_python(name: &str, value: Option<&str>) -> String {
    let argument = match name {
        "set" => "with_parameters",
        "dh" => "convention",
        "from" => "urdf",
        "station" => "new_station",
        _ => &name.replace('-', "_"),
    };
    let Some(value) = value else {
        let is_flag = ["round-angles", "fold", "least"].contains(&name);
        return if is_flag { format!("{argument}=True") } else { argument.to_owned() };
    };
    match (name, value.split_once(['=', '/'])) {
        ("disable", _) => format!("{argument}({value})"),
        ("station", _) => format!("{argument}=True"),
        ("set", Some((name, value))) => format!("{argument}({name}={value:?})"),
        ("shard", Some((one, count))) => format!("{argument}=({one}, {count})"),
        _ if value.starts_with(|letter: char| letter.is_ascii_lowercase()) => format!("{argument}={value:?}"),
        _ => format!("{argument}={value}"),
    }
}

/// A command in a sentence, and what Python has for it.
#[derive(Clone, Debug)]
pub struct Command(Cow<'static, str>, Cow<'static, str>);

const fn command(command: &'static str, python: &'static str) -> Command {
    Command(Cow::Borrowed(command), Cow::Borrowed(python))
}

/// Returns the command that writes one part of an analysis.
pub fn shard_command(spec: &str, number: u32, count: u32) -> Command {
    Command(
        format!("abbe analyze {spec} --shard {number}/{count} --out FILE").into(),
        format!("Machine.analyze(shard=({number}, {count})).save(FILE)").into(),
    )
}

impl Display for Command {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if IS_PYTHON.load(Ordering::Relaxed) { &self.1 } else { &self.0 })
    }
}

/// Writes a file of abbe. With `>`, some shells write UTF-16.
pub const OUT_FILE: Command = command("abbe … --out FILE", "abbe … --out FILE");
/// Writes one part of an analysis.
pub const SHARD: Command =
    command("abbe analyze SPEC --shard I/N --out FILE", "Machine.analyze(shard=(I, N)).save(FILE)");
/// Converts a URDF file to a spec.
pub const IMPORT_URDF: Command =
    command("abbe import FILE.urdf --tip LINK -o SPEC", "abbe.import_urdf(FILE, tip=LINK)");
/// Measures the errors of a machine.
pub const MEASURE: Command = command("abbe measure SPEC DATA --map MAP", "Machine.measure(DATA, MAP)");
/// Measures from a station that the map does not know.
pub const MEASURE_NEW_STATION: Command =
    command("abbe measure --station new", "Machine.measure(…, new_station=True)");
/// Generates code.
pub const GENERATE: Command = command("abbe generate SPEC --out FILE", "Machine.generate()");
/// Writes an identified machine.
pub const IDENTIFY_OUT: Command = command("abbe identify --out", "Machine.identify(…).report(folder)");

#[cfg(test)]
mod tests;
