//! Tables of joint profiles: values at regular steps, in the units and with the digits in which a
//! spec has them, so that the fit and the written machine use the same numbers.

use abbe::LengthUnit;
use abbe::identify::{Profile, ProfileBasis};
use abbe_spec::Spec;
use abbe_spec::edit::TableText;
use abbe_spec::edit::write::{free_name, lines};
use abbe_spec::expr::{Dimension, Extrapolation, Interpolation, Table, Unit};

/// Steps of a table over an angle, in degrees, the largest first. The smallest has 22 points per
/// period of the highest harmonic.
const TURNS: [f64; 5] = [4.0, 2.0, 1.0, 0.5, 0.25];

/// Numbers of steps of a table over a travel, the smallest first.
const TRAVELS: [f64; 5] = [64.0, 128.0, 256.0, 512.0, 1024.0];

/// Interpolation error of a table, as a share of the standard deviation of the profile.
const SHARE: f64 = 0.1;

/// Values of a profile at regular steps of its joint.
#[derive(Clone, Debug)]
pub(super) struct ProfileTable {
    /// Joint values, in the first unit.
    pub(super) x: Vec<f64>,
    /// Errors of the joint, in the second unit.
    pub(super) y: Vec<f64>,
    /// Units of both, as a spec writes them.
    pub(super) units: [&'static str; 2],
}

impl ProfileTable {
    /// Tabulates a profile over its range; none if fewer than two steps fit in.
    ///
    /// The step is the largest whose interpolation error at `values` is at most a tenth of
    /// `deviation`, root mean square of both.
    pub(super) fn new(profile: &Profile, values: &[f64], deviation: f64, length: LengthUnit) -> Option<Self> {
        let [from, to] = profile.joint.range;
        let units = match profile.joint.basis {
            ProfileBasis::Turn => ["deg", "urad"],
            ProfileBasis::Travel(_) => ["mm", "um"],
        };
        let [of_x, of_y] = units.map(|unit| in_coherent(1.0, unit, length));
        let steps: Vec<f64> = match profile.joint.basis {
            ProfileBasis::Turn => TURNS.to_vec(),
            ProfileBasis::Travel(_) => TRAVELS.map(|count| round_step((to - from) / of_x / count)).to_vec(),
        };
        let exact: Vec<f64> = values.iter().map(|q| profile.value(*q)).collect();
        let mut finest = None;
        for step in steps {
            // Ends within the range, so that the values there are not extrapolated.
            let [first, last] = [(from / of_x / step).ceil(), (to / of_x / step).floor()];
            if last - first < 2.0 {
                continue;
            }
            let x: Vec<f64> =
                (0..=(last - first) as u32).map(|i| rounded(step * (first + f64::from(i)), 1e6)).collect();
            let y = |x: &f64| rounded(profile.value(in_coherent(*x, units[0], length)) / of_y, 1e3);
            let table = Self { y: x.iter().map(y).collect(), x, units };
            let lookup = table.table(String::new(), length);
            let squares: f64 =
                values.iter().zip(&exact).map(|(q, exact)| (lookup.derivative(0, *q) - exact).powi(2)).sum();
            let is_close = squares <= values.len() as f64 * (SHARE * deviation).powi(2);
            finest = Some(table);
            if is_close {
                break;
            }
        }
        finest
    }

    /// Returns the table of a spec.
    pub(super) fn table(&self, name: String, length: LengthUnit) -> Table {
        let convert = |(x, y): (&f64, &f64)| {
            [in_coherent(*x, self.units[0], length), in_coherent(*y, self.units[1], length)]
        };
        let points = self.x.iter().zip(&self.y).map(convert).collect();
        let dimension = if self.units[0] == "deg" { Dimension::NONE } else { Dimension::LENGTH };
        let (cubic, hold) = (Interpolation::Cubic, Extrapolation::Hold);
        Table::new(name, String::new(), [dimension; 2], points, cubic, hold)
    }

    /// Formats the table as `[tables.NAME]` of a spec.
    pub(super) fn text(&self, name: &str, description: &str, reference: &str) -> String {
        let head = TableText::with_header(&format!("\n[tables.{name}]")).text("description", description);
        let head = head.text("reference", reference).text("interpolation", "cubic").text("outside", "hold");
        let axes = [("x", &self.x, self.units[0]), ("y", &self.y, self.units[1])];
        let axes = axes.map(|(axis, values, unit)| {
            let rows =
                values.chunks(12).map(|row| row.iter().map(|v| (v + 0.0).to_string()).collect::<Vec<_>>());
            let keys = TableText::with_header(&format!("\n[tables.{name}.{axis}]")).text("unit", unit);
            keys.key("values", lines(rows.map(|row| row.join(", ")))).to_string()
        });
        head.then(axes.concat()).to_string()
    }
}

/// Returns the name of the table of a joint's profile, which no other table of the spec has.
pub(super) fn table_name(spec: &Spec, joint: &str) -> String {
    let is_taken = |name: &str| spec.tables.iter().any(|table| table.name.eq_ignore_ascii_case(name));
    free_name(&format!("profile_{joint}"), |i| format!("profile_{joint}_{i}"), is_taken)
}

/// Converts a number of a unit to the coherent units of a spec, as its reader does.
fn in_coherent(number: f64, unit: &str, length: LengthUnit) -> f64 {
    Unit::named(unit).map_or(number, |unit| unit.convert(number, length))
}

/// Returns the largest step of 1, 2 or 5 times a power of ten that is not larger.
fn round_step(step: f64) -> f64 {
    let decade = 10f64.powi(step.log10().floor() as i32);
    let most = [5.0, 2.0].into_iter().find(|one| one * decade <= step);
    most.unwrap_or(1.0) * decade
}

fn rounded(value: f64, parts: f64) -> f64 {
    (value * parts).round() / parts
}
