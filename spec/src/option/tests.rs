//! Tests of `option.rs`.

use super::*;

#[test]
fn options_are_worded_for_both_front_ends() {
    for (named, command, python) in [
        (ENABLE, "--enable", "enable"),
        (READING_UNCERTAINTY, "--reading-uncertainty", "reading_uncertainty"),
        (ROUND_ANGLES, "--round-angles", "round_angles=True"),
        (SET, "--set", "with_parameters"),
        (SET_X, "--set x=250mm", "with_parameters(x=\"250mm\")"),
        (DH_STANDARD, "--dh standard", "convention=\"standard\""),
        (DISABLE_NAME, "--disable NAME", "disable(NAME)"),
        (STATION_NEW, "--station new", "new_station=True"),
        (SHARD_NUMBER, "--shard I/N", "shard=(I, N)"),
        (option("nodes", 40), "--nodes 40", "nodes=40"),
        (TIP_LINK, "--tip LINK", "tip=LINK"),
    ] {
        assert_eq!(named.to_string(), command);
        assert_eq!(in_python(named.name, named.value.as_deref()), python);
    }
}
