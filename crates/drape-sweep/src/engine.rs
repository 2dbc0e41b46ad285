//! Files with which other programs run a study on many machines. Each task of such a program runs a
//! shard of the points with `drape sweep run --shard`.

use std::path::PathBuf;

use drape_input::toml_string;

/// Program that runs the shards of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Engine {
    /// Slurm. The file is a script with an array of jobs, for `sbatch`.
    Slurm,
    /// HyperQueue. The file is a job file in TOML, for `hq job submit-file`.
    HyperQueue,
    /// Dask. The file is a program in Python with a future for each shard.
    Dask,
}

/// Tasks of a study.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Batch {
    /// Absolute path of the program that runs the points.
    pub program: PathBuf,
    /// Folder in which the program is started.
    pub folder: PathBuf,
    /// Path of the study, relative to `folder`.
    pub study: PathBuf,
    /// Absolute path of the folder for the results.
    pub output: PathBuf,
    /// Whether `output` is not the folder that the study names.
    pub is_elsewhere: bool,
    /// Options of the program that come before the command `sweep`.
    pub options: Vec<String>,
    /// Number of tasks.
    pub tasks: usize,
}

impl Batch {
    /// Returns the content of the file for `engine`.
    #[must_use]
    pub fn file(&self, engine: Engine) -> String {
        match engine {
            Engine::Slurm => self.slurm(),
            Engine::HyperQueue => self.hyperqueue(),
            Engine::Dask => self.dask(),
        }
    }

    /// Returns the command of a task, without the option `--shard`.
    fn command(&self) -> Vec<String> {
        let mut command = vec![self.program.display().to_string()];
        command.extend(self.options.clone());
        command.extend(["sweep", "run"].map(str::to_owned));
        command.push(self.study.display().to_string());
        if self.is_elsewhere {
            command.extend(["--results".to_owned(), self.output.display().to_string()]);
        }
        command
    }

    /// Returns the script for [`Engine::Slurm`].
    fn slurm(&self) -> String {
        let Self { tasks, .. } = self;
        let folder = shell_word(&self.folder.display().to_string());
        let command: Vec<String> = self.command().iter().map(|word| shell_word(word)).collect();
        let command = command.join(" ");
        format!(
            "#!/bin/sh\n\
             # Submit with: sbatch FILE. A task that is ended goes on where it was when it is queued again;\n\
             # what is done is not done again.\n\
             #SBATCH --job-name=drape-sweep\n\
             #SBATCH --array=1-{tasks}\n\
             #SBATCH --requeue\n\
             #SBATCH --open-mode=append\n\
             #SBATCH --cpus-per-task=1\n\
             #SBATCH --signal=B:TERM@60\n\
             cd {folder} || exit 6\n\
             # The shell becomes the program, so that signals reach it.\n\
             exec {command} --shard \"$SLURM_ARRAY_TASK_ID/{tasks}\" --jobs \"${{SLURM_CPUS_PER_TASK:-1}}\"\n"
        )
    }

    /// Returns the job file for [`Engine::HyperQueue`].
    fn hyperqueue(&self) -> String {
        let folder = toml_string(&self.folder.display().to_string());
        let mut text = "# Submit with: hq job submit-file FILE. What is done is not done again.\n\
                        name = \"drape-sweep\"\n"
            .to_owned();
        for task in 1..=self.tasks {
            let shard = format!("{task}/{}", self.tasks);
            let options = ["--shard", &shard, "--jobs", "1"].map(str::to_owned);
            let words = self.command().into_iter().chain(options);
            let command: Vec<String> = words.map(|word| toml_string(&word)).collect();
            text += &format!(
                "\n[[task]]\nid = {task}\ncwd = {folder}\ncrash_limit = 5\ncommand = [{}]\n\
                 [[task.request]]\nresources = {{ \"cpus\" = 1 }}\n",
                command.join(", ")
            );
        }
        text
    }

