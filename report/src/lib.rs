//! Pictures and pages of what `abbe-study` reports: SVG files, and HTML files that need no network.
//!
//! Everything comes back as texts with the names of their files; nothing here writes.
