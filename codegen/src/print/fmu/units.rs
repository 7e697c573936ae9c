//! Units as FMI defines them: a product of powers of SI base units and a factor.

use std::collections::BTreeSet;

use abbe_core::LengthUnit;
use abbe_spec::expr::Dimension;

use super::xml::Element;

/// A unit.
#[derive(Clone, Debug)]
pub(super) struct Unit {
    pub(super) name: String,
    /// Powers of m, kg, s and K, and the factor; `None` for a square root of a unit.
    base: Option<([i32; 4], f64)>,
}

impl Unit {
    /// Returns the coherent unit of a dimension.
    pub(super) fn coherent(dimension: Dimension, length: LengthUnit) -> Self {
        let factor = |powers: [i32; 4]| match length {
            LengthUnit::Metre => 1.0,
            LengthUnit::Millimetre => format!("1e{}", -3 * powers[0]).parse().expect("this is a number"),
        };
        let base = dimension.whole_exponents().map(|powers| (powers, factor(powers)));
        Self { name: dimension.unit(length.symbol()), base }
    }

    /// Returns the coherent unit of a dimension, or `None` for a dimensionless number.
    pub(super) fn some(dimension: Dimension, length: LengthUnit) -> Option<Self> {
        (dimension != Dimension::NONE).then(|| Self::coherent(dimension, length))
    }

    /// Returns the unit of an angle.
    pub(super) fn angle() -> Self {
        Self { name: "rad".to_owned(), base: None }
    }

    fn element(&self) -> Element {
        let unit = Element::new("Unit").with("name", &self.name);
        if self.name == "rad" {
            let degrees = Element::new("DisplayUnit").with("name", "deg").with("factor", 1f64.to_degrees());
            return unit.containing([Element::new("BaseUnit").with("rad", 1), degrees]);
        }
        unit.containing(self.base.map(|(powers, factor)| {
            let powers = ["m", "kg", "s", "K"].into_iter().zip(powers).filter(|(_, power)| *power != 0);
            let base = powers.fold(Element::new("BaseUnit"), |base, (name, power)| base.with(name, power));
            if factor == 1.0 { base } else { base.with("factor", format!("{factor:?}")) }
        }))
    }
}

/// Returns the definitions of all units, without duplicates.
pub(super) fn definitions<'u>(units: impl Iterator<Item = &'u Unit>) -> Element {
    let mut defined = BTreeSet::new();
    let once = units.filter(|unit| defined.insert(unit.name.clone()));
    Element::new("UnitDefinitions").containing(once.map(Unit::element))
}
