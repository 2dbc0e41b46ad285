//! Studies: every point is run once, whatever is killed, and the table is that of a serial run.

#![cfg(unix)]
#![allow(clippy::unwrap_used)]

mod base;
mod converge;
mod setting;
#[path = "../command_line/signals.rs"]
mod signals;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Scene of a strip that takes some milliseconds.
const SCENE: &str = include_str!("strip.toml");

/// Columns that hold times and what differs with them.
const TIMES: [&str; 5] = ["seconds", "wall_seconds", "cpu_seconds", "threads", "retries"];

/// Folder with a scene, its fabric and a study.
struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new(study: &str) -> Self {
        let bench = Self { folder: tempfile::tempdir().unwrap() };
        let fabric = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fabrics/plain-weave.toml");
        std::fs::copy(fabric, bench.path("plain.toml")).unwrap();
        std::fs::write(bench.path("scene.toml"), SCENE).unwrap();
        bench.write(study);
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, study: &str) {
        let text = format!("scene = \"scene.toml\"\noutput = \"results\"\n{study}");
        std::fs::write(self.path("study.toml"), text).unwrap();
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drape"));
        command.current_dir(self.folder.path()).args(arguments).args(["--threads", "2"]);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    /// Runs a command to an exit code; returns what it says and its messages.
    fn ran(&self, arguments: &[&str], code: i32) -> (String, String) {
        let Output { status, stdout, stderr } = self.command(arguments).output().unwrap();
        let [out, messages] = [stdout, stderr].map(|text| String::from_utf8(text).unwrap());
        assert_eq!(status.code(), Some(code), "{arguments:?}: {out}{messages}");
        (out, messages)
    }

    fn sweep(&self, jobs: &str) -> (String, String) {
        self.ran(&["sweep", "run", "study.toml", "--jobs", jobs], 0)
    }

    fn begin(&self) -> Child {
        let mut hearing =
            signals::hearing(&self.command(&["sweep", "run", "study.toml", "--jobs", "2"]));
        hearing.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
    }

    /// Returns the rows of the table without times.
    fn table(&self) -> Vec<BTreeMap<String, String>> {
        self.ran(&["sweep", "collect", "study.toml"], 0);
        let mut rows = self.rows();
        rows.iter_mut().for_each(|row| row.retain(|name, _| !TIMES.contains(&&name[..])));
        rows
    }

    fn rows(&self) -> Vec<BTreeMap<String, String>> {
        let text = std::fs::read_to_string(self.path("results/table.csv")).unwrap();
        let mut csv = csv::Reader::from_reader(text.as_bytes());
        csv.deserialize().map(|row| row.unwrap()).collect()
    }

    /// Returns the keys of the points, in their order.
    fn keys(&self) -> Vec<String> {
        self.ran(&["sweep", "plan", "study.toml"], 0);
        let text = std::fs::read_to_string(self.path("results/manifest.jsonl")).unwrap();
        let point = |line: &str| serde_json::from_str::<serde_json::Value>(line).unwrap();
        text.lines().map(|line| point(line)["key"].as_str().unwrap().to_owned()).collect()
    }
}

/// Returns the processes that a process has started.
fn children(parent: u32) -> Vec<u32> {
    let found = Command::new("ps").args(["-o", "pid=", "--ppid", &parent.to_string()]).output();
    let text = String::from_utf8(found.unwrap().stdout).unwrap();
    text.split_whitespace().filter_map(|number| number.parse().ok()).collect()
}

const GRID: &str = "[[axis]]\nkey = \"panel.0.rectangle.1\"\nrange = { start = 0.08, end = 0.12, count = 3 }\n\
     [[axis]]\nkey = \"panel.0.noise.seed\"\nstarts = 2\n";

