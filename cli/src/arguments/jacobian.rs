use clap::Args;

use super::shared::Subject;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe jacobian arm.toml --q 300,30deg,-45deg
  abbe jacobian arm.toml --q 0.3m,30deg,-pi/4 --set payload=5kg --json
"))]
pub(crate) struct Jacobian {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// Joint variables in the order of the spec: `--q 500,0.2m,0,-90deg,pi/180,0`. [default: home]
    ///
    /// A number without a unit is in the spec's length unit for a prismatic joint and in rad for a
    /// revolute joint.
    #[arg(long, value_name = "V,V,…", allow_hyphen_values = true)]
    pub(crate) q: Option<String>,
    /// Print the report as JSON
    #[arg(long, display_order = 111)]
    pub(crate) json: bool,
}
