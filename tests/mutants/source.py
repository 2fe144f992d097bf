"""A copy of the source with many faults in it, of which each run of a test switches one on.

So the tests are built once for all faults. A function with faults begins with as many other bodies of itself, each
behind its switch.
"""

import json
import os
import re
import subprocess

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
WORK = os.path.join(os.environ.get("CARGO_TARGET_DIR", os.path.join(ROOT, "target")), "mutants")
TREE = os.path.join(WORK, "tree")
# The source without faults, as it was when the run began.
PLAIN = os.path.join(WORK, "plain")

SWITCH = "mutant_switch"


def read(path):
    with open(path, "rb") as file:
        return file.read().decode()


def write(path, text):
    """A file that has this text already keeps its time, so that builds are incremental."""
    if os.path.isfile(path) and read(path) == text:
        return
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(text.encode())


def copy():
    """The files of the repository as they are now."""
    answer = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                            capture_output=True)
    wanted = {name for name in answer.stdout.decode().split("\0") if name and os.path.isfile(os.path.join(ROOT, name))}
    sources = sorted(name for name in wanted if name.startswith("src/") and name.endswith(".rs"))
    for name in sources:
        write(os.path.join(PLAIN, name), read(os.path.join(ROOT, name)))
    for name in sorted(wanted.difference(sources)):
        with open(os.path.join(ROOT, name), "rb") as file:
            content = file.read()
        if name == "Cargo.toml":
            # What a fault leaves unused is no error here.
            content = content.replace(b'"deny"', b'"allow"')
        target = os.path.join(TREE, name)
        if os.path.isfile(target):
            with open(target, "rb") as file:
                if file.read() == content:
                    continue
        os.makedirs(os.path.dirname(target), exist_ok=True)
        with open(target, "wb") as file:
            file.write(content)
    for top in ("src", "tests"):
        for folder, _, names in os.walk(os.path.join(TREE, top)):
            for name in names:
                path = os.path.relpath(os.path.join(folder, name), TREE)
                if path not in wanted and path != f"src/{SWITCH}.rs":
                    os.remove(os.path.join(folder, name))
    return sources


def listed(folders):
    """All faults that cargo-mutants knows for these folders of src."""
    command = ["cargo", "mutants", "--list", "--json", "--diff"]
    for folder in folders:
        command += ["--file", f"src/{folder}/**"]
    answer = subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    return json.loads(answer.stdout)


def offset(text, place):
    """Of a line and a column, both from 1."""
    start = 0
    for _ in range(place["line"] - 1):
        start = text.index("\n", start) + 1
    return start + place["column"] - 1


def patched(file, mutant):
    answer = subprocess.run(["patch", "--quiet", "--output=-", os.path.join(PLAIN, file)], check=True,
                            input=mutant["diff"].encode(), capture_output=True)
    return answer.stdout.decode()


def body_of(text, function):
    """Where the body of a function begins, at its brace, and ends, behind its brace; None for what is no function."""
    if not function:
        return None
    start, end = (offset(text, function["span"][place]) for place in ("start", "end"))
    name = re.escape(function["function_name"].split("::")[-1])
    head = re.compile(r"\bfn\s+(?:r#)?" + name + r"\b").search(text, start, end)
    if not head or text[end - 1] != "}":
        return None
    depth = 0
    for at in range(head.end(), end):
        depth += {"(": 1, "[": 1, ")": -1, "]": -1}.get(text[at], 0)
        if text[at] == "{" and depth == 0:
            return at, end
    return None


class Copy:
    """The copy with the faults that are in it: numbers with their mutants."""

    def __init__(self, files):
        self.files = files
        self.places = {}

    def put_in(self, mutants):
        """Writes the source with all of these. Returns the numbers of those that stand in no function."""
        by_file: dict = {}
        for number, mutant in mutants.items():
            by_file.setdefault(mutant["file"], {})[number] = mutant
        self.places, outside = {}, []
        for file in self.files:
            text = read(os.path.join(PLAIN, file))
            if file in by_file:
                text, left = self.switched(file, text, by_file[file])
                outside += left
            if file == "src/lib.rs":
                text += f"\n#[doc(hidden)]\npub mod {SWITCH};\n"
            write(os.path.join(TREE, file), text)
        count = max(mutants, default=0) + 1
        write(os.path.join(TREE, "src", SWITCH + ".rs"),
              read(os.path.join(HERE, "switch.rs")) + f"\nconst COUNT: usize = {count};\n")
        return outside

    def put_in_alone(self, mutant):
        """Writes the source with one fault that no switch turns off."""
        self.put_in({})
        write(os.path.join(TREE, mutant["file"]), patched(mutant["file"], mutant))

    def switched(self, file, text, mutants):
        """The text with other bodies in the outermost functions that have faults."""
        bodies, outside = {}, []
        for number, mutant in mutants.items():
            body = body_of(text, mutant["function"])
            if body is None:
                outside.append(number)
            else:
                bodies[number] = body
        for number, (start, end) in bodies.items():
            around = [other for other in bodies.values() if other[0] <= start and end <= other[1]]
            bodies[number] = min(around)
        pieces, done = [], 0
        for start, end in sorted(set(bodies.values())):
            pieces.append(text[done:start + 1])
            done = start + 1
            first = "".join(pieces).count("\n") + 1
            numbers = sorted(number for number, body in bodies.items() if body == (start, end))
            for number in numbers:
                new = patched(file, mutants[number])
                other = new[start:len(new) - (len(text) - end)]
                line = "".join(pieces).count("\n") + 1
                pieces.append(f"\nif crate::{SWITCH}::on({number}) {{ return {other}; }}\n")
                self.places[number] = (file, line, "".join(pieces).count("\n"))
            pieces.append(text[done:end])
            done = end
            last = "".join(pieces).count("\n") + 1
            for number in numbers:
                self.places[number] += (first, last)
        return "".join(pieces) + text[done:], outside

    def at(self, file, line):
        """The faults whose body stands there, or all of the function."""
        here = {number: place for number, place in self.places.items() if place[0] == file}
        own = [number for number, place in here.items() if place[1] <= line <= place[2]]
        return own or [number for number, place in here.items() if place[3] <= line <= place[4]]
