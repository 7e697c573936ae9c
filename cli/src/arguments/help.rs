//! Text below the options of each help: examples, which a test runs in the order of the commands,
//! and the exit status.

/// Formats the examples of a command and, optionally, the meaning of exit status 1.
macro_rules! after_help {
    ($examples:literal) => {
        concat!(
            "Examples:\n",
            $examples,
            "\nExit status:\n  0        done\n  2        wrong usage or input\n  128 + n  ended by signal n"
        )
    };
    ($examples:literal, $failed:literal) => {
        concat!(
            "Examples:\n",
            $examples,
            "\nExit status:\n  0        done\n  1        ",
            $failed,
            "\n  2        wrong usage or input\n  128 + n  ended by signal n"
        )
    };
}
