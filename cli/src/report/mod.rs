//! The pictures and the report of an analysis: SVG files, and one HTML file that needs no network.
//!
//! `data` gathers what the figures show while the sweep goes on; `axis` says how numbers are shown; `svg` draws
//! the figures one by one; `html` writes the report, with the same figures to rotate and to point at.

mod axis;
mod data;
mod figure;
mod files;
mod html;
mod pictures;
mod shares;
mod spheres;
mod stick;
mod subject;
mod svg;

pub(crate) use axis::{BAR, INK, XYZ, css};
pub(crate) use html::{document, escaped, section, style};
pub(crate) use pictures::Pictures;
pub(crate) use subject::{Compared, Subject};
