//! Plain signs for terminals without UTF-8.

use super::{Block, Document, Table};

/// Signs, and what stands for them in ASCII.
const SIGNS: [(char, &str); 40] = [
    ('×', "x"),
    ('·', "*"),
    ('±', "+/-"),
    ('−', "-"),
    ('–', "-"),
    ('—', "-"),
    ('─', "-"),
    ('…', "..."),
    ('°', " deg"),
    ('µ', "u"),
    ('μ', "u"),
    ('σ', "sigma"),
    ('ε', "eps"),
    ('Δ', "d"),
    ('φ', "phi"),
    ('ψ', "psi"),
    ('θ', "theta"),
    ('ρ', "rho"),
    ('π', "pi"),
    ('λ', "lambda"),
    ('ν', "nu"),
    ('χ', "chi"),
    ('Σ', "sum "),
    ('√', "sqrt "),
    ('∞', "inf"),
    ('→', "->"),
    ('↑', "(+)"),
    ('↓', "(-)"),
    ('≤', "<="),
    ('≥', ">="),
    ('≈', "~"),
    ('‖', "|"),
    ('⁻', "^-"),
    ('¹', "1"),
    ('²', "^2"),
    ('³', "^3"),
    ('“', "\""),
    ('”', "\""),
    ('’', "'"),
    ('\u{304}', "_mean"),
];

/// Replaces signs by ASCII; `?` stands for all others. Blanks that do not break stay.
pub fn plain(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for sign in text.chars() {
        match SIGNS.iter().find(|(known, _)| *known == sign) {
            Some((_, words)) => plain.push_str(words),
            None if sign.is_ascii() || sign == '\u{a0}' => plain.push(sign),
            None => plain.push('?'),
        }
    }
    plain
}

impl Document {
    /// Replaces signs by ASCII, before columns are aligned.
    pub fn in_plain_signs(mut self) -> Self {
        let replace = |text: &mut String| *text = plain(text);
        replace(&mut self.machine);
        replace(&mut self.headline);
        for block in self.sections.iter_mut().flat_map(|section| &mut section.blocks) {
            match block {
                Block::Facts(facts) => facts.iter_mut().for_each(|(_, text)| replace(text)),
                Block::Table(Table { caption, columns, rows, rest }) => {
                    [caption, rest].into_iter().for_each(replace);
                    columns.iter_mut().for_each(|column| replace(&mut column.name));
                    rows.iter_mut().flatten().for_each(replace);
                }
                Block::Statement(statement) => replace(&mut statement.text),
                Block::List(lines) | Block::Code(lines) => lines.iter_mut().for_each(replace),
                Block::Cards(_) | Block::Figures(_) => {}
            }
        }
        self
    }
}
