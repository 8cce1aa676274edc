#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures the strength of the tests: changes one token of the library at a time and runs the tests.

Sites are drawn by seed from the code of orb/ and vo/ that is compiled (.cpp files; comments, strings
and preprocessor lines left out). A mutant is killed if a test fails, crashes or hangs; mutants that
do not compile or whose object code equals the original are replaced by other draws. Results are
appended to build/mutation/results.jsonl, so that an interrupted run goes on where it ended.

usage: scripts/mutation_test.py [--count 200] [--seed 1] [--jobs 2]
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import queue
import random
import re
import resource
import subprocess
import threading

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "mutation"
# clang-format puts spaces around binary operators and none inside template arguments.
OPERATORS = {
    " < ": " <= ", " <= ": " < ", " > ": " >= ", " >= ": " > ", " == ": " != ", " != ": " == ",
    " + ": " - ", " - ": " + ", " * ": " / ", " / ": " * ", " && ": " || ", " || ": " && ",
    " += ": " -= ", " -= ": " += ", "++": "--", " ? ": " ? !", "return true": "return false",
    "return false": "return true", "std::min(": "std::max(", "std::max(": "std::min(",
    "break;": ";", "continue;": ";", "if (!": "if (", "if (": "if (!",
}
TOKEN = re.compile("|".join(re.escape(t) for t in sorted(OPERATORS, key=len, reverse=True)) +
                   r"|(?<![\w.'])\d+(?:\.\d+)?(?![\w.'])")
# Test executables and their tests in the order in which they are run, by the top-level folder of
# the mutant. The tests of the changed file (SUITE) run first.
SYSTEM_TESTS = [("system/test_system", "ReferenceFigures.*"), ("vo/test_vo", "*")]
TESTS = {
    "orb": [("orb/test_orb", "*SUITE*"), ("orb/test_orb", "*"), ("orb/test_kernels", "*"),
            *SYSTEM_TESTS],
    "vo": [("vo/test_vo", "*SUITE*"), *SYSTEM_TESTS],
}
# Of the processor and of the clock: a mutant that takes longer hangs. Busy machines have much of the
# latter.
TIMEOUT_CPU_S, TIMEOUT_S = 300, 3600


def code_lines(text):
    """Yields (index, line with strings and comments blanked) of lines that hold code."""
    for index, line in enumerate(text.split("\n")):
        stripped = line.strip()
        if stripped.startswith(("#", "//", "template", "namespace", "static_assert")):
            continue
        line = re.sub(r'"(?:[^"\\]|\\.)*"', lambda m: '"' + "_" * (len(m[0]) - 2) + '"', line)
        line = re.sub(r"//.*", "", line)
        if line.strip():
            yield index, line


def sites_of(path):
    text = (ROOT / path).read_text()
    for index, line in code_lines(text):
        for match in TOKEN.finditer(line):
            token = match[0]
            new = OPERATORS.get(token)
            if new is None:
                # A threshold that is off by one changes little; one of twice the size should show.
                is_small = token.isdigit() and int(token) < 3
                new = str(int(token) + 1) if is_small else str(float(token) * 2)
                new = new.removesuffix(".0") if token.isdigit() else new
            yield {"file": path, "line": index + 1, "column": match.start(), "old": token,
                   "new": new}


def all_sites():
    files = sorted(str(p.relative_to(ROOT)) for d in ("orb", "vo")
                   for p in (ROOT / d).rglob("*.cpp"))
    return [site for path in files for site in sites_of(path)]


def digest(path):
    return hashlib.sha1(path.read_bytes()).hexdigest()


def limit_processor_time():
    resource.setrlimit(resource.RLIMIT_CPU, (TIMEOUT_CPU_S, TIMEOUT_CPU_S))


