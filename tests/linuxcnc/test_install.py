"""make install and make uninstall, below a folder of their own."""

import glob
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import harness


def make(target, *settings):
    # What was built for the tests is installed; nothing is built anew.
    built = ["-o", "modules", "-o", "tool", f"MODULES={harness.MODULES}", f"TOOL={harness.TOOL}"]
    done = subprocess.run(["make", "-C", harness.ROOT, *built, target, *settings], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        raise AssertionError(done.stdout)


def files(folder):
    return {os.path.relpath(os.path.join(where, name), folder) for where, _, names in os.walk(folder) for name in names}


class Install(unittest.TestCase):
    def test_everything_is_put_where_linuxcnc_looks_and_removed_again(self):
        with tempfile.TemporaryDirectory() as folder:
            make("install", f"DESTDIR={folder}")
            there = files(folder)
            for name in ("usr/lib/linuxcnc/modules/framekins.so", "usr/lib/linuxcnc/modules/blendtp.so",
                         "usr/bin/framepath", "usr/share/man/man1/framepath.1", "usr/share/man/man9/framekins.9",
                         "usr/share/man/man9/blendtp.9", "usr/share/framepath/subroutines/trans.ngc",
                         *(f"usr/share/framepath/subroutines/frame_{part}.py"
                           for part in ("guard", "heart", "offsets", "settings")),
                         "usr/share/bash-completion/completions/framepath", "usr/share/zsh/vendor-completions/_framepath",
                         "usr/share/fish/vendor_completions.d/framepath.fish",
                         *(f"usr/share/framepath/preview/{part}.py" for screen in ("axis", "gmoccapy", "qtvcp")
                           for part in (f"frame_{screen}", f"{screen}_frames")),
                         "usr/share/framepath/configs/framepath-sim/framepath-sim.ini",
                         "usr/share/framepath/configs/framepath-lathe/thread.ngc",
                         "usr/share/framepath/configs/framepath-gantry/sheet.ngc",
                         "usr/share/framepath/configs/framepath-inch/plate.ngc",
                         *(f"usr/share/framepath/panel/{name}" for name in ("time_table.py", "planner.xml", "frame.xml",
                                                                            "panel.ui", "panel_window.hal",
                                                                            "panel_ui_xyzac.hal"))):
                self.assertIn(name, there)
            with open(os.path.join(folder, "usr/share/zsh/vendor-completions/_framepath"), encoding="utf-8") as file:
                self.assertEqual(file.readline(), "#compdef framepath\n")
            configs = os.path.join(folder, "usr/share/framepath/configs")
            # LinuxCNC's selector of configurations offers them, and what it copies for the user finds all that it needs
            self.assertEqual(os.readlink(os.path.join(folder, "usr/share/linuxcnc/aux_examples/framepath")),
                             "/usr/share/framepath/configs")
            named = set()
            panel = os.path.join(folder, "usr/share/framepath/panel/*.hal")
            for path in [*glob.glob(os.path.join(configs, "*", "*.ini")), *glob.glob(os.path.join(configs, "*", "*.hal")),
                         *glob.glob(panel)]:
                with open(path, encoding="utf-8") as file:
                    text = file.read()
                self.assertNotIn("../", text, path)
                named |= set(re.findall(r"/usr/share/framepath/[\w/.]+", text))
            self.assertIn("/usr/share/framepath/subroutines/frame_guard.py", named)
            for path in named:
                self.assertTrue(os.path.exists(folder + path.rstrip(".")), path)
            make("uninstall", f"DESTDIR={folder}")
            self.assertEqual(files(folder), set())

    def test_what_was_built_is_only_copied(self):
        # root installs what a user without rights has built
        command = ["make", "-n", "-C", harness.ROOT, "-o", "modules", "-o", "completions", f"TOOL={harness.TOOL}", "install"]
        lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
        self.assertEqual({line.split()[0] for line in lines if harness.TOOL in line}, {"install"})

    def test_a_path_with_a_blank_is_refused(self):
        with tempfile.TemporaryDirectory(prefix="a b.") as folder:
            shutil.copy(os.path.join(harness.ROOT, "Makefile"), folder)
            done = subprocess.run(["make", "-C", folder, "modules"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"CURDIR={folder} has a blank", done.stderr)


if __name__ == "__main__":
    unittest.main()
