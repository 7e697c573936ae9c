//! Where the machine stands and what is mounted on its tool, as found: beside the machine, not in it.

use abbe::identify::{Fit, Model, Unknown};
use abbe::{Component, Pose};
use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::spec::Spec;
use serde::Serialize;

use super::setup::{displaced, found_stations};
use crate::data::{Map, quaternion};

/// What was found of stations and tool.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Placed {
    /// Where the machine stands.
    pub stations: Vec<PlacedStation>,
    /// Where the targets are in the frame of the tool; none where whole poses were measured.
    pub targets: Vec<[f64; 3]>,
    /// From the frame that is seen to that of the tool, as rows of a homogeneous matrix, where whole poses were measured.
    pub mounting: Option<[[f64; 4]; 4]>,
    /// Covariance of all coordinates of the targets, or of the six errors of the mounting.
    pub covariance: Vec<Vec<f64>>,
    /// Whether nothing of it was unknown.
    #[serde(skip)]
    exact: bool,
}

/// A station that was found.
#[derive(Clone, Debug, Serialize)]
pub struct PlacedStation {
    /// What it is called; empty if it is the only one.
    pub name: String,
    /// From `F_0` to the frame of the instrument: rows of a homogeneous matrix.
    pub pose: [[f64; 4]; 4],
    /// Covariance of its six errors `e_x e_y e_z e_s e_r e_p`, in the axes of `F_0`: length unit and rad.
    pub covariance: [[f64; 6]; 6],
}

impl Placed {
    /// What a fit found.
    pub(super) fn new(model: &Model, fit: &Fit, pose: bool) -> Self {
        let among = |unknown: Unknown| {
            let k = model.unknowns.iter().position(|u| *u == unknown)?;
            fit.identifiable.kept.iter().position(|kept| *kept == k)
        };
        let covariance = |a: Unknown, b: Unknown| match (among(a), among(b)) {
            (Some(a), Some(b)) => fit.covariance[(a, b)],
            _ => 0.0,
        };
        let rows = |pose: Pose| pose.rows().map(|row| row.map(|entry| entry + 0.0));
        let stations = found_stations(model, &fit.x).into_iter().enumerate().map(|(i, station)| {
            let base = |component| Unknown::Base(i, component);
            let of = |a| Component::ALL.map(|b| covariance(base(a), base(b)));
            PlacedStation { name: station.name, pose: rows(station.pose), covariance: Component::ALL.map(of) }
        });
        let value =
            |unknown: Unknown| model.unknowns.iter().position(|u| *u == unknown).map_or(0.0, |k| fit.x[k]);
        let targets = model.targets.iter().enumerate();
        let targets: Vec<[f64; 3]> = targets
            .map(|(j, target)| std::array::from_fn(|axis| target[axis] + value(Unknown::Target(j, axis))))
            .collect();
        let unknowns: Vec<Unknown> = match pose {
            true => Component::ALL.map(Unknown::Tool).to_vec(),
            false => {
                (0..targets.len()).flat_map(|j| [0, 1, 2].map(|axis| Unknown::Target(j, axis))).collect()
            }
        };
        let of = |a: &Unknown| unknowns.iter().map(|b| covariance(*a, *b)).collect();
        Self {
            stations: stations.collect(),
            covariance: unknowns.iter().map(of).collect(),
            exact: !model.unknowns.iter().any(|unknown| unknown.is_tool()),
            mounting: pose.then(|| rows(model.mounting.then(&displaced(model, &fit.x, Unknown::Tool)))),
            targets: if pose { Vec::new() } else { targets },
        }
    }

    /// The map that the data were read with, with what was found; `path` is the name of its file. What an earlier
    /// identification said of it is left out.
    ///
    /// What is written is a map, or it is not written.
    pub fn written(
        &self,
        map: &Map,
        spec: &Spec,
        reference: &str,
        path: &str,
    ) -> Result<String, Diagnostics> {
        let unit = spec.length.symbol();
        let mut text = format!("{}\n\n{HEAD}# {reference}\n", without_places(map.text()).trim_end());
        let place = |pose: &[[f64; 4]; 4]| {
            let [x, y, z] = [0, 1, 2].map(|axis| pose[axis][3]);
            let columns = [0, 1, 2].map(|j| [0, 1, 2].map(|i| pose[i][j]));
            let [w, a, b, c] = quaternion(&columns).map(number);
            format!("position = {}\nquaternion = [{w}, {a}, {b}, {c}]\n", lengths([x, y, z], unit))
        };
        for station in &self.stations {
            let name = match &station.name[..] {
                "" => String::new(),
                name => format!("name = {}\n", quoted(name)),
            };
            let covariance = matrix(station.covariance.iter().map(|row| &row[..]));
            text += &format!("[[station]]\n{name}{}{covariance}\n", place(&station.pose));
        }
        if !self.exact {
            let covariance = matrix(self.covariance.iter().map(|row| &row[..]));
            let places = match &self.mounting {
                Some(pose) => place(pose),
                None => {
                    let targets =
                        self.targets.iter().map(|target| format!("  {},\n", lengths(*target, unit)));
                    format!("targets = [\n{}]\n", targets.collect::<String>())
                }
            };
            text += &format!("[placement]\n{places}{covariance}");
        }
        let text = text.trim_end().to_owned() + "\n";
        Map::parse(path, &text, spec)?;
        Ok(text)
    }
}

const HEAD: &str =
    "# Where the machine stands and what is mounted on its tool, as found: no errors of the machine.\n";

/// A map without the tables that `[[station]]` and `[placement]` are, and without what is said above them.
fn without_places(text: &str) -> String {
    let mut inside = false;
    let kept = text.split_inclusive('\n').filter(|line| {
        if line.starts_with('[') {
            inside = ["[[station]]", "[placement]"].iter().any(|table| line.starts_with(table));
        }
        inside |= *line == HEAD;
        !inside
    });
    kept.collect()
}

fn lengths(values: [f64; 3], unit: &str) -> String {
    let [x, y, z] = values.map(|value| format!("\"{} {unit}\"", number(value)));
    format!("[{x}, {y}, {z}]")
}

fn matrix<'r>(rows: impl Iterator<Item = &'r [f64]>) -> String {
    let row = |row: &[f64]| {
        let numbers: Vec<String> = row.iter().map(|value| format!("{:e}", rounded(*value, 4))).collect();
        format!("  [{}],\n", numbers.join(", "))
    };
    format!("covariance = [\n{}]\n", rows.map(row).collect::<String>())
}

/// Digits enough for a nanometre at ten metres.
fn number(value: f64) -> String {
    format!("{:e}", rounded(value, 11))
}

fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.digits$e}").parse::<f64>().unwrap_or(value) + 0.0
}

/// A text as TOML has it.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}