#[test]
fn every_point_has_its_row_and_is_run_once() {
    let bench = Bench::new(GRID);
    let (said, _) = bench.sweep("2");
    assert!(said.contains("6 points: 6 run, 0 done before"), "{said}");
    let (said, _) = bench.sweep("2");
    assert!(said.contains("6 points: 0 run, 6 done before"), "{said}");
    let rows = bench.table();
    let inputs = |row: &BTreeMap<String, String>| {
        [&row["panel.0.rectangle.1"], &row["panel.0.noise.seed"]].map(Clone::clone)
    };
    let expected = ["0.08 1", "0.08 2", "0.1 1", "0.1 2", "0.12 1", "0.12 2"];
    let found: Vec<String> = rows.iter().map(|row| inputs(row).join(" ")).collect();
    assert_eq!(found, expected);
    assert!(rows.iter().all(|row| row["outcome"] == "ok" && row["status"] == "ok"));
    assert_eq!(rows.iter().map(|row| row["key"].clone()).collect::<Vec<_>>(), bench.keys());
    let page = std::fs::read_to_string(bench.path("results/index.html")).unwrap();
    assert!(page.contains("6 of 6 points ended well"));
    assert!(page.contains("Means over panel.0.rectangle.1<"));
    // Starts are chance: they have no effects, and are the scatter of the others.
    assert!(!page.contains("Means over panel.0.noise.seed"));
    assert!(page.matches('±').count() > 3, "{page}");
    // The same points by values that mean something have both effects.
    bench.write(&GRID.replace("starts = 2", "values = [1, 2]"));
    assert_eq!(bench.table(), rows);
    let page = std::fs::read_to_string(bench.path("results/index.html")).unwrap();
    assert!(page.contains("Means over panel.0.rectangle.1 and panel.0.noise.seed"));
    // A run of its own has the same measures.
    let set = ["--set", "panel.0.rectangle.1=0.12", "--set", "panel.0.noise.seed=2"];
    let alone = ["run", "scene.toml", "-o", "alone", "--no-picture"];
    bench.ran(&[&alone[..], &set].concat(), 0);
    let text = std::fs::read_to_string(bench.path("alone/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(summary["state_hash"].as_str(), Some(&rows[5]["state_hash"][..]));
}

#[test]
fn shards_and_keys_choose_points() {
    let bench = Bench::new(GRID);
    for (shard, count) in [("1/4", 2), ("2/4", 2), ("3/4", 1), ("4/4", 1)] {
        let (said, _) = bench.ran(&["sweep", "run", "study.toml", "--shard", shard], 0);
        let points = if count == 1 { "point" } else { "points" };
        assert!(said.contains(&format!("{count} {points}: {count} run")), "{said}");
    }
    let key = bench.keys()[4].clone();
    let (said, _) = bench.ran(&["sweep", "run", "study.toml", "--point", &key[..12]], 0);
    assert!(said.contains("1 point: 0 run, 1 done before"), "{said}");
    let (_, messages) = bench.ran(&["sweep", "run", "study.toml", "--point", "xyz"], 2);
    assert!(messages.contains("drape sweep run study.toml --list"), "{messages}");
    let (list, _) = bench.ran(&["sweep", "run", "study.toml", "--list"], 0);
    assert_eq!(list.lines().filter(|line| line.contains("\tok\t")).count(), 6, "{list}");
    // Tables of the parts make the table of all points, unless they are of another study.
    bench.ran(&["sweep", "collect", "study.toml"], 0);
    let whole = bench.rows();
    for shard in ["1/2", "2/2"] {
        bench.ran(&["sweep", "collect", "study.toml", "--shard", shard], 0);
    }
    std::fs::remove_file(bench.path("results/table.csv")).unwrap();
    bench.ran(&["sweep", "collect", "study.toml", "--join"], 0);
    assert_eq!(bench.rows(), whole);
    bench.write("[[axis]]\nkey = \"time.end\"\nvalues = [0.02]\n");
    let (_, messages) = bench.ran(&["sweep", "collect", "study.toml", "--join"], 6);
    assert!(messages.contains("collect its shards anew"), "{messages}");
}

#[test]
fn a_bad_point_is_recorded_and_does_not_stop_the_rest() {
    let bench = Bench::new("[[axis]]\nkey = \"time.step\"\nvalues = [0.005, -1, 0.01]\n");
    let (said, messages) = bench.sweep("1");
    assert!(said.contains("3 points: 2 run, 0 done before, 1 refused or failed"), "{said}");
    assert!(messages.contains("set on the command line: time.step=-1"), "{messages}");
    let rows = bench.table();
    assert_eq!(rows[1]["outcome"], "refused");
    assert_eq!(rows[1]["exit_code"], "3");
    assert!(rows[1]["message"].contains("time.step"), "{}", rows[1]["message"]);
    // It is not tried again.
    let (said, messages) = bench.sweep("1");
    assert!(said.contains("0 run, 2 done before, 1 refused"), "{said}");
    assert_eq!(messages, "");
}

#[test]
fn what_is_kept_is_what_the_study_says() {
    for (keep, files) in [("measures", vec![]), ("last", vec!["last.obj", "summary.json"])] {
        let bench = Bench::new(&format!(
            "keep = \"{keep}\"\n[[axis]]\nkey = \"time.end\"\nvalues = [0.02]\n"
        ));
        bench.sweep("1");
        let key = &bench.keys()[0];
        let folder = bench.path("results/points").join(&key[..2]).join(key);
        // Of measures alone there is no folder: the record has them.
        let entries = std::fs::read_dir(&folder).into_iter().flatten();
        let mut found: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        assert_eq!(folder.is_dir(), keep == "last");
        found.sort();
        assert_eq!(found, files);
        assert_eq!(bench.table()[0]["outcome"], "ok");
        assert!(bench.sweep("1").0.contains("1 done before"));
    }
}

/// Runs that take a tenth of a second each, or more.
const LONG: &str = "[[axis]]\nkey = \"time.end\"\nvalues = [1.5, 1.6, 1.7, 1.8, 1.9, 2.0]\n\
     [[sample]]\nmethod = \"sobol\"\ncount = 2\n\
     [[sample.range]]\nkey = \"panel.0.noise.amplitude\"\nstart = 1e-4\nend = 1e-3\nscale = \"log\"\n";

#[test]
fn a_killed_sweep_goes_on_to_the_table_of_a_serial_one() {
    let serial = Bench::new(LONG);
    let begin = Instant::now();
    serial.sweep("1");
    let length = begin.elapsed();
    let bench = Bench::new(LONG);
    // The sweep itself is killed, and its runs outlive it for a while.
    let mut met = 0;
    for part in [0.05, 0.1, 0.15] {
        let mut sweep = bench.begin();
        std::thread::sleep(length.mul_f64(part));
        met += usize::from(sweep.try_wait().unwrap().is_none());
        signals::send(sweep.id(), "-KILL");
        sweep.wait().unwrap();
    }
    // A run is killed, and tried again.
    let sweep = bench.begin();
    let deadline = Instant::now() + Duration::from_secs(20);
    let mut killed = 0;
    while killed < 2 && Instant::now() < deadline {
        std::thread::sleep(Duration::from_millis(30));
        if let Some(child) = children(sweep.id()).first() {
            signals::send(*child, "-KILL");
            killed += 1;
            std::thread::sleep(Duration::from_millis(100));
        }
    }
    let ended = sweep.wait_with_output().unwrap();
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    assert!(met > 0 && killed == 2, "{met} sweeps and {killed} runs were killed");
    assert_eq!(bench.table(), serial.table());
    let retries: u32 = bench.rows().iter().map(|row| row["retries"].parse::<u32>().unwrap()).sum();
    assert!((1..=2).contains(&retries), "{retries} of 2 killed runs were tried again");
}

#[test]
fn a_run_that_outlives_its_sweep_is_waited_for() {
    let bench = Bench::new("[[axis]]\nkey = \"time.end\"\nvalues = [20.0]\n");
    let mut sweep = bench.begin();
    let run = loop {
        if let Some(run) = children(sweep.id()).first() {
            break *run;
        }
        assert!(sweep.try_wait().unwrap().is_none(), "it had no run");
    };
    // The run may not have come as far as its folder.
    signals::send(run, "-STOP");
    signals::send(sweep.id(), "-KILL");
    sweep.wait().unwrap();
    let sweep = bench.begin();
    std::thread::sleep(Duration::from_secs(1));
    let beside = children(sweep.id());
    signals::send(run, "-CONT");
    let ended = sweep.wait_with_output().unwrap();
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    assert!(beside.is_empty(), "a second run of the point began");
    assert_eq!(bench.table()[0]["outcome"], "ok");
    assert_eq!(bench.rows()[0]["retries"], "0");
}

#[test]
fn an_interrupted_sweep_ends_its_runs_and_goes_on() {
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let bench = Bench::new("[[axis]]\nkey = \"time.end\"\nvalues = [500.0, 600.0]\n");
        let sweep = bench.begin();
        let deadline = Instant::now() + Duration::from_secs(20);
        while children(sweep.id()).len() < 2 && Instant::now() < deadline {
            std::thread::sleep(Duration::from_millis(20));
        }
        std::thread::sleep(Duration::from_millis(400));
        let runs = children(sweep.id());
        assert_eq!(runs.len(), 2);
        signals::send(sweep.id(), signal);
        let ended = sweep.wait_with_output().unwrap();
        let messages = String::from_utf8_lossy(&ended.stderr);
        assert_eq!(ended.status.code(), Some(code), "{messages}");
        assert!(messages.contains("drape sweep run study.toml"), "{messages}");
        assert!(runs.iter().all(|run| !Path::new(&format!("/proc/{run}")).exists()));
        for key in bench.keys() {
            let folder = bench.path("results/points").join(&key[..2]).join(&key);
            let files = std::fs::read_dir(&folder).unwrap();
            let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());
            assert!(names.into_iter().any(|name| name.starts_with("checkpoint-")), "{key}");
            // Its run goes on from there, with the values of the point.
            let resume = ["resume", folder.to_str().unwrap(), "--no-picture", "--max-wall", "0.3"];
            let (_, messages) = bench.ran(&resume, 8);
            assert!(!messages.contains("begins anew"), "{messages}");
        }
        assert!(bench.table().iter().all(|row| row["outcome"] == "not run"));
    }
}

