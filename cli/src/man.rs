//! `abbe man`: manual pages, one for `abbe` and one for each command.

use std::io;

use clap::CommandFactory;
use clap_mangen::Man;

use crate::arguments::{self, Arguments};
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, cannot_write, note};

pub(crate) fn run(arguments: &arguments::Man) -> Result<Outcome, Failure> {
    let folder = &arguments.out;
    let pages = pages().map_err(|error| cannot_write(folder, &error))?;
    let mut outputs = Outputs::new(&(), arguments.writing.force);
    outputs.folder(folder)?;
    let files = pages.iter().map(|(name, text)| outputs.file(&folder.join(name))?.fill(text));
    let files = files.collect::<Result<Vec<_>, _>>()?;
    outputs.finish(files)?;
    note(&format!("wrote {}: {} pages", folder.display(), pages.len()));
    Ok(Outcome::passed(String::new()))
}

/// Returns the name and the text of each page.
fn pages() -> io::Result<Vec<(String, String)>> {
    let mut command = Arguments::command().disable_help_subcommand(true);
    command.build();
    let commands = command.get_subcommands().cloned();
    let page = |command| {
        let (page, mut text) = (Man::new(command), Vec::new());
        page.render(&mut text)?;
        let text = String::from_utf8_lossy(&text);
        // The text after the options has headings of its own.
        let text = text.replace(".SH EXTRA\nExamples:\n", ".SH EXAMPLES\n");
        Ok((page.get_filename(), text.replace("\nExit status:\n", "\n.SH \"EXIT STATUS\"\n")))
    };
    [command.clone()].into_iter().chain(commands).map(page).collect()
}
