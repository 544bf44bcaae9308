"""One job of the workflow: a plain `toile run` for each job of the line in a part, in the folders of `toile line run`.

    python3 job.py OUT/workflow/plan.jsonl PART THREADS MARKER

What is done is not done again: its record has the same key, and its outputs are whole. The marker is written when all
has passed. The exit code is the largest of all. The processes end with this one, and this one with its parent.
"""

import fcntl
import json
import os
import signal
import subprocess
import sys
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import plan

# Ends that another try would not change, as in src/line/done.rs.
FINAL = ("good", "gate-failed", "usage", "input", "unstable")
SYSTEM = 5
# Seconds between two looks for the parent, and the longest wait for a process that is still leaving.
LOOK, LEAVING = 0.5, 10


def record(folder):
    try:
        with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def is_done(folder, key):
    """As `is_done` in src/line/done.rs."""
    found = record(folder)
    return found.get("key") == key and found.get("status") in FINAL and all(
        is_whole(os.path.join(folder, output["path"]), output["blake3"]) for output in found.get("outputs", ())
    )


def is_whole(path, digest):
    # Needed only where there is something to compare. Without the package, all is done again.
    try:
        from blake3 import blake3

        return blake3().update_mmap(path).hexdigest() == digest
    except (ImportError, OSError, ValueError):
        return False


def wait_for(folder):
    """Waits for a process of an earlier workflow that still leaves the folder."""
    began = time.monotonic()
    while time.monotonic() - began < LEAVING:
        try:
            with open(os.path.join(folder, ".lock.tmp-toile"), "rb") as file:
                fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
            return
        except FileNotFoundError:
            return
        except BlockingIOError:
            time.sleep(0.05)


class Running:
    """The process at work. Its standard input is a pipe from here; it ends with the pipe."""

    def __init__(self):
        self.child = None
        self.stopped = False
        self.parent = os.getppid()
        for sign in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(sign, lambda *_: self.stop())
        threading.Thread(target=self.watch, daemon=True).start()

    def watch(self):
        while os.getppid() == self.parent:
            time.sleep(LOOK)
        self.stop()

    def stop(self):
        self.stopped = True
        child = self.child
        if child and child.stdin:
            child.stdin.close()

    def run(self, command, folder, log):
        with open(log, "wb") as messages:
            self.child = subprocess.Popen(
                command, cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=messages
            )
            if self.stopped:
                self.stop()
            code = self.child.wait()
        if not os.path.getsize(log):
            os.remove(log)
        return code if code >= 0 else SYSTEM


def one(name, key, arguments, head, out, threads, running):
    """Runs a job of the line, and gives its exit code."""
    folder = os.path.join(out, "jobs", name)
    if is_done(folder, key):
        return record(folder)["exit_code"]
    wait_for(folder)
    # The picture of an earlier content; `toile line report` draws the new one.
    picture = os.path.join(out, "pictures", name + ".png")
    if os.path.exists(picture):
        os.remove(picture)
    options = ["--out", folder, "--quiet", "--force", "--tied", "--threads", threads, *head["options"]]
    return running.run([head["toile"], *arguments, *options], head["folder"], os.path.join(out, "logs", name + ".txt"))


def main(file, name, threads, marker):
    out = os.path.dirname(os.path.dirname(file))
    head, part = plan.read_part(file, name)
    running = Running()
    worst = 0
    for name, key, arguments in zip(part["names"], part["keys"], part["arguments"]):
        code = one(name, key, arguments, head, out, threads, running)
        if running.stopped:
            return 130
        if code:
            sys.stderr.write(f"{name}: exit code {code}; see {os.path.join(out, 'jobs', name)}\n")
        worst = max(worst, code)
    if worst == 0:
        begun = marker + ".tmp-toile"
        with open(begun, "w", encoding="utf-8") as file:
            file.write(plan.stamp(out, part["names"]))
        os.replace(begun, marker)
    return worst


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
