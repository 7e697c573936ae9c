//! Files of generated code.

/// A file of generated code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// File name: the manipulator's name and an extension; in an archive including the folder.
    pub name: String,
    /// Contents of the file.
    pub text: String,
}
