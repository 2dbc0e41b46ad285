//! Studies of fits and of tests, and machines on which nothing runs.

use std::path::Path;

use super::Bench;

impl Bench {
    /// Writes a study without the base that others have.
    fn write_whole(&self, study: &str) {
        std::fs::write(self.path("study.toml"), format!("output = \"results\"\n{study}")).unwrap();
    }

    fn point(&self, index: usize) -> std::path::PathBuf {
        let key = &self.keys()[index];
        self.path("results/points").join(&key[..2]).join(key)
    }

    /// Copies a sheet with its curves.
    pub(crate) fn copy_sheet(&self, name: &str) {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fabrics").join(name);
        std::fs::create_dir(self.path(name)).unwrap();
        for file in std::fs::read_dir(folder).unwrap().map(Result::unwrap) {
            if file.path().is_file() {
                std::fs::copy(file.path(), self.path(name).join(file.file_name())).unwrap();
            }
        }
    }
}

#[test]
fn fits_of_a_study_are_those_of_the_command() {
    let bench = Bench::new("");
    ["matsudaira-a", "cupro-weave"].iter().for_each(|name| bench.copy_sheet(name));
    bench.write_whole(
        "fit = \"matsudaira-a/sheet.toml\"\noptions = [\"--shear\", \"two-elements\"]\nkeep = \"last\"\n\
         [[axis]]\nname = \"sheet\"\nkey = \"fit\"\nfiles = \"*/sheet.toml\"\n\
         [[axis]]\nkey = \"W\"\nvalues = [11, 13]\n",
    );
    let (said, messages) = bench.sweep("2");
    assert!(said.contains("4 points: 4 run, 0 done before"), "{said}{messages}");
    let rows = bench.table();
    let inputs = rows.iter().map(|row| format!("{} {}", row["sheet"], row["W"]));
    let [cupro, cotton] = ["cupro-weave/sheet.toml", "matsudaira-a/sheet.toml"];
    let expected = [cupro, cotton].map(|sheet| [11, 13].map(|w| format!("{sheet} {w}"))).concat();
    assert_eq!(inputs.collect::<Vec<_>>(), expected);
    assert!(rows.iter().all(|row| row["outcome"] == "ok"));
    for (index, sheet) in ["cupro-weave", "matsudaira-a"].iter().enumerate() {
        let fit = ["fit", sheet, "--shear", "two-elements", "--set", "W=13", "-o", "alone.toml"];
        bench.ran(&[&fit[..], &["--force"]].concat(), 0);
        let alone = std::fs::read_to_string(bench.path("alone.toml")).unwrap();
        let row = 2 * index + 1;
        let own = std::fs::read_to_string(bench.point(row).join("fabric.toml")).unwrap();
        assert_eq!(own, alone);
        let density = &rows[row]["measures.quantities.mass per area.value"];
        assert!((density.parse::<f64>().unwrap() - 0.13).abs() < 1e-12, "{density}");
    }
    let stiffness = "measures.laws.stretch 8 cm, warp.parameters.k_e.value";
    assert!(rows[0][stiffness].parse::<f64>().unwrap() > 1000.0);
    assert!(bench.sweep("2").0.contains("4 points: 0 run, 4 done before"));
}

#[test]
fn tests_of_a_study_are_those_of_the_command() {
    let bench = Bench::new("");
    bench.write_whole(
        "test = \"plain.toml\"\noptions = [\"--spacing\", \"10\"]\nkeep = \"measures\"\n\
         [[axis]]\nkey = \"shear.stiffness\"\nvalues = [30, 40]\n\
         [[measure]]\nkey = \"measures.shear.warp.values.G.simulated\"\nname = \"G\"\n",
    );
    bench.sweep("2");
    let rows = bench.table();
    let set = ["test", "plain.toml", "--spacing", "10", "--json", "--set", "shear.stiffness=40"];
    let (said, _) = bench.ran(&set, 0);
    let loops: serde_json::Value = serde_json::from_str(&said).unwrap();
    let mut values = loops.as_array().unwrap().iter().flat_map(|own| {
        let is_own = own["test"] == "shear" && own["direction"] == "warp";
        own["values"].as_array().unwrap().iter().filter(move |_| is_own)
    });
    let value = values.find(|value| value["symbol"] == "G").unwrap()["simulated"].as_f64();
    assert_eq!(rows[1]["G"].parse::<f64>().ok(), value);
    let ratio = rows[1]["G"].parse::<f64>().unwrap() / rows[0]["G"].parse::<f64>().unwrap();
    assert!((ratio - 4.0 / 3.0).abs() < 0.05, "{ratio}");
}

