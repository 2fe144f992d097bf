"""make install and make uninstall, below a folder of their own."""

import glob
import os
import re
import resource
import shutil
import subprocess
import tempfile
import unittest

import harness


def run_make(target, *settings, **options):
    # What was built for the tests is installed; nothing is built anew.
    built = ["-o", "modules", "-o", "tool", f"MODULES={harness.MODULES}", f"TOOL={harness.TOOL}"]
    return subprocess.run(["make", "-C", harness.ROOT, *built, target, *settings], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False, **options)


def make(target, *settings, umask=-1):
    done = run_make(target, *settings, umask=umask)
    if done.returncode:
        raise AssertionError(done.stdout)
    return done.stdout


def put(folder, *names, text=""):
    """Files with this text, and their folders."""
    for name in names:
        path = os.path.join(folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


def files(folder):
    return {os.path.relpath(os.path.join(where, name), folder) for where, _, names in os.walk(folder) for name in names}


def fill_disk():
    """What is run then has room for small files only."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))


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
        self.assertEqual([line.split()[:3] for line in lines if harness.TOOL in line], [["echo", "755", harness.TOOL]])

    def test_with_another_prefix_zsh_finds_its_completions(self):
        with tempfile.TemporaryDirectory() as folder:
            make("install", f"DESTDIR={folder}", "PREFIX=/usr/local")
            there = files(folder)
            self.assertIn("usr/local/share/zsh/site-functions/_framepath", there)
            self.assertFalse([name for name in there if "vendor-completions" in name])
            make("uninstall", f"DESTDIR={folder}", "PREFIX=/usr/local")
            self.assertEqual(files(folder), set())

    def test_one_of_another_prefix_is_told_of(self):
        with tempfile.TemporaryDirectory() as folder:
            put(folder, "usr/local/bin/framepath")
            told = f"another one is there, {folder}/usr/local/bin/framepath: to remove it make uninstall PREFIX=/usr/local"
            self.assertIn(f"make install: {told}, then make install again\n", make("install", f"DESTDIR={folder}"))
            self.assertIn(f"make uninstall: {told}\n", make("uninstall", f"DESTDIR={folder}"))
            self.assertNotIn("another", make("uninstall", f"DESTDIR={folder}", "PREFIX=/usr/local"))

    def test_what_a_debian_package_has_installed_is_left_to_it(self):
        with tempfile.TemporaryDirectory() as folder:
            put(folder, "dpkg-query", text="#!/bin/sh\nfor name; do case $name in\n"
                                           '*/blendtp.so) echo "some-package: $name" ;; esac; done\n')
            os.chmod(os.path.join(folder, "dpkg-query"), 0o755)
            names = ("modules/blendtp.so", "usr/bin/framepath")
            put(folder, *names)
            places = (f"PREFIX={folder}/usr", f"MODULE_FOLDER={folder}/modules", f"EXAMPLES={folder}/examples")
            path = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}
            for goal in ("install", "uninstall"):
                code, said = self.run_copy(folder, "-o", "modules", "-o", "completions", goal, *places, env=path)
                self.assertEqual(code, 2)
                self.assertIn("belongs to the Debian package some-package, and nothing was changed: sudo apt remove some-package",
                              said)
                self.assertLess({*names}, files(folder))
            # below DESTDIR dpkg has nothing
            code, said = self.run_copy(folder, "uninstall", *places, "DESTDIR=/nonexistent", env=path)
            self.assertEqual(code, 0, said)

    def test_everybody_may_read_what_a_careful_root_installs(self):
        with tempfile.TemporaryDirectory() as folder:
            make("install", f"DESTDIR={folder}", umask=0o077)
            for where, _, names in os.walk(folder):
                if where != folder:
                    self.assertEqual(os.stat(where).st_mode & 0o777, 0o755, where)
                for name in names:
                    path = os.path.join(where, name)
                    if not os.path.islink(path):
                        self.assertIn(os.stat(path).st_mode & 0o777, (0o644, 0o755), name)

    def test_what_an_older_one_had_goes_and_what_runs_left_behind_is_not_installed(self):
        with tempfile.TemporaryDirectory() as folder:
            share = os.path.join(folder, "usr/share/framepath")
            older = ("subroutines/gone.ngc", "panel/gone.hal", "preview/gone.py", "configs/framepath-gone/gone.ini")
            kept = ("configs/framepath-sim/framepath-sim.var", "configs/framepath-sim/mine.ngc",
                    "configs/framepath-sim/mine.ini", "configs/mine/mine.ini", "subroutines/mine.ngc", "panel/mine.hal")
            put(share, *older)
            put(share, *kept, text="../../mine\n")
            put(share, "installed-files", text="".join(f"{name}\n" for name in older))
            left = os.path.join(harness.SAMPLES, "configs/framepath-lathe/position.txt")
            put("", left)
            try:
                said = make("install", f"DESTDIR={folder}")
                ignored = subprocess.run(["git", "-C", harness.ROOT, "check-ignore", left], capture_output=True, check=False)
            finally:
                os.remove(left)
            there = files(share)
            self.assertEqual(there & {*older, "configs/framepath-lathe/position.txt"}, set())
            self.assertFalse(os.path.exists(os.path.join(share, "configs/framepath-gone")))
            self.assertNotIn("left in", said)
            # again, with a list of this one
            make("install", f"DESTDIR={folder}")
            for name in kept:
                with open(os.path.join(share, name), encoding="utf-8") as file:
                    self.assertEqual(file.read(), "../../mine\n", name)
            said = make("uninstall", f"DESTDIR={folder}")
            self.assertEqual(files(folder), {os.path.join("usr/share/framepath", name) for name in kept})
            self.assertIn(f"left, since framepath has not put them there:\n{share}/", said)
            # 128: this source is not a clone of git
            self.assertIn(ignored.returncode, (0, 128))

    def test_one_that_fails_leaves_all_as_it_was(self):
        with tempfile.TemporaryDirectory() as folder:
            there = os.path.join(folder, "there")
            make("install", f"DESTDIR={there}")
            with open(os.path.join(there, "usr/share/framepath/installed-files"), "a", encoding="utf-8") as file:
                file.write("subroutines/gone.ngc\n")
            put(there, "usr/share/framepath/subroutines/gone.ngc")
            # neither touched nor replaced
            before = self.looks(there)
            for limit, settings in ((fill_disk, ()), (None, (f"MODULES={folder}/nothing",))):
                with self.subTest(settings=settings):
                    done = run_make("-o", "completions", "install", f"DESTDIR={there}", *settings, preexec_fn=limit)
                    self.assertNotEqual(done.returncode, 0)
                    self.assertIn("make install: nothing was changed\n", done.stdout)
                    self.assertEqual(self.looks(there), before)
            new = os.path.join(folder, "new")
            self.assertNotEqual(run_make("-o", "completions", "install", f"DESTDIR={new}", preexec_fn=fill_disk).returncode, 0)
            self.assertFalse(os.path.exists(new))
            os.remove(os.path.join(there, "usr/bin/framepath"))
            put(there, "usr/bin/framepath/mine")
            done = run_make("install", f"DESTDIR={there}")
            self.assertIn(f"{there}/usr/bin/framepath is a folder: move it away", done.stdout)
            self.assertTrue(os.path.exists(os.path.join(there, "usr/share/framepath/subroutines/gone.ngc")))

    def looks(self, folder):
        """Which files and folders are there, and since when."""
        paths = glob.glob("**", root_dir=folder, recursive=True, include_hidden=True)
        return {path: (os.lstat(os.path.join(folder, path)).st_ino, os.lstat(os.path.join(folder, path)).st_size)
                for path in paths}

    def test_over_an_older_one_without_a_list_only_what_this_one_has_is_replaced(self):
        with tempfile.TemporaryDirectory() as folder:
            share = os.path.join(folder, "usr/share/framepath")
            put(share, "subroutines/gone.ngc", "subroutines/trans.ngc")
            said = make("install", f"DESTDIR={folder}")
            self.assertRegex(said, f"left in {share}, since .*\nsubroutines/gone.ngc\n(?!subroutines)")
            self.assertGreater(os.path.getsize(os.path.join(share, "subroutines/trans.ngc")), 0)
            os.remove(os.path.join(share, "installed-files"))
            make("uninstall", f"DESTDIR={folder}")
            self.assertEqual(files(folder), {"usr/share/framepath/subroutines/gone.ngc"})

    def run_copy(self, folder, *arguments, **options):
        """make with nothing but the Makefile, in a folder; its code and what it says of errors."""
        shutil.copy(os.path.join(harness.ROOT, "Makefile"), folder)
        done = subprocess.run(["make", "-C", folder, *arguments], capture_output=True, text=True, check=False, **options)
        return done.returncode, done.stderr

    def test_a_path_with_a_blank_is_refused(self):
        with tempfile.TemporaryDirectory(prefix="a b.") as folder:
            code, said = self.run_copy(folder, "modules")
        self.assertEqual(code, 2)
        self.assertIn(f"CURDIR={folder} has a blank", said)
        with tempfile.TemporaryDirectory() as folder:
            for setting in ("DESTDIR=/nonexistent/my tools", "PREFIX=/nonexistent ", "LINUXCNC_SOURCE=/nonexistent/linux cnc"):
                with self.subTest(setting=setting):
                    code, said = self.run_copy(folder, "-n", "uninstall", setting)
                    self.assertEqual(code, 2)
                    self.assertIn(f"{setting} has a blank", said)

    def test_a_path_that_leads_elsewhere_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            for setting, words in (
                    # in a sample that has been copied it would begin elsewhere
                    ("PREFIX=opt", f"PREFIX=opt does not begin with /: take the whole path, {folder}/opt"),
                    ("PREFIX=", "PREFIX= does not begin with /: take the whole path, /usr"),
                    # sed would put into the samples what it replaces
                    ("PREFIX=/a&b", "PREFIX=/a&b has &, which"),
                    *((f"{name}=/a{character}b", f"{name}=/a{character}b has {character}, which")
                      for name in ("PREFIX", "DESTDIR", "CARGO_TARGET_DIR", "LINUXCNC_SOURCE")
                      for character in "'\"`;|\\*(")):
                with self.subTest(setting=setting):
                    code, said = self.run_copy(folder, "-n", "uninstall", setting)
                    self.assertEqual(code, 2)
                    self.assertIn(words, said)

    def test_cargo_builds_where_make_looks_whatever_its_own_configuration_says(self):
        with tempfile.TemporaryDirectory() as folder:
            put(folder, "hal-component/Makefile", text="built-for all:\n\techo $(CARGO_TARGET_DIR) >&2\n")
            put(folder, "cargo", text='#!/bin/sh\necho "$CARGO_TARGET_DIR" >&2\n')
            os.chmod(os.path.join(folder, "cargo"), 0o755)
            environment = {name: value for name, value in os.environ.items() if name != "CARGO_TARGET_DIR"}
            for settings, target in (((), "target"), (("CARGO_TARGET_DIR=build/out",), "build/out")):
                with self.subTest(target=target):
                    code, said = self.run_copy(folder, "-s", "-o", "prerequisites", f"CARGO={folder}/cargo", "modules", *settings,
                                               env=environment)
                    self.assertEqual(code, 0, said)
                    self.assertEqual(said.splitlines(), [os.path.join(folder, target)] * 3)

    def test_who_may_not_build_on_what_another_has_built_is_told_before_the_build(self):
        with tempfile.TemporaryDirectory() as folder:
            put(folder, "target/realtime/deps/built")
            os.chmod(folder, 0o755)
            nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
            for place, mode in (("target/realtime/deps", 0o555), ("target/realtime/deps/built", 0o444)):
                for name in ("target", "target/realtime", "target/realtime/deps", "target/realtime/deps/built"):
                    os.chmod(os.path.join(folder, name), mode if name == place else 0o777)
                for goal in ("modules", "tool"):
                    code, said = self.run_copy(folder, "-o", "prerequisites", "CARGO=true", goal, **nobody,
                                               env={**os.environ, "CARGO_TARGET_DIR": "target"})
                    self.assertEqual(code, 2)
                    self.assertIn(f"may not write {folder}/{place}, which belongs to ", said)
                    self.assertIn("sudo chown -R ", said)
                    self.assertIn(f" {folder}/target, or make CARGO_TARGET_DIR=", said)

    def test_who_may_not_write_there_is_told_before_the_build(self):
        with tempfile.TemporaryDirectory() as folder:
            there = os.path.join(folder, "usr")
            os.mkdir(there)
            os.chmod(folder, 0o755)
            os.chmod(there, 0o555)
            nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
            code, said = self.run_copy(folder, "install", f"DESTDIR={folder}", **nobody)
        self.assertEqual(code, 2)
        self.assertIn(f"may not write {there}/lib/linuxcnc/modules: sudo make install, or make install DESTDIR=", said)


if __name__ == "__main__":
    unittest.main()
