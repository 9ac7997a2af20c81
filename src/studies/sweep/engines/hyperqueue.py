# HyperQueue (PyPI: hyperqueue): python this file, with a server and workers running; the server's
# folder is HQ_SERVER_DIR, or HyperQueue's own. Started again, it runs what is missing.
import os
from hyperqueue import Client, Job

HEAD
os.makedirs(OUT, exist_ok=True)
job = Job(max_fails=len(JOBS))
missing = [k for key, k in JOBS.items() if not os.path.exists(f"{OUT}/{key}.json")]
for k in missing:
    command = [PROGRAM, "sweep", "run", SWEEP, "--out", OUT, "--only", str(k)]
    job.program(command, stdout=None, stderr=None, crash_limit=5)
if missing:
    client = Client(os.environ.get("HQ_SERVER_DIR"))
    client.wait_for_jobs([client.submit(job)], raise_on_error=True)
