//! Pages of `drape validate`.

use assert_cmd::Command;

#[test]
fn a_case_leaves_its_figures_and_plots() {
    let folder = tempfile::tempdir().expect("a folder");
    let (pages, markdown) = (folder.path().join("pages"), folder.path().join("page.md"));
    let mut command = Command::cargo_bin("drape").expect("it is built");
    command.args(["validate", "hysteresis", "--report"]).arg(&pages);
    let output = command.arg("--markdown").arg(&markdown).assert().success();
    let told = String::from_utf8_lossy(&output.get_output().stdout).into_owned();
    assert!(told.contains("curvature kept after bending"), "{told}");
    let page = std::fs::read_to_string(pages.join("validation.html")).expect("a page");
    assert!(page.contains("1 of 1 cases are within their limits; 4 figures"));
    assert_eq!(page.matches("<svg class=\"plot graph\"").count(), 2);
    for number in 1..=2 {
        let plot = std::fs::read_to_string(pages.join(format!("hysteresis-{number}.svg")));
        let plot = plot.expect("a plot");
        assert!(plot.contains("class=\"line tone0\"") && plot.contains("class=\"line exact\""));
    }
    let markdown = std::fs::read_to_string(markdown).expect("a page");
    let rows = markdown.lines().filter(|line| line.ends_with("| pass |"));
    assert_eq!(rows.count(), 4, "{markdown}");
    assert!(markdown.contains("## What this does not show\n\n* "), "{markdown}");
    // Both list the same limits.
    let limits = markdown.lines().filter(|line| line.starts_with("* ")).count();
    let listed = page.split("id=\"limits\"").nth(1).expect("limits").matches("<li>").count();
    assert_eq!(limits, listed);
}

#[test]
fn outcomes_of_an_earlier_run_are_shown_with_those_of_this_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let (json, markdown) = (folder.path().join("earlier.json"), folder.path().join("page.md"));
    let validate = |case: &str| {
        let mut command = Command::cargo_bin("drape").expect("it is built");
        command.args(["validate", case]);
        command
    };
    let outcome = r#"[{"name": "grid-wool", "title": "Wool", "failure": null, "seconds": 1.0, "checks": [{
        "what": "of another day", "measured": 1.5, "reference": null, "limit": 0.0, "kind": "told"}]}]"#;
    std::fs::write(&json, outcome).expect("it is written");
    let mut command = validate("hysteresis");
    let told = command.arg("--earlier").arg(&json).arg("--markdown").arg(&markdown);
    told.assert().success();
    let page = std::fs::read_to_string(markdown).expect("a page");
    let place = |case: &str| page.find(&format!("`drape validate {case}`")).expect(case);
    assert!(place("hysteresis") < place("grid-wool"), "in the order of the suite");
    assert!(page.contains("| of another day | 1.500 | | | none |  |"), "{page}");
    std::fs::write(&json, "[{\"name\": \"no-such-case\"}]").expect("it is written");
    let output = validate("hysteresis").arg("--earlier").arg(&json).assert().code(3);
    let message = String::from_utf8_lossy(&output.get_output().stderr).into_owned();
    assert!(message.contains("earlier.json") && message.contains("line 1"), "{message}");
}

#[test]
fn an_unknown_case_is_named_with_the_known_ones() {
    let mut command = Command::cargo_bin("drape").expect("it is built");
    let output = command.args(["validate", "no-such-case"]).assert().code(2);
    let message = String::from_utf8_lossy(&output.get_output().stderr).into_owned();
    assert!(message.contains("no-such-case") && message.contains("catenary"), "{message}");
}
