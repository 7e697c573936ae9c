//! Frames that are named by a tree or a loop: `parent`, and the `frames` of a loop.

use crate::diagnostic::{Diagnostic, Span};
use crate::document::Item;
use crate::value::find_name;

/// Name of `F_0` where a frame is named.
pub(super) const BASE: &str = "base";

/// Name of a frame and its location.
pub(super) type Named<'a> = (&'a str, Span);

/// Returns the index of the frame that frame `own` hangs on by its `parent`; `None` for the base,
/// and after a mistake.
pub(super) fn read_parent(item: &Item<'_>, own: usize, frames: &[Named<'_>]) -> Option<usize> {
    let parent = frame_or_base(item, frames).flatten()?;
    if parent < own {
        return Some(parent);
    }
    let (name, declared) = &frames[parent];
    item.document.fail(if parent == own {
        Diagnostic::new(item.span(), format!("the frame \"{name}\" cannot hang on itself"))
            .label("its own name")
            .help("name an earlier frame, or \"base\" for F_0")
    } else {
        Diagnostic::new(item.span(), format!("the frame \"{name}\" is declared later"))
            .label("a frame hangs on an earlier one")
            .context(declared.clone(), "declared here")
            .help(format!("move the [[frame]] \"{name}\" before this one; close loops by a [[loop]]"))
    })
}

/// Returns the index of the frame with the name that an item holds; `Some(None)` for the base.
pub(super) fn frame_or_base(item: &Item<'_>, frames: &[Named<'_>]) -> Option<Option<usize>> {
    let name = item.string()?;
    let found = frames.iter().position(|(frame, _)| *frame == name);
    match found {
        Some(frame) if name == BASE => item.document.fail(
            Diagnostic::new(item.span(), "\"base\" is F_0, and also the name of a frame")
                .label("either of them")
                .context(frames[frame].1.clone(), "the frame")
                .help("rename the frame"),
        ),
        Some(_) => Some(found),
        None if name == BASE => Some(None),
        None => {
            let known: Vec<&str> = frames.iter().map(|(name, _)| *name).chain([BASE]).collect();
            find_name(item.document, item.span(), &name, &known, "frame")?;
            None
        }
    }
}
