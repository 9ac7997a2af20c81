//! Sweeps on the engines that run many jobs: a job file each, by the engine's own means.
//!
//! Every case is `plane-contact sweep FILE --case K --row ROW`, which writes one file and leaves an
//! equal one alone; `plane-contact sweep FILE --rows DIR` gathers the rows and runs what is missing.

use crate::choices;

choices! {
    /// An engine that runs jobs.
    Engine {
        /// HyperQueue: a Python script for the package on PyPI.
        HyperQueue = "hyperqueue",
        /// Snakemake: a rule for each case.
        Snakemake = "snakemake",
        /// Slurm: a batch script with an array.
        Slurm = "slurm",
        /// GNU parallel.
        Parallel = "parallel",
    }
}

/// The exit status of a case whose row could not be written, as on a full disk: worth another try.
pub const TRY_AGAIN: u8 = 75;

/// What a job file is written for.
pub struct Jobs<'a> {
    /// The program, as it is called.
    pub program: &'a str,
    /// The file of the sweep.
    pub sweep: &'a str,
    /// The folder of the rows.
    pub rows: &'a str,
    /// The number of cases, at least one.
    pub cases: usize,
    /// The most memory that a case takes, bytes.
    pub memory: f64,
}

impl Jobs<'_> {
    /// Returns the memory of a case in whole megabytes, rounded up.
    fn megabytes(&self) -> u64 {
        (self.memory / 1e6).ceil() as u64
    }

    fn last(&self) -> usize {
        self.cases - 1
    }

    /// Returns the job file for an engine.
    pub fn file(&self, engine: Engine) -> String {
        match engine {
            Engine::HyperQueue => self.hyperqueue(),
            Engine::Snakemake => self.snakemake(),
            Engine::Slurm => self.slurm(),
            Engine::Parallel => self.parallel(),
        }
    }

    /// Returns the command that runs the case that a variable of the shell numbers.
    fn case(&self, variable: &str) -> String {
        let (program, sweep, rows) = (quoted(self.program), quoted(self.sweep), quoted(self.rows));
        format!("{program} sweep {sweep} --case \"${variable}\" --row {rows}/\"${variable}\".json")
    }

    fn gather(&self) -> String {
        let (program, sweep, rows) = (quoted(self.program), quoted(self.sweep), quoted(self.rows));
        format!("{program} sweep {sweep} --rows {rows}")
    }

    fn hyperqueue(&self) -> String {
        let text = |text: &str| serde_json::Value::from(text).to_string();
        format!(
            "# HyperQueue (PyPI: hyperqueue): python this file, with a server and workers running; the\n\
             # server's folder is HQ_SERVER_DIR, or HyperQueue's own. Cases that a lost worker had go to\n\
             # others; started again, it goes on where it was.\n\
             import os\n\
             import subprocess\n\
             from hyperqueue import Client, Job\n\
             from hyperqueue.ffi.protocol import ResourceRequest\n\n\
             PROGRAM, SWEEP, ROWS, CASES, MEGABYTES = {program}, {sweep}, {rows}, {cases}, {memory}\n\n\
             # Workers of a LocalCluster say nothing of their memory: HQ_MEMORY=0 asks for none.\n\
             memory = {{}} if os.environ.get(\"HQ_MEMORY\") == \"0\" else {{\"mem\": MEGABYTES}}\n\
             os.makedirs(ROWS, exist_ok=True)\n\
             job = Job(max_fails=CASES)\n\
             missing = [k for k in range(CASES) if not os.path.exists(f\"{{ROWS}}/{{k}}.json\")]\n\
             for k in missing:\n    \
                 job.program(\n        \
                     [PROGRAM, \"sweep\", SWEEP, \"--case\", str(k), \"--row\", f\"{{ROWS}}/{{k}}.json\"],\n        \
                     stdout=None, stderr=None, crash_limit=5,\n        \
                     resources=ResourceRequest(cpus=1, resources=dict(memory)),\n    \
                 )\n\
             if missing:\n    \
                 client = Client(os.environ.get(\"HQ_SERVER_DIR\"))\n    \
                 client.wait_for_jobs([client.submit(job)], raise_on_error=False)\n\
             subprocess.run([PROGRAM, \"sweep\", SWEEP, \"--rows\", ROWS], check=True)\n",
            program = text(self.program),
            sweep = text(self.sweep),
            rows = text(self.rows),
            cases = self.cases,
            memory = self.megabytes(),
        )
    }

    fn slurm(&self) -> String {
        format!(
            "#!/bin/sh\n\
             # Slurm: sbatch this file. A case whose row could not be written is queued again.\n\
             #SBATCH --job-name=sweep\n\
             #SBATCH --array=0-{last}\n\
             #SBATCH --cpus-per-task=1\n\
             #SBATCH --mem={memory}M\n\
             #SBATCH --requeue\n\
             mkdir -p {rows}\n\
             {case}\n\
             status=$?\n\
             if [ $status -eq {again} ]; then\n    \
                 scontrol requeue \"${{SLURM_ARRAY_JOB_ID}}_${{SLURM_ARRAY_TASK_ID}}\"\n\
             fi\n\
             exit $status\n\
             # When all have ended: {gather}\n",
            last = self.last(),
            memory = self.megabytes(),
            rows = quoted(self.rows),
            case = self.case("SLURM_ARRAY_TASK_ID"),
            again = TRY_AGAIN,
            gather = self.gather(),
        )
    }

    fn parallel(&self) -> String {
        let (program, sweep, rows) = (quoted(self.program), quoted(self.sweep), quoted(self.rows));
        format!(
            "#!/bin/sh\n\
             # GNU parallel: sh this file; started again it goes on where it was.\n\
             set -e\n\
             mkdir -p {rows}\n\
             seq 0 {last} | parallel --joblog {rows}/joblog --resume-failed --retries 3 \\\n    \
                 --memfree {memory}M {program} sweep {sweep} --case {{}} --row {rows}/{{}}.json\n\
             {gather}\n",
            last = self.last(),
            memory = self.megabytes(),
            gather = self.gather(),
        )
    }

    fn snakemake(&self) -> String {
        let text = |text: &str| serde_json::Value::from(text).to_string();
        format!(
            "# Snakemake: snakemake -s this file --cores all. Rows that are there are not made again.\n\
             import shlex\n\n\
             PROGRAM, SWEEP, ROWS, CASES = {program}, {sweep}, {rows}, {cases}\n\n\
             rule all:\n    \
                 input: expand(ROWS + \"/{{case}}.json\", case=range(CASES))\n    \
                 params: program=shlex.quote(PROGRAM), sweep=shlex.quote(SWEEP), rows=shlex.quote(ROWS)\n    \
                 shell: \"{{params.program}} sweep {{params.sweep}} --rows {{params.rows}}\"\n\n\
             rule case:\n    \
                 output: ROWS + \"/{{case}}.json\"\n    \
                 wildcard_constraints: case=r\"\\d+\"\n    \
                 params: program=shlex.quote(PROGRAM), sweep=shlex.quote(SWEEP)\n    \
                 resources: mem_mb={memory}\n    \
                 retries: 2\n    \
                 shell: \"{{params.program}} sweep {{params.sweep}} --case {{wildcards.case}} --row {{output:q}}\"\n",
            program = text(self.program),
            sweep = text(self.sweep),
            rows = text(self.rows),
            cases = self.cases,
            memory = self.megabytes(),
        )
    }
}

/// Returns a word as the shell reads it.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "/._-+=:@".contains(c);
    match !word.is_empty() && word.chars().all(is_plain) {
        true => word.into(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}
