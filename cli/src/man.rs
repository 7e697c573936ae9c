//! `abbe man`: manual pages, one for `abbe` and one for each command.

use std::{io, path::PathBuf};

use clap::{Args, Command};

use crate::Result;
use crate::arguments::Writing;
use crate::output::{Outcome, Outputs, cannot_write, note};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe man --out man1
"))]
pub(crate) struct Man {
    /// Write the manual pages into this folder: abbe.1 and one page per command
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    writing: Writing,
}

pub(crate) fn run(arguments: &Man, command: Command) -> Result<Outcome> {
    let folder = &arguments.out;
    let pages = pages(command).map_err(|error| cannot_write(folder, &error))?;
    let mut outputs = Outputs::new(&(), arguments.writing.force);
    outputs.folder(folder)?;
    outputs.write(pages.iter().map(|(name, text)| (folder.join(name), text)))?;
    note(&format!("wrote {}: {} pages", folder.display(), pages.len()));
    Ok(Outcome::passed(String::new()))
}

/// Returns the name and the text of each page.
fn pages(command: Command) -> io::Result<Vec<(String, String)>> {
    let mut command = command.disable_help_subcommand(true);
    command.build();
    let commands = command.get_subcommands().cloned();
    let page = |command| {
        let (page, mut text) = (clap_mangen::Man::new(command), Vec::new());
        page.render(&mut text)?;
        let text = String::from_utf8_lossy(&text);
        // The text after the options has headings of its own.
        let text = text.replace(".SH EXTRA\nExamples:\n", ".SH EXAMPLES\n");
        Ok((page.get_filename(), text.replace("\nExit status:\n", "\n.SH \"EXIT STATUS\"\n")))
    };
    [command.clone()].into_iter().chain(commands).map(page).collect()
}
