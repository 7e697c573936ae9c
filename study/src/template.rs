//! Spec templates: starter files with comments for common kinds of machines.

use abbe_spec::check_name;
use abbe_spec::edit::Edits;
use abbe_spec::edit::write::quoted;

use crate::Result;
use crate::options::Choices;

/// Kind of machine with a template.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Template {
    /// Arm with six revolute joints, by Denavit-Hartenberg numbers.
    SixAxis,
    /// Two arms, a stroke and a turning shaft.
    Scara,
    /// Three linear axes.
    Gantry,
    /// Three linear axes with a swivel head.
    FiveAxisMill,
    /// Platform on six legs.
    Hexapod,
}

impl Template {
    /// Templates, with their names.
    pub const CHOICES: Choices<Self> = Choices(&[
        (Self::SixAxis, "six-axis", "arm with six revolute joints, by Denavit-Hartenberg numbers"),
        (Self::Scara, "scara", "two arms, a stroke, and a shaft that turns"),
        (Self::Gantry, "gantry", "three linear axes"),
        (Self::FiveAxisMill, "five-axis-mill", "three linear axes that carry a swivel head"),
        (Self::Hexapod, "hexapod", "platform on six legs that extend"),
    ]);

    /// Returns the text of the template.
    pub const fn text(self) -> &'static str {
        match self {
            Self::SixAxis => include_str!("../templates/six-axis.toml"),
            Self::Scara => include_str!("../templates/scara.toml"),
            Self::Gantry => include_str!("../templates/gantry.toml"),
            Self::FiveAxisMill => include_str!("../templates/five-axis-mill.toml"),
            Self::Hexapod => include_str!("../templates/hexapod.toml"),
        }
    }

    /// Returns the spec of a manipulator with this name.
    ///
    /// # Errors
    ///
    /// The name is not valid for a manipulator.
    pub fn spec(self, name: &str) -> Result<String> {
        check_name("NAME", name)?;
        let named = Edits::apply(self.text(), |root, edits| {
            edits.set(&root.get("manipulator")?, "name", quoted(name));
            Some(())
        });
        Ok(named.unwrap_or_default())
    }
}