    /// Returns the Python program for [`Engine::Dask`].
    fn dask(&self) -> String {
        let command: Vec<String> = self.command().iter().map(|word| python_string(word)).collect();

        format!(
            r##"# Runs a study on the workers of Dask: python FILE [SCHEDULER] [--store URL]; without a scheduler on
# this machine. Results meet in the study's folder, which all workers see, or in the folder or object store
# of a URL of fsspec, such as s3://bucket/study, from which they are fetched at the end.
# Needs: pip install "dask[distributed]", and what fsspec needs for the store. What is done is not done again.
import argparse
import pathlib
import subprocess
import sys
import tempfile

import fsspec
from dask.distributed import Client, LocalCluster, as_completed

COMMAND = [{command}]
FOLDER = {folder}
OUTPUT = {output}
TASKS = {tasks}


def drape(task, *options):
    """Runs a part of the points; a failure of the machine is an error, so that Dask tries again."""
    arguments = [*COMMAND, "--shard", f"{{task}}/{{TASKS}}", "--jobs", "1", *options]
    ended = subprocess.run(arguments, cwd=FOLDER, capture_output=True, text=True)
    if ended.returncode != 0:
        raise RuntimeError(f"exit code {{ended.returncode}}: {{ended.stderr[-2000:]}}")
    return ended.stdout


def fetch(fs, source, target):
    """Fetches a file of the store; returns whether it is there."""
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        target.write_bytes(fs.cat_file(source))
    except FileNotFoundError:
        return False
    return True


def run(task, store=None):
    """Runs a part of the points; with a store, in a folder of its own."""
    if store is None:
        drape(task)
        return task
    fs, root = fsspec.core.url_to_fs(store)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        own = ["--results", str(folder)]
        for line in drape(task, *own, "--list").splitlines():
            key = line.split("\t")[1]
            for name in [f"points/{{key[:2]}}/{{key}}.json", f"points/{{key[:2]}}/{{key}}/summary.json"]:
                fetch(fs, f"{{root}}/{{name}}", folder / name)
        before = set(folder.rglob("*"))
        drape(task, *own)
        # Records come last: a point that has one is whole.
        files = [path for path in folder.glob("points/**/*") if path.is_file() and path not in before]
        for path in sorted(files, key=lambda path: len(path.relative_to(folder).parts), reverse=True):
            target = f"{{root}}/{{path.relative_to(folder).as_posix()}}"
            fs.makedirs(target.rsplit("/", 1)[0], exist_ok=True)
            fs.pipe_file(target, path.read_bytes())
    return task


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("scheduler", nargs="?", help="address; a cluster on this machine if missing")
    parser.add_argument("--store", help="URL of fsspec where results meet")
    arguments = parser.parse_args()
    address = arguments.scheduler or LocalCluster(threads_per_worker=1)
    with Client(address) as client:
        futures = client.map(run, range(1, TASKS + 1), store=arguments.store, retries=3, pure=False)
        failed = 0
        for future in as_completed(futures):
            if future.status != "finished":
                failed += 1
                print(future.exception() or future.status, file=sys.stderr)
        print(f"{{TASKS - failed}} of {{TASKS}} tasks are done")
    if arguments.store:
        fs, root = fsspec.core.url_to_fs(arguments.store)
        for path in fs.find(f"{{root}}/points"):
            fetch(fs, path, pathlib.Path(OUTPUT) / path[len(root) + 1 :])
    sys.exit(6 if failed else 0)


if __name__ == "__main__":
    main()
"##,
            command = command.join(", "),
            folder = python_string(&self.folder.display().to_string()),
            output = python_string(&self.output.display().to_string()),
            tasks = self.tasks,
        )
    }
}

/// Returns `text` as a string of Python. Every JSON string is also a string of Python.
fn python_string(text: &str) -> String {
    serde_json::to_string(text).unwrap_or_default()
}

/// Returns `text` as a word of a shell, in quotes if the shell needs them.
fn shell_word(text: &str) -> String {
    let is_plain = !text.is_empty()
        && text
            .chars()
            .all(|letter| letter.is_ascii_alphanumeric() || "/._-=+:@%".contains(letter));
    if is_plain {
        return text.to_owned();
    }
    format!("'{}'", text.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn batch() -> Batch {
        Batch {
            program: "/opt/my programs/drape".into(),
            folder: "/data/it's here".into(),
            study: "study.toml".into(),
            output: "/data/it's here/out".into(),
            is_elsewhere: true,
            options: vec!["--allow-path".into(), "/fabrics".into()],
            tasks: 3,
        }
    }

    #[test]
    fn a_job_file_is_toml_with_every_part_once() {
        let text = batch().file(Engine::HyperQueue);
        let job: toml::Table = toml::from_str(&text).expect("it is TOML");
        let tasks = job["task"].as_array().expect("a list");
        let shard = |task: &toml::Value| {
            let command = task["command"].as_array().expect("a list").clone();
            let at = command.iter().position(|part| part.as_str() == Some("--shard"));
            assert_eq!(command[0].as_str(), Some("/opt/my programs/drape"));
            command[at.expect("there is one") + 1].as_str().expect("text").to_owned()
        };
        assert_eq!(tasks.iter().map(shard).collect::<Vec<_>>(), ["1/3", "2/3", "3/3"]);
        assert_eq!(tasks[0]["cwd"].as_str(), Some("/data/it's here"));
    }

    #[test]
    fn words_of_a_script_are_quoted() {
        let text = batch().file(Engine::Slurm);
        assert!(text.contains("cd '/data/it'\\''s here'"), "{text}");
        assert!(text.contains("exec '/opt/my programs/drape' --allow-path /fabrics sweep run"));
        assert!(text.contains("#SBATCH --array=1-3\n#SBATCH --requeue\n"), "{text}");
    }
}
