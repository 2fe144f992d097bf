"""The man pages: their heads, and what the formatter says of them."""

import os
import re
import shutil
import subprocess
import unittest

import harness

PAGES = [os.path.join(harness.ROOT, *name) for name in (("tool", "framepath.1"), ("hal-component", "framekins.9"),
                                                        ("hal-component", "blendtp.9"))]


class ManPages(unittest.TestCase):
    def test_the_head_has_a_date_and_what_it_is_of(self):
        for page in PAGES:
            with self.subTest(page=page), open(page, encoding="utf-8") as file:
                name, section = os.path.basename(page).upper().split(".")
                self.assertRegex(file.readline(), rf'^\.TH {name} {section} \d{{4}}-\d\d-\d\d framepath "[\w ]+"$')

    @unittest.skipUnless(shutil.which("man"), "needs man")
    def test_lines_can_be_broken_in_a_terminal_of_the_usual_width(self):
        for page in PAGES:
            with self.subTest(page=page):
                done = subprocess.run(["man", "--warnings=w", "--local-file", page], capture_output=True, text=True, check=True,
                                      env={**os.environ, "MANWIDTH": "80", "LC_ALL": "C.UTF-8"})
                self.assertFalse(re.findall("warning.*", done.stderr))


if __name__ == "__main__":
    unittest.main()
