"""Batches on clusters that break: whatever dies, the same command makes what is missing, and the Merkle root is the same.

ROCK_FIELD names the command line of rock-field; ROCK_FIELD_SCENES says how many scenes there are (default 48).
"""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import jsonschema
import psutil
import yaml

from rock_field_dask.main import EPILOG, parser

ROOT = Path(__file__).resolve().parents[2]
ROCK_FIELD = shlex.split(os.environ.get("ROCK_FIELD", f"node {shlex.quote(str(ROOT / 'dist' / 'cli.js'))}"))
SCENES = int(os.environ.get("ROCK_FIELD_SCENES", "48"))
SIZE = ["--image-width", "64", "--image-height", "64"]
#: Seconds after which something is taken to hang.
HANGS = 240

Json = dict[str, object]
Found = TypeVar("Found")


def rock_field(*arguments: str, cwd: Path | None = None) -> tuple[int, list[Json], str]:
    """The command line's exit code, its lines of JSON, and its words."""
    done = subprocess.run([*ROCK_FIELD, *arguments], capture_output=True, text=True, timeout=HANGS, cwd=cwd)
    return done.returncode, [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")], done.stderr


class Run:
    """``rock-field-dask`` in a process of its own, whose words can be waited for."""

    def __init__(self, *arguments: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "rock_field_dask", "--rock-field", shlex.join(ROCK_FIELD), *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.words = ""

    def hears(self, pattern: str) -> None:
        """Waits until it has said so."""
        assert self.process.stderr is not None
        for line in self.process.stderr:
            self.words += line
            if re.search(pattern, line):
                return
        raise AssertionError(f"it never said {pattern}: {self.words}")

    def ends(self) -> tuple[int, Json]:
        """Its exit code, and what it answers."""
        out, err = self.process.communicate(timeout=HANGS)
        self.words += err
        return self.process.returncode, json.loads(out) if out.strip() else {}


def until(what: Callable[[], Found | None], words: str) -> Found:
    """Waits for something that nobody tells of, and returns it."""
    end = time.monotonic() + HANGS
    while not (found := what()):
        if time.monotonic() > end:
            raise AssertionError(f"{words} after {HANGS} s")
        time.sleep(0.05)
    return found


def listeners(process: psutil.Process) -> list[str]:
    """The addresses at which a process and those below it listen."""
    found: list[str] = []
    for one in [process, *process.children(recursive=True)]:
        try:
            found += [connection.laddr.ip for connection in one.net_connections(kind="inet") if connection.status == psutil.CONN_LISTEN]
        except psutil.NoSuchProcess:
            continue
    return found


def working(process: psutil.Process) -> tuple[psutil.Process, psutil.Process] | None:
    """A worker below a process that is at a shard, and the command line that it runs."""
    for child in process.children(recursive=True):
        try:
            if any("batch" in child.cmdline()[k : k + 3] for k in range(3)) and "--shard" in child.cmdline():
                parent = child.parent()
                return (parent, child) if parent else None
        except psutil.NoSuchProcess:
            continue
    return None


class Cluster(unittest.TestCase):
    """One list of scenes, and the root that it has without any cluster."""

    folder: Path
    scenes: list[str]
    root: str

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = Path(tempfile.mkdtemp(prefix="rock-field-dask-"))
        listed = cls.folder / "scenes.txt"
        lines = [f"preset=journal-fig1&seed={seed}&w=64&h=64" for seed in range(1, SCENES + 1)]
        listed.write_text("# Fig. 1 of the journal\n" + "\n".join(lines) + "\n")
        cls.scenes = [str(listed)]
        straight = str(cls.folder / "straight")
        assert rock_field("batch", *cls.scenes, "--out", straight)[0] == 0
        code, lines_of_json, words = rock_field("batch", "merge", straight)
        assert code == 0, words
        cls.root = str(lines_of_json[-1]["merkle"])

    @classmethod
    def tearDownClass(cls) -> None:
        shutil.rmtree(cls.folder, ignore_errors=True)

    def out(self) -> Path:
        """A new folder."""
        return self.folder / self.id().rsplit(".", 1)[-1]

    def whole(self, folder: Path) -> int:
        """How many files are there; none of them may be a half."""
        _, lines, words = rock_field("batch", "verify", str(folder))
        self.assertEqual((lines[-1]["corrupt"], lines[-1]["foreign"]), (0, 0), words)
        return int(str(lines[-1]["whole"]))

    def test_a_killed_worker_costs_nothing_but_time(self) -> None:
        run = Run(*self.scenes, "--out", str(self.out()), "--workers", "2", "--shards", "6")
        run.hears(r"^1/6 shards")
        worker, command = until(lambda: working(psutil.Process(run.process.pid)), "no worker is at a shard")
        # Whatever listens, listens to this machine alone.
        listening = listeners(psutil.Process(run.process.pid))
        self.assertGreater(len(listening), 3)
        self.assertEqual({address for address in listening if address != "127.0.0.1"}, set())
        worker.send_signal(signal.SIGKILL)
        code, answer = run.ends()
        self.assertEqual(code, 0, run.words)
        self.assertEqual((answer["merkle"], answer["items"]), (self.root, SCENES))
        # Nobody reads what it says any more.
        until(lambda: not command.is_running(), "the command line of the killed worker goes on")

    @unittest.skipIf(os.name == "nt", "the command is a shell script here")
    def test_a_shard_that_kills_its_workers_is_given_up_and_the_others_are_made(self) -> None:
        out = self.out()
        command = self.folder / "deadly"
        command.write_text(f'#!/bin/sh\ncase "$*" in *"--shard 1/3"*) kill -9 $PPID; exit 1;; esac\nexec {shlex.join(ROCK_FIELD)} "$@"\n')
        command.chmod(0o755)
        run = Run(*self.scenes, "--out", str(out), "--workers", "2", "--shards", "3", "--retries", "1", "--rock-field", str(command))
        code, answer = run.ends()
        self.assertEqual((code, answer), (1, {}), run.words)
        self.assertIn("shard 1 was given up: 2 workers died while they had it", run.words)
        self.assertEqual(self.whole(out), SCENES - len(range(1, SCENES, 3)))

    def test_a_lost_scheduler_ends_in_words_and_the_same_command_makes_what_is_missing(self) -> None:
        out = self.out()
        file = self.folder / "scheduler.json"
        dask = [sys.executable, "-m"]
        scheduler = subprocess.Popen(
            [*dask, "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(file)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.addCleanup(scheduler.wait)
        self.addCleanup(scheduler.kill)
        until(lambda: file.exists() and file.stat().st_size > 0, "there is no scheduler")
        workers = subprocess.Popen(
            [*dask, "distributed.cli.dask_worker", "--scheduler-file", str(file), "--nworkers", "1", "--nthreads", "1", "--host", "127.0.0.1", "--no-dashboard"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.addCleanup(workers.wait)
        self.addCleanup(workers.terminate)
        run = Run(*self.scenes, "--out", str(out), "--shards", "6", "--scheduler", json.loads(file.read_text())["address"])
        run.hears(r"^2/6 shards")
        scheduler.kill()
        code, _ = run.ends()
        self.assertEqual(code, 4, run.words)
        self.assertIn("the scheduler was lost. What was finished stays", run.words)
        self.assertNotIn("Traceback", run.words)
        # What the workers had begun ends with them.
        workers.wait(HANGS)
        until(lambda: not working_on(out), "a command line goes on")
        there = self.whole(out)
        self.assertTrue(0 < there < SCENES, there)
        code, answer = Run(*self.scenes, "--out", str(out), "--workers", "2").ends()
        self.assertEqual((code, answer["merkle"], answer["made"], answer["skipped"]), (0, self.root, SCENES - there, there))
        # One file is spoilt on purpose.
        spoilt = next((out / "scenes").rglob("000007-*"))
        spoilt.write_bytes(spoilt.read_bytes()[:-1] + b"!")
        code, answer = Run(*self.scenes, "--out", str(out), "--workers", "1").ends()
        self.assertEqual((code, answer["merkle"], answer["made"], answer["skipped"]), (0, self.root, 1, SCENES - 1))

    def test_what_cannot_be_begun_is_said_before_a_cluster_is_started(self) -> None:
        out = str(self.out())
        bad = self.folder / "bad.txt"
        bad.write_text("preset=riverbad\n")
        cases: list[tuple[int, str, Sequence[str]]] = [
            (2, "Did you mean riverbed", [str(bad), "--out", out]),
            (2, "which scenes", ["--out", out]),
            (2, "standard input", ["-", "--out", out]),
            (2, "leave one of them out", [*self.scenes, "--out", out, "--workers", "2", "--scheduler", "tcp://127.0.0.1:1"]),
            (4, "no scheduler at tcp://127.0.0.1:1", [*self.scenes, "--out", out, "--scheduler", "tcp://127.0.0.1:1"]),
            (2, "belongs to another batch", [*self.scenes, "--out", str(self.folder / "straight"), "--", "--target", "print"]),
            (2, "no program", [*self.scenes, "--out", out, "--rock-field", "no-such-program"]),
        ]
        for code, words, arguments in cases:
            run = Run(*arguments)
            self.assertEqual(run.ends()[0], code, run.words)
            self.assertIn(words, run.words)
        self.assertFalse(Path(out).exists())

    @unittest.skipIf(os.name == "nt", "Windows has no SIGINT for others")
    def test_ctrl_c_leaves_what_is_finished_and_nothing_that_runs(self) -> None:
        out = self.out()
        run = Run(*self.scenes, "--out", str(out), "--workers", "1", "--shards", "6")
        run.hears(r"^1/6 shards")
        run.process.send_signal(signal.SIGINT)
        code, _ = run.ends()
        self.assertEqual(code, 130, run.words)
        self.assertIn("the same command goes on", run.words)
        self.assertNotIn("Traceback", run.words)
        until(lambda: not working_on(out), "a command line goes on")
        self.assertGreater(self.whole(out), 0)

    def test_the_wheel_has_the_command_its_types_and_its_licences(self) -> None:
        out = self.out()
        built = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", str(out)]
        subprocess.run(built, cwd=ROOT / "python", check=True, capture_output=True, timeout=HANGS)
        [wheel] = out.iterdir()
        with zipfile.ZipFile(wheel) as archive:
            names = archive.namelist()
            points = archive.read(next(name for name in names if name.endswith("entry_points.txt"))).decode()
            metadata = archive.read(next(name for name in names if name.endswith("METADATA"))).decode()
        self.assertIn("rock-field-dask = rock_field_dask.main:main", points)
        for wanted in ("rock_field_dask/py.typed", "rock_field_dask/shards.py", "LICENSE-MIT", "LICENSE-APACHE"):
            self.assertTrue(any(name.endswith(wanted) for name in names), wanted)
        version = json.loads((ROOT / "package.json").read_text())["version"]
        self.assertIn(f"\nVersion: {version}\n", metadata)

    def test_the_kubernetes_job_is_valid_and_its_arguments_make_the_batch(self) -> None:
        schema = json.loads((ROOT / "tests" / "data" / "kubernetes-job.schema.json").read_text())
        validator = jsonschema.Draft202012Validator(schema)
        folder = ROOT / "examples" / "kubernetes"
        job, merge = (yaml.safe_load((folder / name).read_text()) for name in ("job.yaml", "merge.yaml"))
        for document in (job, merge):
            self.assertEqual([error.message for error in validator.iter_errors(document)], [])
        self.assertNotEqual([*validator.iter_errors({**job, "spec": {**job["spec"], "completion": 3}})], [])
        shards, fewer = job["spec"]["completions"], 3
        data = self.out()
        data.mkdir()
        shutil.copy(self.scenes[0], data / "scenes.txt")

        def arguments(document: dict[str, Any], index: int) -> list[str]:
            [container] = document["spec"]["template"]["spec"]["containers"]
            [volume] = container["volumeMounts"]
            given = [argument.replace("$(JOB_COMPLETION_INDEX)", str(index)).replace(volume["mountPath"], str(data)) for argument in container["args"]]
            return [re.sub(rf"/{shards}$", f"/{fewer}", argument) for argument in given]

        self.assertIn(f"0/{fewer}", arguments(job, 0))
        for index in range(fewer):
            self.assertEqual(rock_field(*arguments(job, index))[0], 0)
        code, lines, words = rock_field(*arguments(merge, 0))
        self.assertEqual((code, lines[-1]["merkle"]), (0, self.root), words)
        # Exit codes that end a job, or a shard, are those that the command line has.
        rules = [rule["onExitCodes"]["values"] for rule in job["spec"]["podFailurePolicy"]["rules"] if "onExitCodes" in rule]
        self.assertEqual(rules, [[2], [1]])

    def test_every_line_of_the_documents_is_a_command_that_can_be_begun(self) -> None:
        documents = [ROOT / "python" / "README.md", ROOT / "www" / "docs" / "pages" / "cluster.md"]
        lines = [line for document in documents for line in document.read_text().splitlines() if re.match(r" *rock-field-dask .*--out", line)]
        lines += [line for line in EPILOG.splitlines() if line.startswith("  rock-field-dask ")]
        self.assertGreater(len(lines), 9)
        plans = set()
        for line in lines:
            _, *words = shlex.split(line)
            cut = words.index("--") if "--" in words else len(words)
            options, others = parser().parse_args(words[:cut]), words[cut + 1 :]
            self.assertIn(options.list, [None, "scenes.txt"], line)
            plans.add(tuple([self.scenes[0]] * bool(options.list) + others))
        for plan in sorted(plans):
            code, answers, said = rock_field("batch", "plan", *plan)
            self.assertEqual(code, 0, f"{plan}: {said}")
            self.assertGreater(int(str(answers[-1]["items"])), 0)

    @unittest.skipIf(os.name == "nt", "the command is a shell script here")
    def test_the_template_of_open_job_description_makes_the_batch(self) -> None:
        folder = self.out()
        folder.mkdir()
        command = folder / "rock-field"
        command.write_text(f'#!/bin/sh\nexec {shlex.join(ROCK_FIELD)} "$@"\n')
        command.chmod(0o755)
        example = ROOT / "examples" / "open-job-description"
        shutil.copy(example / "rock-field-batch.yaml", folder)
        shutil.copy(self.scenes[0], folder / "scenes.txt")
        # As its README says.
        [line] = [line for line in (example / "README.md").read_text().splitlines() if line.startswith("openjd run ")]
        openjd = [str(Path(sys.executable).with_name("openjd")), *shlex.split(line)[1:], "-p", f"RockField={command}"]
        done = subprocess.run(openjd, cwd=folder, capture_output=True, text=True, timeout=HANGS)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(json.loads((folder / "rocks" / "manifest.json").read_text())["merkle"], self.root)


def working_on(folder: Path) -> list[psutil.Process]:
    """Command lines that write to a folder."""
    return [process for process in psutil.process_iter(["cmdline"]) if str(folder) in (process.info["cmdline"] or []) and "--shard" in process.info["cmdline"]]


if __name__ == "__main__":
    unittest.main()