#[test]
fn mistakes_of_bases_have_remedies_that_help() {
    let axis = "[[axis]]\nkey = \"density\"\nvalues = [0.1, 0.2]\n";
    let bench = Bench::new("");
    for (wrong, part, right) in [
        ("", "such as scene = \"scene.toml\"", "test = \"plain.toml\""),
        (
            "test = \"plain.toml\"\nfit = \"plain.toml\"",
            "name one of scene, fit and test",
            "test = \"plain.toml\"",
        ),
        (
            "test = \"plain.toml\"\noptions = [\"--dripe\"]",
            "--spacing, --drape",
            "test = \"plain.toml\"\noptions = [\"--drape\", \"--starts=2\"]",
        ),
        (
            "scene = \"scene.toml\"\noptions = [\"--until\", \"1\"]",
            "set keys of the scene",
            "scene = \"scene.toml\"\nset = { time.end = 1.0 }",
        ),
        (
            "test = \"plain.toml\"\naxis = [{ key = \"test\", values = [\"plain.toml\"] }]",
            "give its levels as files",
            "test = \"plain.toml\"\naxis = [{ key = \"test\", files = [\"plain.toml\"] }]",
        ),
    ] {
        let is_scene = wrong.starts_with("scene");
        let own = if is_scene { axis.replace("density", "spacing") } else { axis.to_owned() };
        let end = |text: &str| if text.contains("axis =") { String::new() } else { own.clone() };
        bench.write_whole(&format!("{wrong}\n{}", end(wrong)));
        let (_, messages) = bench.ran(&["sweep", "plan", "study.toml"], 3);
        assert!(messages.contains(part), "{wrong}: {messages}");
        bench.write_whole(&format!("{right}\n{}", end(right)));
        bench.ran(&["sweep", "plan", "study.toml"], 0);
    }
}

#[test]
fn a_base_elsewhere_is_allowed_first() {
    let bench = Bench::new("");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fabrics");
    bench.write_whole(&format!(
        "test = \"plain.toml\"\n[[axis]]\nkey = \"test\"\nfiles = {:?}\n",
        folder.join("plain-*.toml")
    ));
    let plan = ["sweep", "plan", "study.toml"];
    let (_, messages) = bench.ran(&plan, 3);
    let option = messages.split_once("--allow-path ").unwrap().1.split_whitespace().next();
    bench.ran(&[&plan[..], &["--allow-path", option.unwrap()]].concat(), 0);
}

#[test]
fn a_machine_on_which_nothing_runs_ends_the_sweep_and_fails_few_points() {
    let bench = Bench::new("[[axis]]\nkey = \"panel.0.noise.seed\"\nstarts = 8\n");
    // Files where folders must be: no run can write its results.
    let folders: Vec<_> = (0..8).map(|index| bench.point(index)).collect();
    for folder in &folders {
        std::fs::create_dir_all(folder.parent().unwrap()).unwrap();
        std::fs::write(folder, "").unwrap();
    }
    let (_, messages) = bench.ran(&["sweep", "run", "study.toml", "--jobs", "1"], 6);
    assert!(messages.contains("and the rest is left"), "{messages}");
    let count =
        |outcome: &str| bench.table().iter().filter(|row| row["outcome"] == outcome).count();
    assert_eq!([count("worker failed"), count("not run")], [3, 5]);
    // Points that were not tried come first: they are run though the bad ones are still bad.
    folders[3..].iter().for_each(|folder| std::fs::remove_file(folder).unwrap());
    bench.ran(&["sweep", "run", "study.toml", "--jobs", "1"], 6);
    assert_eq!([count("worker failed"), count("ok")], [3, 5]);
    folders[..3].iter().for_each(|folder| std::fs::remove_file(folder).unwrap());
    assert!(bench.sweep("1").0.contains("8 points: 3 run, 5 done before"));
}

#[test]
fn results_are_in_the_folder_that_the_command_names() {
    let bench = Bench::new("[[axis]]\nkey = \"panel.0.noise.seed\"\nstarts = 2\n");
    for command in ["plan", "run", "collect"] {
        bench.ran(&["sweep", command, "study.toml", "--results", "elsewhere"], 0);
    }
    assert!(!bench.path("results").exists());
    for file in ["manifest.jsonl", "points", "table.csv", "index.html"] {
        assert!(bench.path("elsewhere").join(file).exists(), "{file}");
    }
    let (text, _) = bench
        .ran(&["sweep", "export", "study.toml", "--slurm", "--results", "elsewhere", "-o", "-"], 0);
    assert!(text.contains("--results ") && text.contains("/elsewhere --shard"), "{text}");
}
