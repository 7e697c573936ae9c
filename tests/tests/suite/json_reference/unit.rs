//! Units of numbers: said by their sentence, or by that of their group.

/// Phrases of sentences, and the unit that they say; `1` for numbers without one. The first that
/// occurs decides.
const PHRASES: [(&str, &str); 47] = [
    ("in the squared length unit", "length unit²"),
    ("in pixels and 1", "px, 1"),
    ("in products of these units", "products of the units"),
    ("in products of the units", "products of the units"),
    ("homogeneous matrix", "length unit, 1"),
    ("in the length unit or rad", "length unit or rad"),
    ("in the spec's length unit or rad", "length unit or rad"),
    ("in rad or in the spec's length unit", "length unit or rad"),
    ("the length unit and rad", "length unit, rad"),
    ("unit of length of the spec and rad", "length unit, rad"),
    ("in the tolerance's unit", "unit of the tolerance"),
    ("in the units of the map", "units of the map"),
    ("in the `position_unit`", "`position_unit`"),
    ("in `unit`", "`unit`"),
    ("in the unit of `value`", "unit of `value`"),
    ("in coherent units", "coherent"),
    ("as counted by the calendar", "`calendar`"),
    ("in the `unit` of the instrument", "`unit` of the instrument"),
    ("in N/m for a stiffness", "N/m, or m and rad"),
    ("in units of the uncertainty", "1"),
    ("in N/m", "N/m"),
    ("in N, or moment in N·m", "N or N·m"),
    ("in the length unit", "length unit"),
    ("in the spec's length unit", "length unit"),
    ("in the unit of length", "length unit"),
    ("length unit, or rad", "length unit or rad"),
    ("in rad", "rad"),
    ("oint variables", "coherent"),
    ("Configuration with", "coherent"),
    ("Parameters of", "coherent"),
    ("Ranges of all moving", "coherent"),
    ("robability", "1"),
    ("hare of", "1"),
    ("s a share", "1"),
    ("Factor", "1"),
    ("factor", "1"),
    ("Ratio", "1"),
    ("egrees of freedom", "1"),
    ("Condition number", "1"),
    ("orrelation", "1"),
    ("F statistic", "1"),
    ("ln det", "1"),
    ("nit vector", "1"),
    ("alse-alarm rate", "1"),
    ("Divisor", "1"),
    ("number of checks", "1"),
    ("without a unit", "1"),
];

/// Returns the unit that a sentence says.
pub(super) fn said(sentence: &str) -> Option<&'static str> {
    PHRASES.iter().find(|(phrase, _)| sentence.contains(phrase)).map(|(_, unit)| *unit)
}

/// Returns the unit that the sentences of a group say of all its numbers.
pub(super) fn common(sentences: &str) -> Option<&'static str> {
    let mut particular = PHRASES.iter().filter(|(phrase, unit)| {
        phrase.starts_with("in ") && !["length unit", "rad"].contains(unit) && sentences.contains(phrase)
    });
    let length = ["length unit", "spec's unit"].iter().any(|phrase| sentences.contains(phrase));
    let angle = sentences.split(|letter: char| !letter.is_alphanumeric()).any(|word| word == "rad");
    match (length, angle) {
        (true, true) => Some("length unit or rad"),
        (true, false) => Some("length unit"),
        (false, true) => Some("rad"),
        (false, false) => particular.next().map(|(_, unit)| *unit),
    }
}
