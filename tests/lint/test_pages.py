#!/usr/bin/env python3
"""The checks of pages, scenes and commits find what they are for."""

import os
import subprocess
import unittest
import unittest.mock

import commits
import links
import options
import program
import words
from tree import Tree


class Words(Tree):
    def test_a_mark_is_found(self):
        self.write("source/a.cc", "// Methodology\n// TO" "DO: later\n")
        self.expect(words.check(self.root), "source/a.cc:2: ")

    def test_control_characters_are_found(self):
        self.write("doc/a.md", "$$a =\n  \frac{1}{2}$$\n")
        self.write("README.md", "a\u200bb\n")
        (self.root / "doc/a.csv").write_bytes(b"a,b\r\n1,2\n")
        (self.root / "doc/a.png").write_bytes(b"\x89PNG\r\n\x00")
        self.expect(words.check(self.root), "doc/a.csv:1: the control character U+000D",
                    "doc/a.md:2: the control character U+000C",
                    "README.md:1: the control character U+200B")

    def test_a_comment_that_begins_with_a_fragment_is_found(self):
        self.write("include/snug/mesh/a.h", "/// Return the area.\n/// Of one face.\nint a;\n"
                   "/// Of all faces.\nint b;\nint c; ///< of a face\n/**\n * What c is.\n"
                   " * Of c.\n */\n")
        self.expect(words.check(self.root), "include/snug/mesh/a.h:4: a doc comment begins with"
                    " 'Of'", "include/snug/mesh/a.h:8: ")

    def test_a_plural_behind_1_is_found(self):
        self.write("doc/a.md", "1 rank, 11 ranks, 0.1 faces, Q1 cells\non 1 " "ranks\n")
        self.expect(words.check(self.root), "doc/a.md:2: '1 rank")

    def test_a_long_cell_is_found(self):
        self.write("doc/a.md", "| a | b |\n|---|---|\n| a | " + "b" * 300 + " |\n"
                   "| " + "a" * 301 + " | b |\n" + "c" * 400 + "\n")
        self.expect(words.check(self.root), "doc/a.md:4: a cell of 301")


class Commits(Tree):
    GOOD = ("Add the quantity mass", "Reduce memory by half", "Embed pictures", "Pass options",
            "Express forces by pressures")
    BAD = ("Added mass", "Adding mass", "Adds mass", "The mass", "wip", "What tests say",
           "Add mass; fix volume", "Add " + "m" * 69)

    def commit(self, title):
        git = ["git", "-C", str(self.root), "-c", "user.name=a", "-c", "user.email=a@b"]
        subprocess.run([*git, "commit", "-q", "--allow-empty", "-m", title], check=True)

    def test_only_imperatives_are_titles(self):
        for title in self.GOOD:
            self.expect(commits.complaints(title))
        for title in self.BAD:
            self.assertEqual(len(list(commits.complaints(title))), 1, title)

    def test_the_last_title_or_all_since_a_base_are_checked(self):
        self.expect(commits.check(self.root))
        subprocess.run(["git", "init", "-q", str(self.root)], check=True)
        for title in ("Begin", "Added mass", "Add volume"):
            self.commit(title)
        self.expect(commits.check(self.root))
        self.expect(commits.check(self.root, "HEAD~2"), "commit ")
        self.commit("More tests")
        self.expect(commits.check(self.root), "commit ")


