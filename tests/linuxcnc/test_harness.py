"""What the tests themselves would notice."""

import os
import shutil
import subprocess
import tempfile
import unittest
from unittest import mock

import harness


class Harness(unittest.TestCase):
    def test_modules_that_come_to_an_end_are_noticed(self):
        with tempfile.TemporaryDirectory() as modules:
            harness.modules_with("collapse", modules)
            result = harness.run([["mdi", "G0 X1"], ["halcmd", "setp", "collapse.now", "1"]], modules=modules,
                                 hal="loadrt collapse\naddf collapse servo-thread\n", record=False)
        self.assertIn("come to an end before", str(result.failure), result.log)

    def test_only_a_folder_made_for_a_run_is_given_away(self):
        with tempfile.TemporaryDirectory(prefix="framepath-run.") as made, tempfile.TemporaryDirectory() as other:
            link = os.path.join(made, "link")
            os.symlink(other, link)
            refused = ["/", "/tmp", os.path.expanduser("~"), harness.ROOT, ".", other, link, os.path.join(made, ".."),
                       os.path.join(made, "missing"), os.path.join(other, "framepath-run.missing")]
            inside = os.path.join(made, "inside")
            os.mkdir(inside)
            owners = {folder: os.stat(folder).st_uid for folder in refused if os.path.exists(folder)}
            for keep, is_refused in [*((folder, True) for folder in refused), (inside, False), (made, False)]:
                # a folder of modules that has none ends it before it gives anything away
                done = subprocess.run([os.path.join(harness.HERE, "isolated"), other, "true"], env=dict(os.environ, KEEP=keep),
                                      capture_output=True, text=True, check=False)
                self.assertEqual("has to be a folder made for this" in done.stderr, is_refused, f"{keep}: {done.stderr}")
                self.assertNotEqual(done.returncode, 0, keep)
            for folder, owner in owners.items():
                self.assertEqual(os.stat(folder).st_uid, owner, folder)

    def test_nothing_is_removed_from_a_folder_that_is_no_debian(self):
        with tempfile.TemporaryDirectory() as roots:
            work = os.path.join(roots, "trixie", "framepath", "work")
            os.makedirs(work)
            done = subprocess.run([os.path.join(harness.ROOT, "tests", "debian", "run"), "13", "true"],
                                  env=dict(os.environ, ROOTS=roots), capture_output=True, text=True, check=False)
            self.assertNotEqual(done.returncode, 0, done.stderr)
            self.assertIn("is no Debian", done.stderr)
            self.assertTrue(os.path.exists(work))

    @unittest.skipIf(os.geteuid(), "LinuxCNC runs as who runs the tests, unless that is root")
    def test_what_only_root_may_read_or_enter(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("framekins.so", "blendtp.so"):
                shutil.copy(os.path.join(harness.MODULES, name), folder)
                os.chmod(os.path.join(folder, name), 0o600)
            self.assertEqual(harness.run([["mdi", "G0 X1"]], modules=folder, record=False).errors, [])
            told = f"nobody, who cannot get to {folder}/"
            with mock.patch("tempfile.tempdir", folder), self.assertRaisesRegex(RuntimeError, told):
                harness.run([])


if __name__ == "__main__":
    unittest.main()
