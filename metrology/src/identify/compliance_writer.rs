//! Writes full compliances of the identified machine: one matrix per frame, or for the base.

use abbe::Component;
use abbe_spec::Spec;
use abbe_spec::edit::TableText;
use abbe_spec::edit::write::{list, number, quoted};

use super::spec_writer::{DIGITS, repeatable};
use super::{Basis, ErrorSite, FoundModel, FoundTerm};
use abbe_study::number::digits;

/// Rotational errors in the order of the rows of a compliance.
const TURNS: [Component; 3] = [Component::Spin, Component::Roll, Component::Pitch];

/// Elastic body: a frame, or none for the base.
type Owner = Option<usize>;

impl FoundModel {
    /// Returns true if a term is an entry of one of the full compliances.
    pub(super) fn is_in_full_compliance(&self, found: &FoundTerm) -> bool {
        owner(found).is_some_and(|owner| self.full_owners().contains(&owner))
    }

    /// Returns the owners of full compliances: those with an off-diagonal entry.
    fn full_owners(&self) -> Vec<Owner> {
        let mut owners = Vec::new();
        for found in self.terms.iter().filter(|found| matches!(found.term.basis, Basis::Coupled(_))) {
            owners.extend(owner(found).filter(|owner| !owners.contains(owner)));
        }
        owners
    }

    /// Returns the sources of all full compliances. `base` is the name of the frame at `F_0`.
    pub(super) fn full_compliances(&self, spec: &Spec, base: &str) -> String {
        self.full_owners().into_iter().map(|owner| self.full_compliance(spec, base, owner)).collect()
    }

    /// Returns the source or sources of one compliance.
    ///
    /// A spec accepts only positive semidefinite compliances. Any other matrix C is written as
    /// `(C + D) − D`, where D is the smallest diagonal matrix that makes C + D diagonally dominant.
    fn full_compliance(&self, spec: &Spec, base: &str, of: Owner) -> String {
        let (mut matrix, mut deviations) = ([[0.0; 3]; 3], Vec::new());
        for found in self.terms.iter().filter(|found| owner(found) == Some(of)) {
            let (row, column) = entry(found);
            matrix[row][column] = found.magnitude;
            matrix[column][row] = found.magnitude;
            let deviation = digits((found.standard_deviation / found.magnitude).abs(), 2);
            let [one, other] = [row, column].map(|i| TURNS[i].name());
            deviations.push(format!("{one} {other} {deviation}"));
        }
        let off = if is_semidefinite(&matrix) { [0.0; 3] } else { deficits(&matrix) };
        (0..3).for_each(|i| matrix[i][i] += off[i]);
        let (frame, owner) = match of {
            Some(frame) => (spec.frames[frame].name.as_str(), spec.frames[frame].name.as_str()),
            None => (base, "foundation"),
        };
        let source = |name: &str, what: &str, keys: TableText, matrix: &[[f64; 3]; 3]| {
            let effect = TableText::with_header("\n[[source.effect]]").text("frame", frame);
            let effect = effect.key("compliance", format!("{{ matrix = {} }}", format_matrix(spec, matrix)));
            self.source(spec, name, what, keys).then(effect).to_string()
        };
        let name = format!("identified: {owner}: elastic deflection");
        let what = format!("Standard deviations, relative to the entries: {}", deviations.join(", "));
        let mut text = source(&name, &what, repeatable(), &matrix);
        if off != [0.0; 3] {
            let diagonal =
                std::array::from_fn(|i| std::array::from_fn(|j| if i == j { off[i] } else { 0.0 }));
            let what = "Correction: the identified matrix alone is not a valid compliance, so it \
                includes effects that are not elastic";
            let keys = repeatable().key("magnitude", "{ value = -1 }");
            text += &source(&format!("{name}, correction"), what, keys, &diagonal);
        }
        text
    }
}

/// Returns the owner of a compliance term; none for any other term.
fn owner(found: &FoundTerm) -> Option<Owner> {
    match found.term.site {
        _ if !found.term.basis.is_elastic() => None,
        ErrorSite::Frame(frame, _) => Some(Some(frame)),
        ErrorSite::Base(_) => Some(None),
        _ => None,
    }
}

/// Returns the row and the column of a compliance term.
fn entry(found: &FoundTerm) -> (usize, usize) {
    let index = |component: Component| TURNS.iter().position(|turn| *turn == component).unwrap_or_default();
    let row = match found.term.site {
        ErrorSite::Frame(_, component) | ErrorSite::Base(component) => index(component),
        _ => 0,
    };
    let column = match found.term.basis {
        Basis::Coupled(other) => index(other),
        _ => row,
    };
    (row, column)
}

/// Tests by Sylvester's criterion that no principal minor is negative. The margin of 1e-6 keeps the
/// rounding of written digits from deciding.
fn is_semidefinite(c: &[[f64; 3]; 3]) -> bool {
    let diagonal = (0..3).all(|i| c[i][i] >= 0.0);
    let minor = |i: usize, j: usize| (1.0 - 1e-6) * c[i][i] * c[j][j] - c[i][j] * c[i][j];
    let pairs = [(0, 1), (0, 2), (1, 2)].into_iter().all(|(i, j)| minor(i, j) >= 0.0);
    let product = c[0][0] * c[1][1] * c[2][2];
    let determinant = product + 2.0 * c[0][1] * c[1][2] * c[0][2]
        - c[0][0] * c[1][2].powi(2)
        - c[1][1] * c[0][2].powi(2)
        - c[2][2] * c[0][1].powi(2);
    diagonal && pairs && determinant >= 1e-6 * product
}

/// Returns, for every row, the sum of the absolute off-diagonal entries minus the diagonal entry,
/// at least 0.
fn deficits(c: &[[f64; 3]; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        let others: f64 = (0..3).filter(|j| *j != i).map(|j| c[i][j].abs()).sum();
        // The margin exceeds the last digit that is written.
        (others * (1.0 + 1e-6) - c[i][i]).max(0.0)
    })
}

/// Formats a matrix as the six rows of a spec, in the order e_x e_y e_z e_s e_r e_p.
fn format_matrix(spec: &Spec, matrix: &[[f64; 3]; 3]) -> String {
    let unit = Basis::Moment.text(spec);
    let turn = |component: Component| TURNS.iter().position(|turn| *turn == component);
    let entry = |row: Component, column: Component| match (turn(row), turn(column)) {
        (Some(i), Some(j)) if matrix[i][j] != 0.0 => {
            quoted(&format!("{} * {unit}", number(matrix[i][j], DIGITS)))
        }
        _ => "0".to_owned(),
    };
    list(Component::ALL.map(|row| list(Component::ALL.map(|column| entry(row, column)))))
}

#[cfg(test)]
mod tests;
