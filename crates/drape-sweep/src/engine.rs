//! Files by which other programs run a study on many machines: each of their tasks runs a part of
//! the points by `drape sweep run --shard`.

use std::path::PathBuf;

use drape_input::toml_string;

/// Program that runs the parts of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Engine {
    /// Slurm: a script of an array of jobs, for `sbatch`.
    Slurm,
    /// HyperQueue: a job file of TOML, for `hq job submit-file`.
    HyperQueue,
    /// Dask: a program in Python with a future for each part.
    Dask,
}

/// Tasks of a study.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Batch {
    /// Program that runs the points, as a whole path.
    pub program: PathBuf,
    /// Folder in which it is started.
    pub folder: PathBuf,
    /// Study, seen from there.
    pub study: PathBuf,
    /// Options of the program that come before its command.
    pub options: Vec<String>,
    /// Number of tasks.
    pub tasks: usize,
}

impl Batch {
    /// Returns the file for an engine.
    #[must_use]
    pub fn file(&self, engine: Engine) -> String {
        match engine {
            Engine::Slurm => self.slurm(),
            Engine::HyperQueue => self.hyperqueue(),
            Engine::Dask => self.dask(),
        }
    }

    /// Returns the command of a task, but for its shard.
    fn command(&self) -> Vec<String> {
        let mut command = vec![self.program.display().to_string()];
        command.extend(self.options.clone());
        command.extend(["sweep", "run"].map(str::to_owned));
        command.push(self.study.display().to_string());
        command
    }

    fn slurm(&self) -> String {
        let Self { tasks, .. } = self;
        let folder = quoted(&self.folder.display().to_string());
        let command: Vec<String> = self.command().iter().map(|part| quoted(part)).collect();
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

    fn hyperqueue(&self) -> String {
        let folder = toml_string(&self.folder.display().to_string());
        let mut text = "# Submit with: hq job submit-file FILE. What is done is not done again.\n\
                        name = \"drape-sweep\"\n"
            .to_owned();
        for task in 1..=self.tasks {
            let shard = format!("{task}/{}", self.tasks);
            let more = ["--shard", &shard, "--jobs", "1"].map(str::to_owned);
            let command = self.command().into_iter().chain(more);
            let command: Vec<String> = command.map(|part| toml_string(&part)).collect();
            text += &format!(
                "\n[[task]]\nid = {task}\ncwd = {folder}\ncrash_limit = 5\ncommand = [{}]\n\
                 [[task.request]]\nresources = {{ \"cpus\" = 1 }}\n",
                command.join(", ")
            );
        }
        text
    }

    fn dask(&self) -> String {
        let python = |text: &str| serde_json::to_string(text).unwrap_or_default();
        let command: Vec<String> = self.command().iter().map(|part| python(part)).collect();
        format!(
            r#"# Runs a study on the workers of Dask: python FILE [SCHEDULER]; without one, on this machine.
# Needs: pip install "dask[distributed]". What is done is not done again.
import subprocess
import sys

from dask.distributed import Client, LocalCluster, as_completed

COMMAND = [{command}]
FOLDER = {folder}
TASKS = {tasks}


def run(task):
    """Runs a part of the points; a failure of the machine is an error, so that Dask tries again."""
    arguments = [*COMMAND, "--shard", f"{{task}}/{{TASKS}}", "--jobs", "1"]
    ended = subprocess.run(arguments, cwd=FOLDER, capture_output=True, text=True)
    if ended.returncode != 0:
        raise RuntimeError(f"exit code {{ended.returncode}}: {{ended.stderr[-2000:]}}")
    return task


def main():
    address = sys.argv[1] if len(sys.argv) > 1 else LocalCluster(threads_per_worker=1)
    with Client(address) as client:
        futures = client.map(run, range(1, TASKS + 1), retries=3, pure=False)
        failed = 0
        for future in as_completed(futures):
            if future.status != "finished":
                failed += 1
                print(future.exception(), file=sys.stderr)
        print(f"{{TASKS - failed}} of {{TASKS}} tasks are done")
    sys.exit(6 if failed else 0)


if __name__ == "__main__":
    main()
"#,
            command = command.join(", "),
            folder = python(&self.folder.display().to_string()),
            tasks = self.tasks,
        )
    }
}

/// Returns a text as a word of a shell.
fn quoted(text: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "/._-=+:@%".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
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
