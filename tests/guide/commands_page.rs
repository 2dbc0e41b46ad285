//! Page of all commands, as their help tells them.

use assert_cmd::Command;

use crate::keys_page::GENERATED;

/// Heading of the options that every command has.
const SHARED: &str = "Options of every command:";

/// Returns the page.
pub fn page() -> String {
    let whole = help(&[]);
    let (list, options) = whole.split_once(SHARED).expect("the help has the shared options");
    let (options, codes) = options.split_once("Exit codes:").expect("the help has the exit codes");
    let mut page = format!(
        "{GENERATED}\n\n# Commands\n\nThe help of the program, word for word: `drape --help`, `drape help COMMAND`.\n\n\
         ```text\n{}\n```\n\n## Options of every command\n\n```text\n{}\n```\n\n\
         ## Exit codes\n\n```text\n{}\n```\n",
        list.trim_end(),
        options.trim_matches('\n'),
        codes.trim_matches('\n').trim_end(),
    );
    for command in names(list) {
        section(&mut page, &[&command]);
    }
    page
}

/// Adds the sections of a command and of its commands.
fn section(page: &mut String, command: &[&str]) {
    let help = help(command);
    let own = help.split(SHARED).next().unwrap_or_default().trim_end();
    page.push_str(&format!("\n## drape {}\n\n```text\n{own}\n```\n", command.join(" ")));
    for inner in names(own) {
        section(page, &[command, &[&inner]].concat());
    }
}

/// Returns the names of the commands that a help lists.
fn names(help: &str) -> Vec<String> {
    let list = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let list = list.take_while(|line| !line.is_empty());
    // A description that is longer than its line goes on further to the right.
    let names = list.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names = names.filter_map(|line| line.split_whitespace().next().map(str::to_owned));
    names.filter(|name| name != "help").collect()
}

/// Returns the long help of a command, at the width that it has where no terminal is.
fn help(command: &[&str]) -> String {
    let mut drape = Command::cargo_bin("drape").expect("the binary is built");
    let drape = drape.env_remove("COLUMNS").env("NO_COLOR", "1").args(command).arg("--help");
    let output = drape.output().expect("it runs");
    assert!(output.status.success(), "{command:?}");
    let help = String::from_utf8(output.stdout).expect("the help is UTF-8");
    help.lines().map(str::trim_end).collect::<Vec<_>>().join("\n")
}