#[test]
fn two_sweeps_at_once_never_run_a_point_twice() {
    let bench = Bench::new(LONG);
    let sweeps = [bench.begin(), bench.begin()];
    let run = sweeps.map(|sweep| {
        let ended = sweep.wait_with_output().unwrap();
        assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
        let said = String::from_utf8(ended.stdout).unwrap();
        let count = said.split_once(" points: ").unwrap().1.split_once(' ').unwrap().0;
        count.parse::<usize>().unwrap()
    });
    assert_eq!(run[0] + run[1], 12, "{run:?}");
    assert!(bench.table().iter().all(|row| row["outcome"] == "ok"));
}

#[test]
fn keys_are_those_of_the_bytes_and_not_of_the_place() {
    let (here, there) = (Bench::new(GRID), Bench::new(GRID));
    let keys = here.keys();
    assert_eq!(keys, there.keys());
    let fabric = std::fs::read_to_string(here.path("plain.toml")).unwrap();
    std::fs::write(here.path("plain.toml"), fabric + "\n").unwrap();
    let changed = here.keys();
    assert!(keys.iter().all(|key| !changed.contains(key)));
}

#[test]
fn axes_in_step_and_files_of_a_pattern() {
    let bench = Bench::new("");
    std::fs::copy(bench.path("plain.toml"), bench.path("other.toml")).unwrap();
    bench.write(
        "[[axis]]\nname = \"fabric\"\nkey = \"fabric.cloth.file\"\nfiles = \"[op]*[nr].toml\"\ntogether = \"a\"\n\
         [[axis]]\nkey = \"spacing\"\nvalues = [0.02, 0.01]\ntogether = \"a\"\n",
    );
    bench.sweep("2");
    let rows = bench.table();
    let found: Vec<[&str; 2]> =
        rows.iter().map(|row| [&row["fabric"][..], &row["spacing"]]).collect();
    assert_eq!(found, [["other.toml", "0.02"], ["plain.toml", "0.01"]]);
    assert!(rows.iter().all(|row| row["outcome"] == "ok"));
}

