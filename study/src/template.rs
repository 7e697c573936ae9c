//! Spec templates: starter files with comments for common kinds of machines.

use abbe_spec::option::{AXES, TEMPLATE_MACHINE_TOOL};
use abbe_spec::{check_name, edit::Edits, edit::write::quoted};

use crate::{Result, machine_tool, mistake, options::Choices};

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
    /// Linear and rotary axes in any order, with the errors of ISO 230-1.
    MachineTool,
}

impl Template {
    /// Templates, with their names.
    pub const CHOICES: Choices<Self> = Choices(&[
        (Self::SixAxis, "six-axis", "arm with six revolute joints, by Denavit-Hartenberg numbers"),
        (Self::Scara, "scara", "two arms, a stroke, and a shaft that turns"),
        (Self::Gantry, "gantry", "three linear axes"),
        (Self::FiveAxisMill, "five-axis-mill", "three linear axes that carry a swivel head"),
        (Self::Hexapod, "hexapod", "platform on six legs that extend"),
        (Self::MachineTool, "machine-tool", "linear and rotary axes in any order, with errors by ISO 230-1"),
    ]);

    /// Returns the text of the template; `None` for one that is written for its axes.
    const fn text(self) -> Option<&'static str> {
        Some(match self {
            Self::SixAxis => include_str!("../templates/six-axis.toml"),
            Self::Scara => include_str!("../templates/scara.toml"),
            Self::Gantry => include_str!("../templates/gantry.toml"),
            Self::FiveAxisMill => include_str!("../templates/five-axis-mill.toml"),
            Self::Hexapod => include_str!("../templates/hexapod.toml"),
            Self::MachineTool => return None,
        })
    }

    /// Returns the spec of a manipulator with this name; `axes` is the order of the axes of a
    /// machine tool, such as `w X' Y' b Z t`.
    ///
    /// # Errors
    ///
    /// The name is not valid for a manipulator, or the axes cannot be read or are not those of a
    /// machine tool.
    pub fn spec(self, name: &str, axes: Option<&str>) -> Result<String> {
        check_name("NAME", name)?;
        let written = self.text().map_or_else(|| machine_tool::text(axes), |text| Ok(text.to_owned()))?;
        if axes.is_some() && self != Self::MachineTool {
            let help = format!("write `{TEMPLATE_MACHINE_TOOL}`, or leave `{AXES}` out");
            return Err(mistake::with_help(AXES, "only a machine tool has axes in an order", help));
        }
        let named = Edits::apply(&written, |root, edits| {
            edits.set(&root.get("manipulator")?, "name", quoted(name));
            Some(())
        });
        Ok(named.unwrap_or_default())
    }
}
