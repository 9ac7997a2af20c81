//! Sweeps on the engines that run many jobs: a job file, or a list of commands.
//!
//! Every case is `plane-contact sweep FILE --case K --row ROW`, which writes one file and leaves an
//! equal one alone; `plane-contact sweep FILE --rows DIR` gathers the rows and runs what is missing.

use serde_json::Value;

use base::choices;
use problem::scene::sha256;

choices! {
    /// An engine that runs jobs.
    Engine {
        /// HyperQueue: a Python script for the package on PyPI.
        HyperQueue = "hyperqueue",
        /// Snakemake: a rule for each case.
        Snakemake = "snakemake",
        /// Any other: a command of the shell on each line.
        Commands = "commands",
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

    /// Returns the job file for an engine.
    pub fn file(&self, engine: Engine) -> String {
        match engine {
            Engine::HyperQueue => self.hyperqueue(),
            Engine::Snakemake => self.snakemake(),
            Engine::Commands => self.commands(),
        }
    }

    /// Returns the program, the sweep and the rows, none of which a program takes for an option.
    fn words(&self) -> [String; 3] {
        [self.program, self.sweep, self.rows].map(|word| {
            let is_option = word.starts_with(['-', '+']);
            if is_option { format!("./{word}") } else { word.into() }
        })
    }

    fn hyperqueue(&self) -> String {
        let [program, sweep, rows] = self.words().map(|word| Value::from(word).to_string());
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
            cases = self.cases,
            memory = self.megabytes(),
        )
    }

    fn commands(&self) -> String {
        let [program, sweep, rows] = self.words();
        let (program, sweep) = (quoted(&program), quoted(&sweep));
        let command = |case: usize| {
            let row = quoted(&format!("{rows}/{case}.json"));
            format!("{program} sweep {sweep} --case {case} --row {row}\n")
        };
        (0..self.cases).map(command).collect()
    }

    /// The folder of the rows is named by a link: Snakemake takes braces in a name for wildcards.
    fn snakemake(&self) -> String {
        let words = self.words();
        let link = format!(".rows-{}", &sha256(&words[2])[..16]);
        let [program, sweep, rows] = words.map(|word| Value::from(word).to_string());
        format!(
            "# Snakemake: snakemake -s this file --cores all. Rows that are there are not made again.\n\
             import os\n\n\
             PROGRAM, SWEEP, ROWS, CASES = {program}, {sweep}, {rows}, {cases}\n\
             os.environ.update(PROGRAM=PROGRAM, SWEEP=SWEEP, ROWS=ROWS)\n\
             os.makedirs(ROWS, exist_ok=True)\n\
             if not os.path.islink(\"{link}\"):\n    \
                 os.symlink(os.path.abspath(ROWS), \"{link}\")\n\n\
             rule all:\n    \
                 input: expand(\"{link}/{{case}}.json\", case=range(CASES))\n    \
                 shell: '\"$PROGRAM\" sweep \"$SWEEP\" --rows \"$ROWS\"'\n\n\
             rule case:\n    \
                 output: \"{link}/{{case}}.json\"\n    \
                 wildcard_constraints: case=r\"\\d+\"\n    \
                 resources: mem_mb={memory}\n    \
                 retries: 2\n    \
                 shell: '\"$PROGRAM\" sweep \"$SWEEP\" --case {{wildcards.case}} --row {{output}}'\n",
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
