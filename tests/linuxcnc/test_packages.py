"""make deb and make deb-source: what the packages hold and ask for, and what is said where framepath cannot be built."""

import glob
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import pytest

import harness
from test_install import make

DEBIAN = os.path.join(harness.ROOT, "debian")


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


@pytest.mark.thorough
class Packages(unittest.TestCase):
    def package(self, target, name):
        """The package that a target of make leaves, with its fields and its files."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        make(target, f"PACKAGE={folder.name}")
        found = glob.glob(os.path.join(folder.name, "*.deb"))
        self.assertEqual([os.path.basename(path).split("_")[0] for path in found], [name])
        files = {line.split()[5].removeprefix(".") for line in output("dpkg-deb", "--contents", found[0]).splitlines()}
        return found[0], files

    def field(self, package, name):
        return output("dpkg-deb", "--field", package, name).strip()

    def assert_version(self, package):
        with open(os.path.join(harness.ROOT, "Cargo.toml"), encoding="utf-8") as file:
            found = re.search(r'^version = "(.*)"', file.read(), re.MULTILINE)
        assert found
        self.assertEqual(self.field(package, "Version").split("+")[0], found.group(1))

    def test_for_this_machine(self):
        package, files = self.package("deb", "framepath")
        self.assert_version(package)
        depends = self.field(package, "Depends")
        running = output("linuxcnc_var", "LINUXCNCVERSION").strip()
        major, minor = map(int, running.split(".")[:2])
        self.assertIn("libc6", depends)
        # what is installed is what it asks for
        installed = output("dpkg-query", "-W", "-f", "${Version}", "linuxcnc-uspace")
        asked = dict(re.findall(r"linuxcnc-uspace \((>=|<<) ([^)]*)\)", depends))
        self.assertEqual([version.rpartition(":")[2] for version in asked.values()],
                         [f"{major}.{minor}~", f"{major}.{minor + 1}~"])
        for relation, version in asked.items():
            subprocess.run(["dpkg", "--compare-versions", installed, relation, version], check=True)
        for name in ("/usr/lib/linuxcnc/modules/blendtp.so", "/usr/lib/linuxcnc/modules/framekins.so", "/usr/bin/framepath",
                     "/usr/share/man/man9/blendtp.9.gz", "/usr/share/framepath/subroutines/trans.ngc",
                     "/usr/share/framepath/configs/framepath-sim/framepath-sim.ini",
                     "/usr/share/linuxcnc/aux_examples/framepath"):
            self.assertIn(name, files)
        # modules that dpkg has touched are still good
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["dpkg-deb", "--extract", package, folder], check=True)
            for name in ("blendtp", "framekins"):
                module = f"{folder}/usr/lib/linuxcnc/modules/{name}.so"
                subprocess.run([os.path.join(harness.SAMPLES, "check-module"), module], check=True)

    def test_with_the_source(self):
        package, files = self.package("deb-source", "framepath-source")
        self.assert_version(package)
        self.assertEqual(self.field(package, "Architecture"), "all")
        # whose toolchains are those of one user, and not of the one who builds
        self.assertNotIn("rustup", self.field(package, "Depends"))
        for name in ("Cargo.lock", "Makefile", "hal-component/blendtp.c", "hal-component/linuxcnc-has", "tool/Cargo.toml",
                     "prerequisites"):
            self.assertIn(f"/usr/src/framepath/{name}", files)
        self.assertIn("/usr/lib/framepath/build-where-installed", files)
        for part in ("/target/", "/.git/", ".so", "/usr/bin/"):
            self.assertFalse([name for name in files if part in name], part)
        self.assertIn("interest-noawait /usr/bin/linuxcnc", output("dpkg-deb", "--info", package, "triggers"))


@pytest.mark.thorough
class OfALittleSource(unittest.TestCase):
    """make deb-source of what it needs, which takes no time."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.source = os.path.join(folder.name, "source")
        os.mkdir(self.source)
        for name in ("Makefile", "prerequisites"):
            shutil.copy(os.path.join(harness.ROOT, name), self.source)
        shutil.copytree(DEBIAN, os.path.join(self.source, "debian"))

    def package(self, **environment):
        """What dpkg-deb lists of the package, after a make whose files are for nobody else."""
        done = subprocess.run(["make", "-C", self.source, "-o", "prerequisites", "deb-source"], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False, umask=0o077,
                              env={**os.environ, "CARGO_TARGET_DIR": "target", **environment})
        self.assertEqual(done.returncode, 0, done.stdout)
        target = environment.get("CARGO_TARGET_DIR", "target")
        found = glob.glob(os.path.join(self.source, target, "package", "*.deb"))
        self.assertEqual(len(found), 1)
        return output("dpkg-deb", "--contents", found[0])

    def test_what_is_built_in_the_source_is_not_copied_into_itself(self):
        os.makedirs(os.path.join(self.source, "build/out/release"))
        # another folder of cargo
        os.mkdir(os.path.join(self.source, "older"))
        with open(os.path.join(self.source, "older", "CACHEDIR.TAG"), "w", encoding="utf-8") as file:
            file.write("Signature: 8a477f597d28d172789f06886806bc55\n")
        listed = self.package(CARGO_TARGET_DIR="build/out")
        for name in ("/out/", "/older/"):
            self.assertNotIn(name, listed)
        done = subprocess.run(["make", "-C", self.source, "deb-source", "CARGO_TARGET_DIR=."], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("CARGO_TARGET_DIR=. is the folder of the source", done.stderr)

    def test_a_source_that_nobody_else_may_read_can_be_read_where_it_is_installed(self):
        os.chmod(os.path.join(self.source, "Makefile"), 0o600)
        os.chmod(os.path.join(self.source, "prerequisites"), 0o700)
        modes = {line.split()[5].removeprefix("."): line.split()[0] for line in self.package().splitlines()}
        self.assertEqual(modes["/usr/src/framepath/Makefile"], "-rw-r--r--")
        self.assertEqual(modes["/usr/src/framepath/prerequisites"], "-rwxr-xr-x")
        self.assertEqual({mode for name, mode in modes.items() if name.endswith("/")}, {"drwxr-xr-x"})

    def version(self):
        return output(os.path.join(self.source, "debian", "package-version")).strip()

    def git(self, *arguments, date):
        settings = ("-c", "user.name=tester", "-c", "user.email=tester@localhost")
        subprocess.run(["git", "-C", self.source, *settings, *arguments], check=True, capture_output=True,
                       env=dict(os.environ, GIT_AUTHOR_DATE=date, GIT_COMMITTER_DATE=date))

    def test_a_clone_that_git_does_not_read_has_no_version(self):
        os.mkdir(os.path.join(self.source, ".git"))
        commands = os.path.join(self.source, "commands")
        os.mkdir(commands)
        with open(os.path.join(commands, "git"), "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\necho fatal: dubious ownership >&2\nexit 128\n")
        os.chmod(os.path.join(commands, "git"), 0o755)
        done = subprocess.run(["make", "-C", self.source, "-o", "prerequisites", "deb-source"], capture_output=True, text=True,
                              check=False, env={**os.environ, "CARGO_TARGET_DIR": "target",
                                                "PATH": f"{commands}:{os.environ['PATH']}"})
        self.assertEqual(done.returncode, 2)
        for words in ("dubious ownership", f"{self.source} is a clone of git", "apt install git", "safe.directory"):
            self.assertIn(words, done.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.source, "target", "package")))

    def test_each_commit_makes_a_newer_version(self):
        versions = [self.version()]
        self.assertRegex(versions[0], r"^[\d.]+$")
        date = "2026-01-02T03:04:05+0100"
        self.git("init", date=date)
        self.git("add", ".", date=date)
        self.git("commit", "-m", "first", date=date)
        versions.append(self.version())
        self.assertRegex(versions[1], "^" + re.escape(versions[0]) + r"\+git20260102020405\.[0-9a-f]{7,}$")
        self.git("commit", "--allow-empty", "-m", "second", date="2026-01-02T03:04:06+0100")
        versions.append(self.version())
        with open(os.path.join(self.source, "Makefile"), "a", encoding="utf-8") as file:
            file.write("# changed since\n")
        versions.append(self.version())
        for older, newer in zip(versions, versions[1:]):
            subprocess.run(["dpkg", "--compare-versions", older, "lt", newer], check=True)
        # and it is that of the package
        self.package()
        package = glob.glob(os.path.join(self.source, "target", "package", "*.deb"))[0]
        self.assertRegex(output("dpkg-deb", "--field", package, "Version"), r"\+git\d{14}\.[0-9a-f]{7,}$")


