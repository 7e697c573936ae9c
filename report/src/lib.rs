//! Pictures and pages of what `abbe-study` reports: SVG files, and HTML files that need no network.
//!
//! Everything comes back as texts with the names of their files; nothing here writes. [`analysis`] is the report of an
//! analysis: `axis` says how its numbers are shown, `svg` draws the figures one by one, `html` writes the page, with the
//! same figures to rotate and to point at; [`figures`] gives them one by one. [`measurement()`], [`identification()`],
//! [`compensation()`] and [`monitoring()`] are the pages about measurements. [`text`] is what a terminal shows.

mod axis;
mod figure;
mod html;
mod pictures;
mod shares;
mod spheres;
mod svg;
pub mod text;

pub use html::{Provenance, compensation, identification, listed, measurement, monitoring};
pub use pictures::{File, PAGE, Picture, analysis, figures};