#[test]
fn mistakes_of_a_study_have_remedies_that_help() {
    let axis = |rest: &str| format!("[[axis]]\n{rest}");
    let end = |rest: &str| axis(&format!("key = \"time.end\"\n{rest}"));
    let measures = |name: &str| {
        format!("[[measure]]\nkey = \"steps\"\n[[measure]]\nkey = \"particles\"\n{name}")
    };
    let sample = |rest: &str| {
        format!(
            "[[sample]]\nmethod = \"sobol\"\ncount = 4\n[[sample.range]]\nkey = \"time.end\"\n{rest}"
        )
    };
    for (wrong, part, right) in [
        (String::new(), "add an [[axis]]", end("values = [0.02]\n")),
        (end(""), "give one of values, range, files and starts", end("values = [0.02]\n")),
        (end("values = []\n"), "give one or more", end("values = [0.02]\n")),
        (end("values = [0.02, 0.02]\n"), "name each level once", end("values = [0.02]\n")),
        (
            end("range = { start = 0, end = 1, count = 2, scale = \"log\" }\n"),
            "scale = \\\"linear\\\"",
            end("range = { start = 0, end = 1, count = 2, scale = \"linear\" }\n"),
        ),
        (
            end("range = { start = 1, end = 2, count = 1 }\n"),
            "one value stands in values",
            end("values = [1]\n"),
        ),
        (
            axis("key = \"panel.1.name\"\nvalues = [\"a\"]\n"),
            "numbers 0 to 0",
            axis("key = \"panel.0.name\"\nvalues = [\"a\"]\n"),
        ),
        (
            axis("key = \"panel.0.seed\"\nstarts = 2\n"),
            "panel.0.noise.seed",
            axis("key = \"panel.0.noise.seed\"\nstarts = 2\n"),
        ),
        (
            axis("key = \"fabric.cloth.file\"\nfiles = \"none-*.toml\"\n"),
            "write a pattern that files match",
            axis("key = \"fabric.cloth.file\"\nfiles = \"pl*.toml\"\n"),
        ),
        (
            end("values = [1, 2]\ntogether = \"a\"\n")
                + &axis("key = \"spacing\"\nvalues = [0.01]\ntogether = \"a\"\n"),
            "as many levels each",
            end("values = [1, 2]\ntogether = \"a\"\n")
                + &axis("key = \"spacing\"\nvalues = [0.01, 0.02]\ntogether = \"a\"\n"),
        ),
        (end("values = [1]\n") + &end("values = [2]\n"), "its own key", end("values = [1]\n")),
        (
            end("values = [1]\n") + &end("name = \"until\"\nvalues = [2]\n"),
            "is set by two axes",
            end("values = [1]\n"),
        ),
        (
            end("values = [1]\n")
                + &axis("key = \"spacing\"\nname = \"time.end\"\nvalues = [0.01]\n"),
            "its own name",
            end("values = [1]\n") + &axis("key = \"spacing\"\nvalues = [0.01]\n"),
        ),
        (
            end("values = [1]\n") + &measures("name = \"steps\"\n"),
            "give each measure its own name",
            end("values = [1]\n") + &measures(""),
        ),
        (sample("start = 1\nend = 1\n"), "give another end", sample("start = 1\nend = 2\n")),
        (
            format!("keep = \"lats\"\n{}", end("values = [1]\n")),
            "did you mean \\\"last\\\"?",
            format!("keep = \"last\"\n{}", end("values = [1]\n")),
        ),
    ] {
        let bench = Bench::new(&wrong);
        let (_, messages) = bench.ran(&["sweep", "plan", "study.toml"], 3);
        assert!(messages.contains(&part.replace('\\', "")), "{wrong}: {messages}");
        bench.write(&right);
        bench.ran(&["sweep", "plan", "study.toml"], 0);
    }
}