@pytest.mark.thorough
class OverAnother(unittest.TestCase):
    def test_over_what_make_has_installed_the_package_is_not_laid(self):
        with open(os.path.join(DEBIAN, "framepath.preinst"), encoding="utf-8") as file:
            text = file.read()
        with tempfile.TemporaryDirectory() as folder:
            script = os.path.join(folder, "preinst")
            with open(script, "w", encoding="utf-8") as file:
                file.write(text.replace(" /usr", f" {folder}/usr"))
            query = os.path.join(folder, "dpkg-query")
            os.symlink("/bin/false", query)

            def run(action):
                return subprocess.run(["sh", script, action], capture_output=True, text=True, check=False,
                                      env=dict(os.environ, PATH=f"{folder}:{os.environ['PATH']}"))

            self.assertEqual(run("install").returncode, 0)
            for prefix in ("usr/local", "usr"):
                make("install", f"DESTDIR={folder}", f"PREFIX=/{prefix}")
                done = run("install")
                self.assertEqual(done.returncode, 1)
                self.assertIn(f"sudo make uninstall PREFIX={folder}/{prefix}, then", done.stderr)
                # what is the package's own may be replaced
                self.assertEqual(run("upgrade").returncode, 0)
            os.remove(query)
            os.symlink("/bin/true", query)
            self.assertEqual(run("install").returncode, 0)


