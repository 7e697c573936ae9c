//! What stands below the options: examples, which tests run in the order of the commands, and the exit status.

/// The examples of a command, and when its exit status is 1.
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
