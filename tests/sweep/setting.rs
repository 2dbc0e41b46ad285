//! Keys of a scene that are set on the command line.

use super::Bench;

#[test]
fn mistakes_of_what_is_set_have_remedies_that_help() {
    let bench = Bench::new("");
    let check = |set: &str, code: i32| bench.ran(&["check", "scene.toml", "--set", set], code).1;
    for (wrong, code, part, right) in [
        ("time.end", 2, "write KEY=VALUE", "time.end=2.0"),
        ("model=kes", 2, "model=\"kes\"", "model=\"kes\""),
        ("panel[1].rectangle=[1, 1]", 3, "numbers 0 to 0", "panel[0].rectangle=[0.1, 0.1]"),
        ("time.end.x=1", 3, "set time.end itself", "time.end=1"),
        (
            "time.finish=1",
            3,
            "time.finish: there is no such key (set on the command line: time.finish=1)",
            "time.end=1",
        ),
        (
            "time.step=\"long\"",
            3,
            "(set on the command line: time.step=\"long\")",
            "time.step=0.01",
        ),
        ("time.step=-1", 3, "(set on the command line: time.step=-1)", "time.step=\"10 ms\""),
    ] {
        let messages = check(wrong, code);
        assert!(messages.contains(part), "{wrong}: {messages}");
        check(right, 0);
    }
    // What is not set keeps its line.
    let text = std::fs::read_to_string(bench.path("scene.toml")).unwrap();
    std::fs::write(bench.path("scene.toml"), text.replace("turn = ", "turned = ")).unwrap();
    let messages = check("name=\"new\"", 3);
    assert!(messages.contains("scene.toml:9:"), "{messages}");
}

#[test]
fn sheets_and_fabrics_have_what_is_set() {
    let bench = Bench::new("");
    bench.copy_sheet("matsudaira-a");
    let fit = |set: &str, code: i32| {
        let arguments = ["fit", "matsudaira-a", "-o", "f.toml", "--force", "--set", set];
        bench.ran(&arguments, code).1
    };
    fit("W=\"150 g/m2\"", 0);
    let fabric = std::fs::read_to_string(bench.path("f.toml")).unwrap();
    assert!(fabric.contains("density = 0.15\n"), "{fabric}");
    let messages = fit("warp.B=-1", 3);
    assert!(messages.contains("set on the command line: warp.B=-1"), "{messages}");
    let test = |set: &str, code: i32| {
        bench.ran(&["test", "f.toml", "--spacing", "10", "--json", "--set", set], code)
    };
    let (stiff, soft) = (test("shear.stiffness=60", 0).0, test("shear.stiffness=30", 0).0);
    assert_ne!(stiff, soft);
    let messages = test("shear.stiffnes=60", 3).1;
    assert!(messages.contains("did you mean `stiffness`?"), "{messages}");
}

#[test]
fn a_resumed_run_has_what_was_set_and_refuses_other_values() {
    let bench = Bench::new("");
    let long = ["--set", "time.end=3.0", "--set", "spacing=0.005", "--no-picture"];
    let run =
        |more: &[&str], code| bench.ran(&[&["run", "scene.toml"], more, &long].concat(), code);
    run(&["-o", "whole"], 0);
    run(&["-o", "part", "--max-disk", "0.001"], 8);
    let request = bench.path("part/run.json");
    let text = std::fs::read_to_string(&request).unwrap();
    assert!(text.contains("time.end=3.0"), "{text}");
    std::fs::write(&request, text.replace("time.end=3.0", "time.end=2.0")).unwrap();
    let (_, messages) = bench.ran(&["resume", "part", "--no-picture"], 3);
    assert!(messages.contains("has changed: the scene"), "{messages}");
    // The remedy is to undo the change.
    std::fs::write(&request, text).unwrap();
    bench.ran(&["resume", "part", "--no-picture"], 0);
    let hash = |folder: &str| {
        let text = std::fs::read(bench.path(folder).join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_slice(&text).unwrap();
        assert_eq!(summary["simulated_seconds"].as_f64(), Some(3.0));
        summary["state_hash"].as_str().unwrap().to_owned()
    };
    assert_eq!(hash("whole"), hash("part"));
}