BUILT = ("modules/blendtp.so", "modules/framekins.so", "release/framepath",
         *(f"completions/{shell}" for shell in ("bash", "zsh", "fish")))


class BuiltWhereInstalled(unittest.TestCase):
    """debian/build-where-installed, with its folders moved and with a make that does what is asked of it."""

    def run_with(self, make_says, mktemp='exec /usr/bin/mktemp "$@"', **environment):
        """Its code, what it says, its log, and what it ran as the user who builds."""
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(DEBIAN, "build-where-installed"), encoding="utf-8") as file:
                text = file.read()
            work = os.path.join(folder, "work")
            for name in BUILT:
                os.makedirs(os.path.dirname(os.path.join(work, "target", name)), exist_ok=True)
                with open(os.path.join(work, "target", name), "w", encoding="utf-8") as file:
                    file.write(f"{name}\n")
            # a log of the user who builds leads elsewhere
            victim = os.path.join(folder, "victim")
            os.symlink(victim, os.path.join(work, "build.log"))
            moved = (text.replace("/var/lib/framepath", work).replace("/var/log", folder)
                     .replace("PATH=/usr/sbin", f"PATH={folder}:/usr/sbin").replace("/usr/bin/cargo", f"{folder}/debian-cargo")
                     .replace("/usr/local/bin", f"{folder}/callers"))
            for name, content in (("script", moved),
                                  ("make", f"#!/bin/sh\necho make $CARGO_TARGET_DIR \"$@\"\n{make_says}\n"),
                                  ("debian-cargo", "#!/bin/sh\necho cargo 1.96.0\n"),
                                  ("mktemp", f"#!/bin/sh\n{mktemp}\n"),
                                  # the caller's, in front of Debian's
                                  ("callers/framepath", ""),
                                  ("callers/make", "#!/bin/sh\necho of the caller; exit 1\n"),
                                  ("setpriv", f'#!/bin/sh\nshift 3\necho "$@" >> {folder}/as-builder\nexec "$@"\n')):
                os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(content)
                os.chmod(os.path.join(folder, name), 0o755)
            path = f"{folder}/callers:{os.environ['PATH']}"
            done = subprocess.run([os.path.join(folder, "script")], env=dict(os.environ, PATH=path, **environment),
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
            self.assertFalse(os.path.exists(victim))
            texts = []
            for name in ("framepath-build.log", "as-builder"):
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    texts.append(file.read().replace(work, "WORK").replace(folder, "FOLDER"))
            return done.returncode, done.stdout, *texts

    def test_what_is_built_is_installed(self):
        code, said, log, as_builder = self.run_with('[ -e "$CARGO_TARGET_DIR/release/framepath" ]')
        self.assertEqual(code, 0, said)
        self.assertIn("are installed", said)
        self.assertRegex(said, "another one is there, .*/callers/framepath: to remove it "
                               "sudo make -C .* uninstall PREFIX=/usr/local, then")
        built, installed = log.splitlines()
        self.assertRegex(built, r"^make WORK/target .* CARGO=FOLDER/debian-cargo modules completions$")
        self.assertRegex(installed, r"^make /\S+ .* -o modules -o completions install$")
        # root neither runs nor opens what lies where others may write
        self.assertNotIn("WORK", installed)
        self.assertEqual(as_builder.splitlines()[1:], [f"cat WORK/target/{name}" for name in BUILT])

    def test_a_failure_is_said_with_the_way_back_and_fails_nothing(self):
        code, said, log, _ = self.run_with("echo cargo 1.90 is needed; exit 1")
        self.assertEqual(code, 0, said)
        self.assertNotIn("install\n", log)
        for words in ("NOT BUILT", "debian-cargo (cargo 1.96.0)", "    cargo 1.90 is needed",
                      "dpkg-reconfigure framepath-source", "TPMOD = blendtp",
                      "KINEMATICS = trivkins", "LinuxCNC itself is as it was", "each REMAP", "M6", "ON_ABORT_COMMAND = o<frame_abort>",
                      "USER_COMMAND_FILE", "operator.hal", "/usr/src/framepath/README.md"):
            self.assertIn(words, said)

    def test_the_environment_of_who_calls_apt_says_nothing_but_the_way_into_the_network(self):
        names = {"PREFIX": "/usr/local", "DESTDIR": "/nonexistent", "LINUXCNC_SOURCE": "/nonexistent", "MAKEFLAGS": "-n",
                 "LINUXCNC_INCLUDE": "/nonexistent", "CARGO": "/nonexistent", "RUSTFLAGS": "-Cdebuginfo=2",
                 "TMPDIR": "/nonexistent"}
        kept = {"https_proxy": "http://a b", "CARGO_HTTP_CAINFO": "/ca", "SSL_CERT_FILE": "/cert"}
        code, said, log, _ = self.run_with("env", **names, **kept)
        self.assertEqual(code, 0, said)
        self.assertIn("are installed", said)
        found = dict(line.split("=", 1) for line in log.splitlines() if re.match(r"\w+=", line))
        self.assertEqual(found.keys() & names.keys(), set())
        self.assertEqual({name: found.get(name) for name in kept}, kept)
        with open(os.path.join(DEBIAN, "framepath-source.prerm"), encoding="utf-8") as file:
            self.assertRegex(file.read(), r" env -i PATH=\S+ make ")

    def test_without_a_folder_for_what_was_built_nothing_is_installed(self):
        code, said, log, as_builder = self.run_with("true", mktemp="echo no room >&2; exit 1")
        self.assertEqual(code, 0, said)
        for words in ("NOT BUILT", "    no room"):
            self.assertIn(words, said)
        self.assertNotIn("completions install\n", log)
        self.assertNotIn("cat", as_builder)


if __name__ == "__main__":
    unittest.main()