#[test]
fn exported_tasks_are_all_points() {
    let bench = Bench::new(GRID);
    bench.ran(&["sweep", "export", "study.toml", "--hyperqueue", "--chunk", "2"], 0);
    let text = std::fs::read_to_string(bench.path("results/hyperqueue.toml")).unwrap();
    let job: toml::Table = toml::from_str(&text).unwrap();
    let tasks = job["task"].as_array().unwrap();
    assert_eq!(tasks.len(), 3);
    for task in tasks {
        let words = task["command"].as_array().unwrap();
        let words: Vec<&str> = words.iter().map(|word| word.as_str().unwrap()).collect();
        let ended = Command::new(words[0])
            .args(&words[1..])
            .current_dir(task["cwd"].as_str().unwrap())
            .output()
            .unwrap();
        assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    }
    assert!(bench.sweep("1").0.contains("0 run, 6 done before"));
    // By the times of these runs, a minute is enough for all points.
    let (said, _) = bench.ran(&["sweep", "export", "study.toml", "--slurm"], 0);
    assert!(said.contains("1 task in"), "{said}");
    let script = std::fs::read_to_string(bench.path("results/slurm.sh")).unwrap();
    assert!(script.contains("#SBATCH --array=1-1\n") && script.contains("--requeue"), "{script}");
    let mut shell = Command::new("sh");
    shell.arg(bench.path("results/slurm.sh")).env("SLURM_ARRAY_TASK_ID", "1");
    let ended = shell.output().unwrap();
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    let (dask, _) = bench.ran(&["sweep", "export", "study.toml", "--dask", "-o", "-"], 0);
    assert!(dask.contains("            tasks=1,\n") && dask.contains("\"study.toml\""), "{dask}");
    let (_, messages) = bench.ran(&["sweep", "export", "study.toml"], 2);
    assert!(messages.contains("--slurm"), "{messages}");
}
