//! Files with which other programs run a study on many machines. Each task of such a program runs a
//! shard of the points with `drape sweep run --shard`.

use std::path::PathBuf;

use drape_input::toml_string;

/// Program in Python that runs the tasks of any study, without the call that names the tasks.
const DASK: &str = include_str!("engine/dask_sweep.py");

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

    /// Returns the Python program for [`Engine::Dask`]: the program of every study, and a call with
    /// the tasks of this one.
    fn dask(&self) -> String {
        let command: Vec<String> = self.command().iter().map(|word| python_string(word)).collect();
        let command = command.join(", ");
        let folder = python_string(&self.folder.display().to_string());
        let output = python_string(&self.output.display().to_string());
        let tasks = self.tasks;
        format!(
            "{DASK}\n\nif __name__ == \"__main__\":\n    main(\n        Batch(\n            \
             command=[{command}],\n            folder={folder},\n            output={output},\n            \
             tasks={tasks},\n        )\n    )\n"
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
