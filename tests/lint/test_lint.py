#!/usr/bin/env python3
"""The checks of the code find what they are for: each on a small tree of its own."""

import json
import os
import unittest
import unittest.mock

import compile as compiling
import formatting
import layout
import modules
import shell
import size
from tree import TABLE, Tree


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


if __name__ == "__main__":
    unittest.main()
