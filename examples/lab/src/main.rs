//! The `moment-shadows` command.

fn main() {}
