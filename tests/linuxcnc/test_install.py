"""make install and make uninstall, below a folder of their own."""

import os
import subprocess
import tempfile
import unittest

import harness


def make(target, folder):
    # What was built for the tests is installed; nothing is built anew.
    built = ["-o", "modules", "-o", "tool", f"MODULES={harness.MODULES}", f"TOOL={harness.TOOL}"]
    done = subprocess.run(["make", "-C", harness.ROOT, *built, target, f"DESTDIR={folder}"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        raise AssertionError(done.stdout)


def files(folder):
    return {os.path.relpath(os.path.join(where, name), folder) for where, _, names in os.walk(folder) for name in names}


class Install(unittest.TestCase):
    def test_everything_is_put_where_linuxcnc_looks_and_removed_again(self):
        with tempfile.TemporaryDirectory() as folder:
            make("install", folder)
            there = files(folder)
            for name in ("usr/lib/linuxcnc/modules/framekins.so", "usr/lib/linuxcnc/modules/blendtp.so",
                         "usr/bin/framepath", "usr/share/man/man1/framepath.1", "usr/share/man/man9/framekins.9",
                         "usr/share/man/man9/blendtp.9", "usr/share/framepath/subroutines/trans.ngc",
                         *(f"usr/share/framepath/subroutines/frame_{part}.py"
                           for part in ("guard", "heart", "offsets", "settings")),
                         "usr/share/bash-completion/completions/framepath", "usr/share/zsh/vendor-completions/_framepath",
                         "usr/share/fish/vendor_completions.d/framepath.fish",
                         "usr/share/framepath/preview/frame_axis.py", "usr/share/framepath/preview/axis_frames.py",
                         "usr/share/framepath/configs/framepath-sim/framepath-sim.ini"):
                self.assertIn(name, there)
            with open(os.path.join(folder, "usr/share/zsh/vendor-completions/_framepath"), encoding="utf-8") as file:
                self.assertEqual(file.readline(), "#compdef framepath\n")
            # the samples find the subroutines by the same relative path as in the repository
            ini = os.path.join(folder, "usr/share/framepath/configs/framepath-sim/framepath-sim.ini")
            with open(ini, encoding="utf-8") as file:
                path = next(line.split("=")[1].strip() for line in file if line.startswith("SUBROUTINE_PATH"))
            self.assertTrue(os.path.exists(os.path.join(os.path.dirname(ini), path.split(":")[0], "trans.ngc")), path)
            make("uninstall", folder)
            self.assertEqual(files(folder), set())


if __name__ == "__main__":
    unittest.main()
