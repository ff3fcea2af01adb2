#!/usr/bin/env python3
"""The lint checks find what they are for: each on a small tree of its own."""

import json
import os
import pathlib
import stat
import subprocess
import tempfile
import unittest
import unittest.mock

import commits
import compile as compiling
import formatting
import layout
import links
import modules
import options
import program
import shell
import size
import words

TABLE = """
| module | holds | may include |
|---|---|---|
| `base` | errors | nothing |
| `mesh` | meshes | `base` |
| `feti` | solver | `base` |
| `io` | files | all |

| label | what | where |
|---|---|---|
| `unit` | another table | `tests` |
"""


class Tree(unittest.TestCase):
    """A temporary project; write() adds a file to it."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name).resolve()
        self.write("doc/architecture.md", TABLE)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def write_program(self, script):
        path = self.write("snug", "#!/bin/sh\n" + script)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return str(path)

    def expect(self, messages, *starts):
        messages = list(messages)
        self.assertEqual(len(messages), len(starts), messages)
        for message, start in zip(messages, starts):
            self.assertTrue(message.startswith(start), message)


class Size(Tree):
    def test_long_functions_are_found(self):
        body = "  f();\n" * 61
        self.write("source/mesh/a.cc", "namespace snug::mesh {\n"
                   "template <int dim>\nvoid g(int a,\n       int b)\n{\n" + body +
                   "}\n\nstruct S\n{\n" + body + "};\n} // namespace snug::mesh\n")
        self.expect(size.check(self.root), "source/mesh/a.cc:3: a function of 61")

    def test_functions_of_the_limit_pass(self):
        self.write("source/mesh/a.cc", "void g()\n{\n" + "  f();\n" * 60 + "}\n")
        self.expect(size.check(self.root))

    def test_a_large_module_is_found(self):
        for name in ("base", "mesh", "feti", "io"):
            self.write(f"source/{name}/a.cc", "// line\n" * 95)
        for name in "abcdefgh":
            self.write(f"source/{name}/a.cc", "// line\n" * 95)
        self.expect(size.check(self.root))
        self.write("source/mesh/b.cc", "// line\n" * 95)
        self.expect(size.check(self.root), "source/mesh:1: 190 of 1235")


class Modules(Tree):
    def test_allowed_includes_pass(self):
        self.write("include/snug/mesh/a.h", "#include <snug/base/errors.h>\n")
        self.write("source/mesh/a.cc",
                   '#include <snug/mesh/a.h>\n#include "a.inst"\n')
        self.write("source/io/x.cc", "#include <snug/feti/csr_matrix.h>\n")
        self.expect(modules.check(self.root))

    def test_a_sideways_include_is_found(self):
        self.write("source/feti/a.cc",
                   "#include <vector>\n#  include <snug/mesh/a.h>\n")
        self.expect(modules.check(self.root), "source/feti/a.cc:2: module 'feti'")

    def test_a_downward_include_of_a_header_is_found(self):
        self.write("include/snug/base/a.h", "#include <snug/io/a.h>\n")
        self.expect(modules.check(self.root),
                    "include/snug/base/a.h:1: module 'base'")

    def test_detours_are_found(self):
        self.write("source/feti/a.cc", '#include "../mesh/a.h"\n'
                   "#include <snug/meshes/a.h>\n")
        self.write("source/other/a.cc", "")
        self.expect(modules.check(self.root), "source/feti/a.cc:1: ",
                    "source/feti/a.cc:2: no module", "source/other/a.cc:1: ")

    def test_a_table_that_points_downward_is_found(self):
        self.write("doc/architecture.md",
                   TABLE.replace("| errors | nothing", "| errors | `mesh`"))
        self.expect(modules.check(self.root), "doc/architecture.md:4: 'base'")

    def test_a_lost_table_is_found(self):
        self.write("doc/architecture.md", "no table\n")
        self.expect(modules.check(self.root), "doc/architecture.md:1: ")


class Layout(Tree):
    GUARDED = "#ifndef {0}\n#define {0}\n#endif\n"

    def test_good_files_pass(self):
        self.write("include/snug/feti/a_b.h",
                   "// head\n" + self.GUARDED.format("snug_feti_a_b_h"))
        self.write("source/feti/a.cc", "\n" * 400)
        self.write(layout.COMPATIBILITY, "#ifndef snug_base_deal_ii_compat_h\n"
                   "#define snug_base_deal_ii_compat_h\n"
                   "#if DEAL_II_VERSION_GTE(9, 6, 0)\n#endif\n#endif\n")
        self.expect(layout.check(self.root))

    def test_a_wrong_guard_is_found(self):
        self.write("include/snug/feti/a.h", self.GUARDED.format("snug_a_h"))
        self.write("include/snug/feti/b.h", "#pragma once\n")
        self.write("include/snug/feti/c.h", "")
        self.expect(layout.check(self.root), "include/snug/feti/a.h:1: header",
                    "include/snug/feti/b.h:1: header",
                    "include/snug/feti/c.h:1: header")

    def test_a_define_of_another_name_is_found(self):
        self.write("include/snug/feti/a.h",
                   "\n#ifndef snug_feti_a_h\n#define snug_feti_b_h\n#endif\n")
        self.expect(layout.check(self.root), "include/snug/feti/a.h:3: header")

    def test_a_long_file_and_a_version_are_found(self):
        self.write("source/feti/a.cc", "\n" * 401)
        self.write("tests/x.cc", "\n#  if !DEAL_II_VERSION_GTE(9, 5, 0)\n")
        self.expect(layout.check(self.root), "source/feti/a.cc:401: longer",
                    "tests/x.cc:2: ask")


class Format(Tree):
    def test_an_assertion_of_debug_builds_is_found(self):
        self.write("source/feti/a.cc", "SNUG_ASSERT(i < n, \"too large\");\n"
                   "static_assert(sizeof(int) == 4);\n  AssertDimension(i, n);\n")
        self.expect(layout.check(self.root), "source/feti/a.cc:3: use the assertions")

    def test_a_crooked_file_is_found(self):
        self.write(".clang-format", "BasedOnStyle: LLVM\n")
        self.write("source/a.cc", "int a;\n")
        self.expect(formatting.check(self.root))
        self.write("source/b.cc", "int a;\nint  b;\n")
        self.expect(formatting.check(self.root), "source/b.cc:2: ")


class Shell(Tree):
    SCRIPT = "#!/usr/bin/env bash\nset -eu\nusage='the {} GAMG, rigid motions'\necho \"$usage\"\n"

    def test_a_quote_that_an_apostrophe_ends_is_found(self):
        self.write("contrib/good", self.SCRIPT.format("gears of PETSc:"))
        self.write("contrib/notes", "It's no script.\n")
        self.expect(shell.check(self.root))
        self.write("contrib/bench", self.SCRIPT.format("PETSc's"))
        found = [message for message in shell.check(self.root) if "apostrophe" in message]
        self.expect(found, "contrib/bench:3:")

    def test_a_part_of_a_script_is_checked(self):
        self.write("contrib/lib/setup.sh", "# shellcheck shell=bash\ncd $1 || exit\n")
        self.expect(shell.check(self.root), "contrib/lib/setup.sh:2:")

    def test_a_missing_program_is_told(self):
        with unittest.mock.patch.dict(os.environ, PATH=""):
            self.expect(shell.check(self.root), "contrib:1: no shellcheck")


class Alone(Tree):
    """Two sources that compile one after the other but not alone."""

    def setUp(self):
        super().setUp()
        self.write("include/snug/base/a.h", "#include <vector>\n")
        self.write("include/snug/base/b.h", "inline std::vector<int> b;\n")
        self.write("source/base/a.cc", "#include <snug/base/a.h>\n")
        self.write("source/base/c.cc", "#include <snug/base/a.h>\n"
                   "#include <snug/base/b.h>\nint c()\n{ int d = 1; }\n")
        name = str(self.write("build/unity_0.cxx", '#include "a.cc"\n'))
        command = (f"ccache g++ -Wall -I{self.root}/include"
                   f" -o source/CMakeFiles/snug_base.dir/unity_0.o -c {name}")
        self.write("build/compile_commands.json", json.dumps(
            [{"directory": str(self.root / "build"), "file": name,
              "command": command}]))

    def found(self, files=None):
        commands = compiling.alone(self.root, self.root / "build", files)
        return [said.partition("\n")[0] for said in compiling.check(commands)]

    def test_a_warning_and_a_header_that_needs_another_are_found(self):
        of_source, of_header = self.found()
        self.assertIn("source/base/c.cc: In function", of_source)
        self.assertIn("include/snug/base/b.h:1:", of_header)

    def test_only_the_files_asked_for_are_compiled(self):
        self.assertEqual(self.found({self.root / "source/base/a.cc"}), [])
        self.assertEqual(len(self.found({self.root / "include/snug/base/b.h"})), 1)


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
