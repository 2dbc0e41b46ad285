//! The `drape` command.
fn main() {}
