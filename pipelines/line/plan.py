"""The plan of a product line for the Snakefile: what `toile line jobs` says, divided into parts.

A part is one job of Snakemake. It holds `chunk` jobs of the line, one by default. `workflow/plan.jsonl` has a line for
each part; the name of a part ends in a digest of the content keys of its jobs.
"""

import fcntl
import hashlib
import json
import math
import os
import shlex
import shutil
import subprocess
import sys


def words(value):
    """A list in the configuration may be one word."""
    return [value] if isinstance(value, str) else list(value or [])


def read_part(file, name):
    """Head of the plan and one part of it; other lines are not parsed."""
    begin = json.dumps({"part": name})[:-1].encode()
    with open(file, "rb") as lines:
        head = json.loads(next(lines))
        return head, json.loads(next(text for text in lines if text.startswith(begin)))


class Plan:
    """The parts of a line, and the folder of its results."""

    def __init__(self, out):
        self.out = out
        self.folder = os.path.join(out, "workflow")
        self.file = os.path.join(self.folder, "plan.jsonl")
        self.parts = {}

    @classmethod
    def of(cls, config, here):
        """Makes the paths of the configuration absolute."""
        for key in ("line", "out"):
            if key not in config:
                raise ValueError(f"say `--config {key}=...`")
            config[key] = os.path.join(here, config[key])
        config["toile"] = os.path.abspath(shutil.which(config.get("toile", "toile")) or "")
        if not os.path.isfile(config["toile"]):
            raise ValueError("`toile` is not in the path: say `--config toile=...`")
        return cls(config["out"])

    @classmethod
    def found(cls, config, here):
        """In a job of a cluster, which begins in the folder of the plan or where Snakemake was started."""
        is_here = os.path.exists(os.path.join(here, "plan.jsonl"))
        return cls(os.path.dirname(here) if is_here else os.path.join(here, config["out"]))

    def part(self, name):
        return self.parts[name] if name in self.parts else read_part(self.file, name)[1]

    def write(self, config):
        """Asks `toile line jobs`, and writes the plan. Markers that no longer hold are removed."""
        for name in ("jobs", "logs", "pictures", "workflow/done"):
            os.makedirs(os.path.join(self.out, name), exist_ok=True)
        self.lock()
        program = config["toile"]
        begun = self.file + ".tmp-toile"
        with open(begun, "w", encoding="utf-8") as plan:
            head = {"toile": program, "folder": os.path.dirname(config["line"]), "options": options(config)}
            plan.write(json.dumps(head) + "\n")
            for part in parts(jobs(program, config), int(config.get("chunk", 1))):
                plan.write(json.dumps(part) + "\n")
                # The rest is needed by the job alone.
                self.parts[part["part"]] = {"mb": part["mb"], "minutes": part["minutes"], "names": part["names"]}
        os.replace(begun, self.file)
        self.tidy()

    def lock(self):
        """The lock of `toile line run`: one program at a time works in the folder."""
        self.held = open(os.path.join(self.out, ".lock.tmp-toile"), "a")
        try:
            fcntl.flock(self.held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise ValueError(f"another program works in {self.out}") from None

    def tidy(self):
        """Removes markers of other contents, and those whose record another program wrote anew or removed."""
        done = os.path.join(self.folder, "done")
        for name in os.listdir(done):
            path = os.path.join(done, name)
            part = self.parts.get(name)
            with open(path, encoding="utf-8") as file:
                if part is None or file.read() != stamp(self.out, part["names"]):
                    os.remove(path)

    def report(self, config):
        """Puts the page of the line together."""
        command = [config["toile"], "line", "report", config["line"], "--out", self.out, *rights(config)]
        # `line report` takes no lock, since a part of the line may be at work.
        code = subprocess.run(command, check=False).returncode
        if code:
            sys.stderr.write(f"exit code {code}: {shlex.join(command)}\n")
            raise SystemExit(code)


def rights(config):
    """What the pipelines may do, in words of the command line."""
    reads = [word for folder in words(config.get("allow_read")) for word in ("--allow-read", os.path.abspath(folder))]
    return reads + [word for plugin in words(config.get("allow_run")) for word in ("--allow-run", plugin)]


def options(config):
    """Options of every `toile run`."""
    cache = ["--cache", os.path.abspath(config["cache"])] if "cache" in config else []
    return rights(config) + cache


def jobs(program, config):
    """The jobs of the line; mistakes in it end the workflow."""
    command = [program, "line", "jobs", config["line"], *rights(config)]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as listing:
        for text in listing.stdout:
            yield json.loads(text)
    if listing.returncode:
        raise ValueError(f"exit code {listing.returncode}: {shlex.join(command)}")


def parts(all_jobs, chunk):
    """Divides the jobs."""
    held = []
    for job in all_jobs:
        held.append(job)
        if len(held) == chunk:
            yield part(held)
            held = []
    if held:
        yield part(held)


def part(held):
    digest = hashlib.sha256("".join(f"{job['job']} {job['key']}\n" for job in held).encode()).hexdigest()[:16]
    first = held[0]["job"] + (f"+{len(held) - 1}" if len(held) > 1 else "")
    return {
        "part": f"{first}.{digest}",
        "names": [job["job"] for job in held],
        "keys": [job["key"] for job in held],
        "arguments": [job["arguments"] for job in held],
        # Room above what is foreseen: the scheduler of a cluster ends what takes more.
        "mb": math.ceil(max(2 * job["expected"]["mb"] for job in held)) + 100,
        "minutes": math.ceil(sum(longest(job) for job in held) / 60),
    }


def longest(job):
    """Seconds that a job may take: its limit, or many times what is foreseen."""
    given = job["arguments"]
    limit = float(given[given.index("--max-seconds") + 1]) if "--max-seconds" in given else 500
    return 30 + limit


def stamp(out, names):
    """What a marker says: the records as they were when the part was done."""
    return "".join(f"{name} {stamp_of(out, name)}\n" for name in names)


def stamp_of(out, name):
    try:
        stat = os.stat(os.path.join(out, "jobs", name, "run.json"))
    except FileNotFoundError:
        return "none"
    return f"{stat.st_mtime_ns} {stat.st_size}"
