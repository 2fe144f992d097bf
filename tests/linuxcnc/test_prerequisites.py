"""prerequisites: which cargo it asks, and what it says where it cannot go on. Nothing is installed."""

import os
import subprocess
import tempfile
import unittest

import harness


class Prerequisites(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        # all that is there, but for what a test puts in its place, or leaves out
        self.commands = os.path.join(self.folder, "commands")
        os.mkdir(self.commands)
        for name in os.listdir("/usr/bin"):
            if name not in ("sudo", "cargo", "apt-get", "id"):
                os.symlink(os.path.join("/usr/bin", name), os.path.join(self.commands, name))
        self.put("commands/apt-get", "echo apt-get \"$@\"")

    def put(self, name, line):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(f"#!/bin/sh\n{line}\n")
        os.chmod(path, 0o755)
        return path

    def run_with(self, text=None, **environment):
        """Its code and what it says; of the script with another text where that is given."""
        script = os.path.join(harness.ROOT, "prerequisites")
        if text:
            script = self.put("prerequisites", text)
        done = subprocess.run([script], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                              env=dict(PATH=self.commands, **environment))
        return done.returncode, done.stdout

    def text(self):
        with open(os.path.join(harness.ROOT, "prerequisites"), encoding="utf-8") as file:
            return file.read()

    def test_the_cargo_that_make_runs_is_asked(self):
        self.put("commands/id", "echo 0")
        self.put("commands/cargo", "echo cargo 1.75.0")
        newer = self.put("newer", "echo cargo 1.95.0")
        for cargo in (newer, f"{newer} +stable"):
            code, said = self.run_with(CARGO=cargo)
            self.assertEqual(code, 0, said)
            self.assertNotIn("cargo", said)

    def test_an_older_cargo_in_front_is_named_with_what_to_write(self):
        self.put("commands/id", "echo 0")
        self.put("commands/cargo", "echo cargo 1.75.0")
        debian = self.put("debian-cargo", "echo cargo 1.96.0")
        code, said = self.run_with(self.text().replace("/usr/bin/cargo", debian))
        self.assertEqual(code, 1)
        self.assertIn("cargo 1.90 or newer is needed, found: cargo 1.75.0", said)
        self.assertIn(f"make CARGO={debian} RUSTC=/usr/bin/rustc", said)
        self.assertIn("rustup update stable", said)

    def test_without_sudo_it_says_what_root_has_to_install(self):
        self.put("commands/id", "echo 1000")
        code, said = self.run_with()
        self.assertEqual(code, 1)
        self.assertRegex(said, r"sudo is not there; as root: apt-get install --no-install-recommends.* cargo-web rustc-web\n")
        self.assertNotIn("installing", said)

    def test_nothing_is_installed_where_apt_would_remove_something_for_it(self):
        self.put("commands/id", "echo 0")
        self.put("commands/cargo", "echo cargo 1.85.0")
        self.put("commands/apt-get", 'echo apt-get "$@"\n[ "$2" != --simulate ] || printf "Remv cargo [1.85.0]\\nRemv rustup [1.27]\\n"')
        code, said = self.run_with()
        self.assertEqual(code, 1)
        self.assertIn("nothing is installed, since apt would remove what is there: cargo rustup\n", said)
        self.assertRegex(said, "where you can do without: apt-get install --no-install-recommends.* cargo-web rustc-web\n")
        self.assertIn("cargo 1.90 or newer of rustup's", said)
        self.assertNotIn("apt-get install -y", said)

    def test_apt_is_told_to_remove_nothing(self):
        self.put("commands/id", "echo 0")
        self.put("commands/cargo", "echo cargo 1.85.0")
        self.assertRegex(self.run_with()[1], "apt-get install -y .*--no-remove .* cargo-web rustc-web\n")

    def test_beside_a_linuxcnc_that_is_run_in_place_none_is_installed(self):
        self.put("commands/id", "echo 0")
        text = self.text().replace("/usr/lib/linuxcnc/modules", self.folder)
        self.assertIn("linuxcnc-uspace", self.run_with(text, LINUXCNC_INCLUDE="/nonexistent")[1])
        said = self.run_with(text, LINUXCNC_INCLUDE="/nonexistent", LINUXCNC_IN_PLACE="/nonexistent")[1]
        self.assertNotIn("linuxcnc-uspace", said)


if __name__ == "__main__":
    unittest.main()
