//! Files of generated code.

/// A file of generated code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// Its name: that of the manipulator, and an extension; in an archive with its folder.
    pub name: String,
    /// What stands in it.
    pub text: String,
}