class Worker:
    """A copy of the sources with its own build folder."""

    def __init__(self, number):
        self.source = WORK / f"source{number}"
        self.build = WORK / f"build{number}"
        if not self.source.exists():
            subprocess.run(["git", "clone", "--quiet", ROOT, self.source], check=True)
        subprocess.run(["git", "pull", "--quiet"], cwd=self.source, check=True)
        subprocess.run(["git", "checkout", "--quiet", "."], cwd=self.source, check=True)
        subprocess.run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja",
                        "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -D_GLIBCXX_ASSERTIONS",
                        "-DCORVO_BUILD_BENCHMARKS=OFF"], check=True, capture_output=True)
        if self.compile(TESTS["orb"]).returncode != 0:
            raise SystemExit("the unchanged sources do not compile")
        if self.run_tests({"file": "orb/"}):
            raise SystemExit("a test of the unchanged sources fails")
        self.digests = {path: digest(path) for path in self.build.rglob("*.cpp.o")}

    def compile(self, tests):
        targets = sorted({pathlib.Path(test).name for test, _ in tests})
        return subprocess.run(["cmake", "--build", self.build, "--parallel", "1", "--target",
                               *targets], capture_output=True)

    def changes_objects(self, path):
        """Returns whether the object code of a file differs from that of the unchanged sources."""
        objects = [p for p in self.digests if p.name == pathlib.Path(path).name + ".o"]
        return any(digest(p) != self.digests[p] for p in objects)

    def run_tests(self, site):
        """Returns whether a test notices."""
        top = site["file"].split("/")[0]
        stem = pathlib.Path(site["file"]).stem
        suite = "".join(word.capitalize() for word in stem.split("_"))
        environment = {k: v for k, v in os.environ.items() if k not in ("CORVO_DATA", "CI")}
        for name, pattern in TESTS[top]:
            command = [self.build / "tests" / name, "--gtest_fail_fast", "--gtest_brief=1",
                       "--gtest_filter=" + pattern.replace("SUITE", suite)]
            try:
                done = subprocess.run(command, capture_output=True, env=environment,
                                      timeout=TIMEOUT_S, preexec_fn=limit_processor_time)
            except subprocess.TimeoutExpired:
                return True
            if done.returncode != 0:
                return True
        return False

    def judge(self, site):
        path = self.source / site["file"]
        original = path.read_text()
        lines = original.split("\n")
        line, column = lines[site["line"] - 1], site["column"]
        lines[site["line"] - 1] = line[:column] + site["new"] + line[column + len(site["old"]):]
        path.write_text("\n".join(lines))
        try:
            if self.compile(TESTS[site["file"].split("/")[0]]).returncode != 0:
                return "does not compile"
            if not self.changes_objects(site["file"]):
                return "equivalent"
            return "killed" if self.run_tests(site) else "survived"
        finally:
            path.write_text(original)  # Compiled again with the next mutant.


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    WORK.mkdir(parents=True, exist_ok=True)
    results_file = WORK / "results.jsonl"
    results = []
    if results_file.exists():
        results = [json.loads(line) for line in results_file.read_text().splitlines()]
    sites = all_sites()
    random.Random(arguments.seed).shuffle(sites)
    known = {json.dumps(r["site"], sort_keys=True) for r in results}
    todo = queue.SimpleQueue()
    for site in sites:
        if json.dumps(site, sort_keys=True) not in known:
            todo.put(site)
    lock = threading.Lock()

    def num_judged():
        return sum(r["status"] in ("killed", "survived") for r in results)

    def work(number):
        worker = Worker(number)
        while num_judged() < arguments.count:
            site = todo.get()
            result = {"site": site, "status": worker.judge(site)}
            with lock, results_file.open("a") as out:
                results.append(result)
                out.write(json.dumps(result) + "\n")

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for future in [pool.submit(work, n) for n in range(arguments.jobs)]:
            future.result()
    killed = sum(r["status"] == "killed" for r in results)
    for r in results:
        if r["status"] == "survived":
            s = r["site"]
            print(f"survived: {s['file']}:{s['line']}:{s['column'] + 1}: "
                  f"'{s['old'].strip()}' -> '{s['new'].strip()}'")
    print(f"{killed} of {num_judged()} mutants killed")


if __name__ == "__main__":
    main()
