//! `abbe jacobian`: pose, error Jacobian and generalized errors at one configuration.

use abbe_report::text;
use abbe_study::jacobian;
use clap::Args;

use crate::arguments::Subject;
use crate::output::{Outcome, json};
use crate::{Console, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe jacobian arm.toml --q 300,30deg,-45deg
  abbe jacobian arm.toml --q 0.3m,30deg,-pi/4 --set payload=5kg --json
"))]
pub(crate) struct Jacobian {
    #[command(flatten)]
    subject: Subject,
    /// Joint variables in the order of the spec: `--q 500,0.2m,0,-90deg,pi/180,0`. [default: home]
    ///
    /// A number without a unit is in the spec's length unit for a prismatic joint and in rad for a
    /// revolute joint.
    #[arg(long, value_name = "V,V,…", allow_hyphen_values = true)]
    q: Option<String>,
    /// Print the report as JSON
    #[arg(long, display_order = 111)]
    json: bool,
}

pub(crate) fn run(arguments: &Jacobian) -> Result<Outcome> {
    let machine = arguments.subject.machine()?;
    let q = arguments.q.as_ref().map(|text| jacobian::read_joint_variables(text, &machine.spec));
    let q = q.transpose()?;
    let report = jacobian::Jacobian { machine, q }.run(&mut Console::default())?;
    Ok(Outcome::passed(if arguments.json { json(&report)? } else { text::jacobian(&report) }))
}
