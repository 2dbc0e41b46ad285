//! Signals to a program, and programs that hear them.

use std::process::Command;

/// Returns `command` for a program that hears all signals, without the standard streams of
/// `command`. A shell starts its background programs with `SIGINT` ignored, and drape leaves such a
/// signal ignored.
pub fn hearing(command: &Command) -> Command {
    let mut hearing = Command::new("env");
    hearing.arg("--default-signal=INT,TERM,HUP,XCPU,USR1");
    hearing.arg(command.get_program()).args(command.get_args());
    if let Some(folder) = command.get_current_dir() {
        hearing.current_dir(folder);
    }
    hearing
}

/// Sends `signal`, such as `-INT`, to the process with the number `process`, unless it has ended.
pub fn send(process: u32, signal: &str) {
    let _ = Command::new("kill").args([signal, &process.to_string()]).output();
}