class Links(Tree):
    def test_a_dead_link_is_found(self):
        self.write("README.md", "[a](doc/architecture.md#top) [b](https://x)\n"
                   "`[c](no)` [d](#top)\n```\n[e](no)\n```\n"
                   "![f](doc/f.png) [g](doc/g.md)\n")
        self.expect(links.check(self.root), "README.md:6: no file 'doc/f.png'",
                    "README.md:6: no file 'doc/g.md'")

    def test_a_link_starts_from_its_own_file(self):
        self.write("doc/a.md", "[a](architecture.md) [b](doc/architecture.md)\n")
        self.expect(links.check(self.root), "doc/a.md:1: no file 'doc/")

    def test_a_page_that_names_a_lost_file_is_found(self):
        for name in ("include/snug/mesh/forest.h", "source/mesh/forest.cc", "tests/unit/a_b.cc"):
            self.write(name, "")
        page = ("`mesh/forest`, `mesh/forest.cc`, `mesh/forest.h` and `a_b.cc`, source/mesh/forest.cc,"
                "\n`prm/NAME.prm`, tests/unit/<module>/, `Mesh/File`, `output/a.cc/b`, `base`\n"
                "```\n#include <snug/mesh/forest.h>\n```\n")
        self.write("README.md", page)
        self.expect(links.check(self.root))
        self.write("CHANGELOG.md", page.replace("forest", "tree"))
        self.expect(links.check(self.root))
        self.write("README.md", page.replace("forest", "tree").replace("a_b", "c"))
        self.expect(links.check(self.root), "README.md:1: no file 'source/mesh/tree.cc'",
                    "README.md:1: no file 'mesh/tree'", "README.md:1: no file 'mesh/tree.cc'",
                    "README.md:1: no file 'mesh/tree.h'", "README.md:1: no file 'c.cc'",
                    "README.md:4: no file 'include/snug/mesh/tree.h'")
        self.write("README.md", "    build/snug prm/no.prm --output output/no\n")
        self.expect(links.check(self.root), "README.md:1: no file 'prm/no.prm'")

    def test_a_cmake_file_that_names_a_lost_file_is_found(self):
        for name in ("source/mesh/a.cc", "source/version.h.in", "contrib/run", "tests/lint.py"):
            self.write(name, "")
        self.write("source/CMakeLists.txt", "# see doc/architecture.md\n"
                   "set(a mesh/a.cc ${b}/c.cc *.cc <deal.II/mpi.h>)\n"
                   "configure_file(version.h.in ${PROJECT_BINARY_DIR}/version.h)\n"
                   "test(../contrib/run ../contrib/${study} ${PROJECT_SOURCE_DIR}/tests/lint.py)\n")
        self.expect(links.check(self.root))
        self.write("source/CMakeLists.txt", "# see doc/a.md\nset(a mesh/b.cc mesh/a.cc)\n"
                   "configure_file(a.h.in ${PROJECT_BINARY_DIR}/version.h)\n"
                   "test(../contrib/test ${PROJECT_SOURCE_DIR}/tests/no.py)\n")
        self.write("contrib/cmake/a.cmake", "# tests/no.cc\n")
        self.expect(links.check(self.root), "contrib/cmake/a.cmake:1: no file 'tests/no.cc'",
                    "source/CMakeLists.txt:1: no file 'doc/a.md'",
                    "source/CMakeLists.txt:2: no file 'mesh/b.cc'",
                    "source/CMakeLists.txt:3: no file 'a.h.in'",
                    "source/CMakeLists.txt:4: no file 'tests/no.py'",
                    "source/CMakeLists.txt:4: no file '../contrib/test'")

    def test_a_function_that_a_page_lacks_is_found(self):
        self.write("include/snug/response/response.h", "virtual ~Response() = default;\n"
                   "virtual bool a() const { return b(); }\nvirtual std::vector<int> c(\n"
                   "  const int &) const = 0;\nint d();\n")
        self.write("doc/add-a-response.md", "| `a` | |\n| `c` | |\n")
        self.expect(links.check(self.root))
        self.write("doc/add-a-response.md", "| `a` | `c` |\n")
        self.expect(links.check(self.root), "doc/add-a-response.md:1: the tables lack `c`")


class Options(Tree):
    HEAD = "| entry | default | allowed | meaning |\n|---|---|---|---|\n"
    BODY = ("## subsection Body NAME\n" + HEAD +
            "| `Mesh` | `box` | one of box, ring, disc | m |\n"
            "| `Scale` | `1` | a number | s |\n")

    def setUp(self):
        super().setUp()
        self.write(options.REFERENCE, "## Outside of subsections\n" + self.HEAD +
                   "| `Scale` |  | text | s |\n" + self.BODY)
        self.write("prm/a.prm", "set Scale = 1\nsubsection Body a b\n"
                   "  set Mesh = ring # set Scale = 1\nend\n")

    def test_what_scenes_and_pages_show_passes(self):
        self.write("doc/gallery/a.md", "`--set \"Body {b}/Mesh=disc\"`\n")
        self.write("contrib/run", "'Body b/Scale=2'\n")
        self.expect(options.check(self.root))

    def test_what_nothing_shows_is_found(self):
        self.write("doc/gallery/a.md", "Body b/Mesh=discs, Bodies b/Scale=2\n")
        self.expect(options.check(self.root),
                    options.REFERENCE + ":8: 'Body/Mesh=disc'",
                    options.REFERENCE + ":9: 'Body/Scale'")

    def test_a_section_ends(self):
        self.write("prm/a.prm", "subsection Body a\n  set Mesh = disc\nend\n"
                   "subsection Solver\n  set Scale = 1\nend\nset Scale = 2\n")
        self.expect(options.check(self.root),
                    options.REFERENCE + ":8: 'Body/Mesh=ring'",
                    options.REFERENCE + ":9: 'Body/Scale'")


class Program(Tree):
    def setUp(self):
        super().setUp()
        # Runs are of the programs written here.
        alone = unittest.mock.patch.dict(os.environ)
        alone.start()
        self.addCleanup(alone.stop)
        os.environ.pop("SNUG_MANY", None)

    def test_a_refused_scene_is_found(self):
        self.write("prm/a.prm", "")
        self.write("prm/more/bad.prm", "")
        snug = self.write_program(
            'case $2 in *bad*) echo "Line <3> of file: no" >&2; exit 2;; esac')
        self.expect(program.check_scenes(self.root, snug),
                    "prm/more/bad.prm:3: exit status 2: Line")

    def test_an_old_reference_is_found(self):
        snug = self.write_program("printf 'a\\nb\\n'")
        self.write(program.REFERENCE, "a\nb\n")
        self.expect(program.check_parameters(self.root, snug))
        self.write(program.REFERENCE, "a\nc\n")
        self.expect(program.check_parameters(self.root, snug),
                    program.REFERENCE + ":2: differs")

    def test_a_missing_reference_is_found(self):
        snug = self.write_program("echo a")
        self.expect(program.check_parameters(self.root, snug),
                    program.REFERENCE + ":1: differs")


if __name__ == "__main__":
    unittest.main()
